#include <bumpshadow/measure/figures.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/measure/sample.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

error_figures figures(std::vector<double> errors, std::size_t per_texel = 1) { return figures_of(errors, per_texel); }

// 1 to n with turning signs, in an order that is not sorted.
std::vector<double> counted(int n) {
    std::vector<double> list;
    for (int i = 0; i < n; ++i) {
        const int k = int((std::int64_t(i) * 7919 + 11) % n) + 1;  // 7919 is prime and divides no n used here
        list.push_back(k % 2 == 0 ? double(k) : -double(k));
    }
    return list;
}

}  // namespace

TEST_CASE("figures of lists") {
    const error_figures f = figures(counted(100));
    CHECK(f.count == 100);
    CHECK(f.mean == 50.5);
    CHECK(f.bias == 0.5);  // fifty pairs of -k and k + 1
    CHECK(f.percentile_99 == 99.0);
    CHECK(f.largest == 100.0);
    CHECK(f.rms == doctest::Approx(std::sqrt(338350.0 / 100.0)));  // n (n + 1) (2 n + 1) / 6

    // The smallest that at least 99 % do not exceed.
    CHECK(figures(counted(1)).percentile_99 == 1.0);
    CHECK(figures(counted(2)).percentile_99 == 2.0);
    CHECK(figures(counted(99)).percentile_99 == 99.0);    // 98 of 99 are 98.99 %
    CHECK(figures(counted(101)).percentile_99 == 100.0);  // 100 of 101 are 99.01 %
    CHECK(figures(counted(200)).percentile_99 == 198.0);
    CHECK(figures(counted(201)).percentile_99 == 199.0);
    CHECK(figures(counted(1000)).percentile_99 == 990.0);
    CHECK(figures(counted(1000)).largest == 1000.0);
}

TEST_CASE("NaN is left out, and nothing at all is NaN") {
    const error_figures f = figures({none, 3.0, none, -1.0, none});
    CHECK(f.count == 2);
    CHECK(f.mean == 2.0);
    CHECK(f.bias == 1.0);
    CHECK(f.largest == 3.0);
    for (const error_figures& empty : {figures({}), figures({none, none})}) {
        CHECK(empty.count == 0);
        for (const double v : {empty.mean, empty.percentile_99, empty.largest, empty.bias, empty.rms, empty.interval})
            CHECK(std::isnan(v));
    }
}

// Student's t from a table: 0.975 quantile.
TEST_CASE("standard errors of a 95 % interval") {
    const double table[][2] = {{4, 2.776445},  {5, 2.570582},  {7, 2.364624},   {10, 2.228139},
                               {20, 2.085963}, {30, 2.042272}, {100, 1.983972}, {1000, 1.962339}};
    for (const auto& [degrees, t] : table) CHECK(std::abs(standard_errors_95(degrees) - t) < 1e-3);
    CHECK(std::abs(standard_errors_95(2) - 4.302653) < 0.04);
    CHECK(std::abs(standard_errors_95(3) - 3.182446) < 0.004);
    CHECK(standard_errors_95(1e12) == doctest::Approx(1.959964));
    CHECK(std::isinf(standard_errors_95(0)));
}

TEST_CASE("interval by hand") {
    // Standard deviation of 1 2 3 4 5 is sqrt(2.5), of their mean sqrt(2.5 / 5).
    const double one = figures({1.0, 2.0, 3.0, -4.0, 5.0}).interval;
    CHECK(one == doctest::Approx(standard_errors_95(4) * std::sqrt(0.5)));
    // Errors that are the same within a texel say no more than one of them.
    CHECK(figures({1, 1, 1, 2, 2, 2, 3, 3, 3, -4, -4, -4, 5, 5, 5}, 3).interval == doctest::Approx(one));
    // Texels that have the same sum leave nothing to chance.
    CHECK(figures({1, 5, 2, 4, 3, 3}, 2).interval == doctest::Approx(0.0));
    // Texels of 1 and of 2 errors: mean 7/3; (1 - 7/3)^2 + (6 - 14/3)^2 = 32/9, twice that, root, over 3 errors: 8/9.
    CHECK(figures({1, none, 3, 3}, 2).interval == doctest::Approx(standard_errors_95(1) * 8.0 / 9.0));
    // A texel without errors is none.
    CHECK(figures({1, none, none, none, 3, 3}, 2).interval == doctest::Approx(standard_errors_95(1) * 8.0 / 9.0));
    CHECK(std::isinf(figures({1, 2, 3}, 3).interval));
    CHECK(std::isinf(figures({1}).interval));
}

// A map whose texels are independent, each with 8 errors that are alike; the mean of all is known. Of 1000 intervals,
// 950 +- 7 (standard deviation) should hold it.
TEST_CASE("95 % of intervals hold the true mean") {
    const glm::ivec2 extent{96, 80};
    shapes::noise source(3);
    std::vector<double> errors;
    double truth = 0.0;
    for (int i = 0; i < extent.x * extent.y; ++i) {
        const double level = source.uniform() * source.uniform();
        for (int k = 0; k < 8; ++k) {
            errors.push_back((source.uniform() < 0.5 ? -1.0 : 1.0) * (level + 0.1 * source.uniform()));
            truth += std::abs(errors.back());
        }
    }
    truth /= double(errors.size());

    int inside = 0, inside_if_independent = 0;
    std::vector<glm::ivec2> texels(150);
    for (std::uint32_t seed = 1; seed <= 1000; ++seed) {
        REQUIRE(sample_texels(extent, seed, texels));
        std::vector<double> drawn;
        for (const glm::ivec2 t : texels) {
            const auto first = errors.begin() + 8 * (t.y * extent.x + t.x);
            drawn.insert(drawn.end(), first, first + 8);
        }
        const error_figures f = figures(drawn, 8), independent = figures(drawn);
        inside += std::abs(f.mean - truth) <= f.interval;
        inside_if_independent += std::abs(f.mean - truth) <= independent.interval;
    }
    CHECK(inside >= 920);
    CHECK(inside <= 980);
    CHECK(inside_if_independent < 800);
}

TEST_CASE("on a smooth map strata make the sample better than the interval says") {
    const glm::ivec2 extent{96, 80};
    const auto field = shapes::sampled(extent, shapes::waves(extent));
    double truth = 0.0;
    for (const double v : field.samples) truth += std::abs(v) / double(field.samples.size());
    int inside = 0;
    std::vector<glm::ivec2> texels(150);
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        REQUIRE(sample_texels(extent, seed, texels));
        std::vector<double> drawn;
        for (const glm::ivec2 t : texels) drawn.push_back(field.at(t.x, t.y));
        const error_figures f = figures(drawn);
        inside += std::abs(f.mean - truth) <= f.interval;
    }
    CHECK(inside >= 195);
}
