// The fits of slices against dense normal equations and a minimizer in double; points, quantities, reports, bad input,
// executors.

#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/stored_rows.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "support/executors.hpp"
#include "support/horizons.hpp"
#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

// Slices [slice][y][x] of a map.
std::vector<float> packed(const horizons& map, const slice_set& slices, const horizon_scale& scale,
                          pack_options options = {}) {
    std::vector<float> result(required_size(map.extent, slices.count));
    const status s = for_slice_rows(
        map.view(), map.directions, slices, scale, options, serial{}, [&](int slice, int y, const float* values) {
            const std::size_t row = std::size_t(slice * map.extent.y + y);
            std::copy(values, values + map.extent.x, result.begin() + std::ptrdiff_t(row * std::size_t(map.extent.x)));
        });
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    return result;
}

// Least squares by the book: Gaussian elimination on A^T A, where row j of A has the hat functions at bearing j.
std::vector<double> dense_fit(const std::vector<double>& bearings, const std::vector<double>& values, int count,
                              double phase) {
    const std::size_t n = std::size_t(count);
    std::vector<std::vector<double>> matrix(n, std::vector<double>(n + 1));
    for (std::size_t j = 0; j < bearings.size(); ++j) {
        std::vector<double> row(n);
        for (std::size_t i = 0; i < n; ++i) {
            double apart = bearings[j] - phase - double(i) / count;
            apart -= std::round(apart);
            row[i] = std::max(0.0, 1.0 - std::abs(apart) * count);
        }
        if (count == 1) row[0] = 1.0;
        if (count == 2) row[1] = 1.0 - row[0];
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = 0; b < n; ++b) matrix[a][b] += row[a] * row[b];
            matrix[a][n] += row[a] * values[j];
        }
    }
    for (std::size_t a = 0; a < n; ++a) {
        std::size_t pivot = a;
        for (std::size_t b = a; b < n; ++b)
            if (std::abs(matrix[b][a]) > std::abs(matrix[pivot][a])) pivot = b;
        std::swap(matrix[a], matrix[pivot]);
        for (std::size_t b = 0; b < n; ++b) {
            if (b == a) continue;
            const double factor = matrix[b][a] / matrix[a][a];
            for (std::size_t c = a; c <= n; ++c) matrix[b][c] -= factor * matrix[a][c];
        }
    }
    std::vector<double> result(n);
    for (std::size_t a = 0; a < n; ++a) result[a] = std::clamp(matrix[a][n] / matrix[a][a], 0.0, 1.0);
    return result;
}

// d of the stored values of a scale: radians a value of 1 more.
double radians_of_one(const horizon_scale& scale, double h) {
    if (scale.stored == quantity::angle) return std::atan(double(scale.max_slope));
    if (scale.stored == quantity::sine) {
        const double unit = std::sin(std::atan(double(scale.max_slope)));
        return unit / std::sqrt(std::max(0.01, 1.0 - unit * unit * h * h));
    }
    const double slope = h * double(scale.max_slope);
    return double(scale.max_slope) / (1.0 + slope * slope);
}

// Horizons of one texel in evenly spaced directions, and what slices make of them.
struct profile {
    int slices;
    horizon_scale scale;
    std::vector<double> stored;

    [[nodiscard]] double between(const std::vector<double>& values, std::size_t j) const {
        const double position = double(j) * slices / double(stored.size());
        const std::size_t i = std::size_t(position), next = (i + 1) % std::size_t(slices);
        const double part = position - double(i);
        return values[i] * (1.0 - part) + values[next] * part;
    }
    [[nodiscard]] double elevation(double value) const {
        if (scale.stored == quantity::angle) return value * std::atan(double(scale.max_slope));
        if (scale.stored == quantity::sine) return std::asin(value * std::sin(std::atan(double(scale.max_slope))));
        return std::atan(value * double(scale.max_slope));
    }
    [[nodiscard]] double mean_miss(const std::vector<double>& values) const {
        double sum = 0.0;
        for (std::size_t j = 0; j < stored.size(); ++j)
            sum += std::abs(elevation(between(values, j)) - elevation(stored[j]));
        return sum / double(stored.size());
    }
    // By the formula, after the misses of `first`.
    [[nodiscard]] std::vector<double> weights(const std::vector<double>& first) const {
        std::vector<double> result;
        for (std::size_t j = 0; j < stored.size(); ++j) {
            const double d = radians_of_one(scale, stored[j]);
            result.push_back(d * d / (d * std::abs(between(first, j) - stored[j]) + 0.02));
        }
        return result;
    }
    [[nodiscard]] double weighted_square(const std::vector<double>& values, const std::vector<double>& w) const {
        double sum = 0.0;
        for (std::size_t j = 0; j < stored.size(); ++j) sum += w[j] * std::pow(between(values, j) - stored[j], 2.0);
        return sum;
    }
    // The least weighted square within [0, 1]: one slice after the other until nothing changes.
    [[nodiscard]] std::vector<double> least(std::vector<double> values, const std::vector<double>& w) const {
        for (int round = 0; round < 300; ++round)
            for (std::size_t i = 0; i < values.size(); ++i) {
                std::vector<double> unit(values.size());
                unit[i] = 1.0;
                double square = 0.0, pull = 0.0;
                for (std::size_t j = 0; j < stored.size(); ++j) {
                    const double part = between(unit, j);
                    square += w[j] * part * part;
                    pull += w[j] * part * (stored[j] - between(values, j));
                }
                values[i] = std::clamp(values[i] + pull / square, 0.0, 1.0);
            }
        return values;
    }
};

// Slopes as of a surface: the highest of a few peaks that rise over the ground around some bearings, 0 elsewhere.
void fill_peaks(const horizons& map, std::uint64_t seed) {
    shapes::noise random(seed);
    for (int y = 0; y < map.extent.y; ++y)
        for (int x = 0; x < map.extent.x; ++x) {
            for (int j = 0; j < map.bearings; ++j) map.at(j, x, y) = -0.1f;
            for (int peak = 0; peak < 5; ++peak) {
                const double at = random.uniform(), wide = 0.03 + 0.2 * random.uniform(), high = 2.5 * random.uniform();
                for (int j = 0; j < map.bearings; ++j) {
                    double apart = double(j) / map.bearings - at;
                    apart = std::abs(apart - std::round(apart)) / wide;
                    if (apart < 1.0) map.at(j, x, y) = std::max(map.at(j, x, y), float(high * (1.0 - apart * apart)));
                }
            }
        }
}

}  // namespace

TEST_CASE("least squares solve the dense normal equations") {
    for (const int count : {1, 2, 3, 4, 5, 8, 16, 32})
        for (const double phase : {0.0, 0.3, -0.01})
            for (const bearing_function function :
                 {bearing_function::exact, bearing_function::cubic, bearing_function::diamond}) {
                const int many = std::max(12, 4 * count + 1);  // stands nowhere with the slices
                horizons map = horizons::random({21, 3}, many, 7);
                const slice_set slices{count, phase, function};
                const horizon_scale scale{quantity::slope, 1.5f};
                const std::vector<float> found = packed(map, slices, scale, {.fit = slice_fit::least_squares});
                double worst = 0.0;
                for (int y = 0; y < map.extent.y; ++y)
                    for (int x = 0; x < map.extent.x; ++x) {
                        std::vector<double> bearings, values;
                        for (int j = 0; j < many; ++j) {
                            bearings.push_back(to_bearing(function, map.directions[std::size_t(j)]));
                            values.push_back(std::clamp(double(map.at(j, x, y)) / 1.5, 0.0, 1.0));
                        }
                        const std::vector<double> wanted = dense_fit(bearings, values, count, phase);
                        for (int i = 0; i < count; ++i)
                            worst = std::max(worst, std::abs(wanted[std::size_t(i)] -
                                                             double(found[std::size_t((i * 3 + y) * 21 + x)])));
                    }
                CAPTURE(count);
                CAPTURE(phase);
                CHECK(worst < 4e-6);
            }
}

TEST_CASE("a fit by hand: four horizons to two slices") {
    // Bearings 0, 1/4, 1/2, 3/4 with values a b c d: the rows are (1 0), (1/2 1/2), (0 1), (1/2 1/2), so A^T A has 3/2
    // on the diagonal and 1/2 beside it, the right side is (a + (b + d) / 2, c + (b + d) / 2).
    horizons map({1, 1}, 4);
    const float a = 0.25f, b = 0.5f, c = 0.75f, d = 0.125f;
    for (int i = 0; i < 4; ++i) map.at(i, 0, 0) = i == 0 ? a : i == 1 ? b : i == 2 ? c : d;
    const auto found =
        packed(map, {2, 0.0, bearing_function::exact}, {quantity::slope, 1.0f}, {.fit = slice_fit::least_squares});
    const float p = a + (b + d) / 2.0f, q = c + (b + d) / 2.0f;
    CHECK(found[0] == doctest::Approx(double((1.5f * p - 0.5f * q) / 2.0f)).epsilon(1e-6));
    CHECK(found[1] == doctest::Approx(double((1.5f * q - 0.5f * p) / 2.0f)).epsilon(1e-6));
}

TEST_CASE("what interpolates linearly already is fitted exactly, over the seam as well") {
    // Horizons of 32 bearings made from 8 slices give the slices back.
    const slice_set slices{8, 0.05, bearing_function::octant};
    horizons map({5, 1}, 32);
    shapes::noise random(3);
    std::vector<double> wanted;
    for (int x = 0; x < 5; ++x) {
        std::vector<double> own(8);
        for (double& v : own) v = random.uniform();
        for (int j = 0; j < 32; ++j) {
            double p = (to_bearing(slices.function, map.directions[std::size_t(j)]) - slices.phase) * 8.0;
            p -= 8.0 * std::floor(p / 8.0);
            const std::size_t i = std::size_t(p) % 8;
            const double part = p - std::floor(p);
            map.at(j, x, 0) = float(2.0 * (own[i] * (1.0 - part) + own[(i + 1) % 8] * part));
        }
        wanted.insert(wanted.end(), own.begin(), own.end());
    }
    for (const slice_fit fit : {slice_fit::least_squares, slice_fit::least_angle}) {
        const auto found = packed(map, slices, {quantity::slope, 2.0f}, {.fit = fit});
        for (std::size_t x = 0; x < 5; ++x)
            for (std::size_t i = 0; i < 8; ++i) CHECK(std::abs(double(found[i * 5 + x]) - wanted[x * 8 + i]) < 2e-6);
    }
}

TEST_CASE("least angle: the weighted least squares, and the elevation is off by less") {
    constexpr int width = 300, many = 32;
    for (const bool peaks : {false, true})
        for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
            for (const int count : {1, 2, 3, 8, 16, 32}) {
                horizons map = horizons::random({width, 1}, many, 21);
                if (peaks) fill_peaks(map, 22);
                const horizon_scale scale{stored, 2.0f};
                const slice_set slices{count, 0.0, bearing_function::exact};
                const auto squares = packed(map, slices, scale, {.fit = slice_fit::least_squares});
                const auto angles = packed(map, slices, scale, {.fit = slice_fit::least_angle});
                double miss_before = 0.0, miss = 0.0, worst = 0.0, could = 0.0, did = 0.0, furthest = 0.0;
                for (int x = 0; x < width; ++x) {
                    profile p{count, scale, {}};
                    for (int j = 0; j < many; ++j) p.stored.push_back(double(to_stored(scale, map.at(j, x, 0))));
                    std::vector<double> first, found;
                    for (int i = 0; i < count; ++i) {
                        first.push_back(double(squares[std::size_t(i * width + x)]));
                        found.push_back(double(angles[std::size_t(i * width + x)]));
                        CHECK(found.back() >= 0.0);
                        CHECK(found.back() <= 1.0);
                    }
                    if (count < many) {
                        const std::vector<double> w = p.weights(first), best = p.least(first, w);
                        could += p.weighted_square(first, w) - p.weighted_square(best, w);
                        did += p.weighted_square(first, w) - p.weighted_square(found, w);
                        for (std::size_t i = 0; i < best.size(); ++i)
                            furthest = std::max(furthest, std::abs(best[i] - found[i]));
                    }
                    const double one = p.mean_miss(first), other = p.mean_miss(found);
                    miss_before += one / width;
                    miss += other / width;
                    worst = std::max(worst, other - one);
                }
                CAPTURE(peaks);
                CAPTURE(int(stored));
                CAPTURE(count);
                if (count == many) {
                    CHECK(miss < 1e-6);
                    continue;
                }
                CHECK(did > 0.98 * could);  // of what the weighted problem had to give
                CHECK(furthest < 0.1);
                // Radians. Few slices miss by so much that d of the horizon says little about it.
                CHECK(worst < (count < 8 ? 0.04 : 0.015));
                CHECK(miss < miss_before * (count < 8 ? 1.01 : 0.99));
            }
}

TEST_CASE("least angle: no scale, however odd, leads out of [0, 1], and flat ground stays flat") {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    horizons map = horizons::random({40, 1}, 16, 9);
    for (int j = 0; j < 16; ++j) {
        map.at(j, 0, 0) = -0.5f;
        map.at(j, 1, 0) = j % 3 == 0 ? 1e30f : 0.0f;
        map.at(j, 2, 0) = 1e30f;
    }
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
        for (const float most : {smallest_max_slope, 1e-3f, 1e6f, largest_max_slope, infinite}) {
            if (stored == quantity::slope && most > largest_max_slope) continue;
            const auto found = packed(map, {6}, {stored, most}, {.fit = slice_fit::least_angle});
            const auto squares = packed(map, {6}, {stored, most}, {.fit = slice_fit::least_squares});
            CAPTURE(int(stored));
            CAPTURE(most);
            CHECK(std::all_of(found.begin(), found.end(), [](float v) { return v >= 0.0f && v <= 1.0f; }));
            for (std::size_t i = 0; i < 6; ++i) {
                CHECK(found[i * 40] == 0.0f);
                CHECK(found[i * 40 + 2] == doctest::Approx(double(squares[i * 40 + 2])).epsilon(1e-6));
            }
        }
}

TEST_CASE("point takes the horizons in the slices' own directions") {
    horizons map({19, 2}, 32);
    map.directions = shapes::directions(32);
    map.fill(11);
    for (glm::dvec2& d : map.directions) d *= 3.0;  // length does not matter
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle}) {
        const horizon_scale scale{stored, 1.25f};
        const auto found = packed(map, {8, 0.125, bearing_function::exact}, scale, {.fit = slice_fit::point});
        float worst = 0.0f;
        for (int i = 0; i < 8; ++i)
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 19; ++x) {
                    const float value = found[std::size_t((i * 2 + y) * 19 + x)];
                    worst = std::max(worst, std::abs(value - to_stored(scale, map.at((4 * i + 4) % 32, x, y))));
                    CHECK(value >= 0.0f);
                    CHECK(value <= 1.0f);
                }
        CHECK(worst < 1.2e-6f);
    }
    std::vector<float> none;
    const auto nothing = [](int, int, const float*) { FAIL("a sink was called"); };
    const status s = for_slice_rows(map.view(), map.directions, {8, 0.01, bearing_function::exact}, {},
                                    {.fit = slice_fit::point}, serial{}, nothing);
    CHECK(s.code() == error::mismatch);
}

TEST_CASE("sine and angle of any slope, as the scalar functions have them") {
    std::vector<float> slopes{0.0f,       -0.0f,      1e-20f, 1e-6f,  0.5f, 1.0f,
                              1.0000001f, 3.9999998f, 4.0f,   100.0f, 1e9f, 1e30f};
    for (float s = 0.001f; s < 2000.0f; s *= 1.07f) slopes.push_back(s);
    horizons map({int(slopes.size()), 1}, 1);
    for (std::size_t x = 0; x < slopes.size(); ++x) map.at(0, int(x), 0) = slopes[x];
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
        for (const float most : {0.3f, 4.0f, std::numeric_limits<float>::infinity()}) {
            if (std::isinf(most) && stored == quantity::slope) continue;
            const horizon_scale scale{stored, most};
            const auto found = packed(map, {1, 0.0, bearing_function::exact}, scale, {.fit = slice_fit::point});
            for (std::size_t x = 0; x < slopes.size(); ++x) {
                CAPTURE(slopes[x]);
                CHECK(std::abs(found[x] - to_stored(scale, slopes[x])) < 1.2e-6f);  // 16 bits have a step of 1.5e-5
            }
        }
}

TEST_CASE("holes, negative and not a number count as 0; what is too steep is clamped and counted") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    horizons map({6, 1}, 8);
    for (int j = 0; j < 8; ++j) {
        const float values[6] = {no_horizon, -0.5f, nan, 1.0f, 3.0f, 2.0f};
        for (int x = 0; x < 6; ++x) map.at(j, x, 0) = values[x];
    }
    map.at(2, 4, 0) = 7.5f;
    for (const slice_fit fit : {slice_fit::point, slice_fit::least_squares, slice_fit::least_angle}) {
        pack_report report;
        const auto found =
            packed(map, {4, 0.0, bearing_function::exact}, {quantity::slope, 2.0f}, {.fit = fit, .report = &report});
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t x = 0; x < 3; ++x) CHECK(found[i * 6 + x] == 0.0f);
            CHECK(found[i * 6 + 3] == doctest::Approx(0.5).epsilon(1e-6));
            CHECK(found[i * 6 + 4] == doctest::Approx(1.0).epsilon(1e-6));
            CHECK(found[i * 6 + 5] == doctest::Approx(1.0).epsilon(1e-6));
            CHECK(found[i * 6 + 4] <= 1.0f);
        }
        CHECK(report.clamped == (fit == slice_fit::point ? 4u : 8u));  // exactly max_slope is not clamped
        CHECK(report.steepest == 7.5f);
    }
}

TEST_CASE("wide maps, bands and any executor give the same bits") {
    const auto same = [](glm::ivec2 extent, const pack_options& options) {
        const horizons map = horizons::random(extent, 16, 5);
        const slice_set slices{8, 0.0, bearing_function::exact};
        const auto whole = packed(map, slices, {}, options);
        for (const int rows : {1, 2, 4}) {
            const auto with = [&](const auto& execute) {
                std::vector<float> found(whole.size());
                const status s = for_slice_bands(
                    map.view(), map.directions, slices, {}, options, rows, execute, [&](const slice_rows& band) {
                        REQUIRE(band.y % rows == 0);
                        REQUIRE(band.count == std::min(rows, extent.y - band.y));
                        for (int i = 0; i < 8; ++i)
                            for (int r = 0; r < band.count; ++r)
                                std::copy(band.row(i, r), band.row(i, r) + extent.x,
                                          found.begin() +
                                              std::ptrdiff_t(i * extent.y + band.y + r) * std::ptrdiff_t(extent.x));
                    });
                REQUIRE(bool(s));
                return std::memcmp(found.data(), whole.data(), whole.size() * sizeof(float)) == 0;
            };
            CHECK(with(serial{}));
            CHECK(with(threads(3)));
            CHECK(with(executors::backwards{}));
        }
        // A texel is the same wherever it lies in the map.
        if (extent.x > 500) {
            horizons part({extent.x - 500, extent.y}, 16);
            for (int j = 0; j < 16; ++j)
                for (int y = 0; y < extent.y; ++y)
                    for (int x = 0; x < part.extent.x; ++x) part.at(j, x, y) = map.at(j, x + 500, y);
            const auto found = packed(part, slices, {}, options);
            bool equal = true;
            for (int i = 0; i < 8 * extent.y; ++i)
                for (int x = 0; x < part.extent.x; ++x)
                    equal = equal && found[std::size_t(i * part.extent.x + x)] ==
                                         whole[std::size_t(i) * std::size_t(extent.x) + std::size_t(x) + 500];
            CHECK(equal);
        }
    };
    for (const slice_fit fit : {slice_fit::point, slice_fit::least_squares, slice_fit::least_angle})
        for (const glm::ivec2 extent :
             {glm::ivec2(1, 1), glm::ivec2(517, 37), glm::ivec2(512, 16), glm::ivec2(1030, 5)})
            same(extent, {.fit = fit});
}

TEST_CASE("scratch: the stated size is enough, less is refused") {
    const horizons map = horizons::random({40, 20}, 32, 1);
    for (const int threads_count : {1, 3}) {
        std::vector<std::byte> scratch(slice_scratch_size(map.extent, 32, 8, threads_count));
        pack_options options{.fit = slice_fit::least_angle, .scratch = scratch};
        const auto run = [&] {
            return for_slice_bands(map.view(), map.directions, {8}, {}, options, 4, threads(threads_count),
                                   [](const slice_rows&) {});
        };
        CHECK(bool(run()));
        options.scratch = options.scratch.first(100);
        CHECK(run().code() == error::too_small);
    }
    // O(width x slices): as much for many directions and rows but for their weights.
    CHECK(slice_scratch_size({1024, 4096}, 128, 8) < 1024 * 8 * 4 * 4 + 128 * 1024);
}

TEST_CASE("bad input is named and nothing is written") {
    horizons map = horizons::random({8, 4}, 8, 1);
    slice_set slices{4};
    horizon_scale scale;
    pack_options options;
    int rows = 1;
    const auto code = [&] {
        const status s = for_slice_bands(map.view(), map.directions, slices, scale, options, rows, serial{},
                                         [](const slice_rows&) { FAIL("a sink was called"); });
        CHECK(s.message().view().size() > 4);
        return s.code();
    };
    slices.count = 0;
    CHECK(code() == error::not_positive);
    slices.count = most_slices + 1;
    CHECK(code() == error::out_of_range);
    slices.count = 4;
    for (const double turns : {-1.0, 1.0}) {
        slices.phase = turns * std::nextafter(largest_phase, 17.0);
        CHECK(code() == error::out_of_range);
    }
    slices = {9};
    for (const slice_fit fit : {slice_fit::least_squares, slice_fit::least_angle}) {
        options.fit = fit;
        CHECK(code() == error::too_small);  // more than directions
    }
    slices = {4, std::nan("")};
    CHECK(code() == error::not_finite);
    slices = {4};
    scale.max_slope = 0.0f;
    CHECK(code() == error::not_positive);
    scale.max_slope = std::numeric_limits<float>::infinity();
    CHECK(code() == error::not_finite);
    scale = {};
    rows = 3;
    CHECK(code() == error::out_of_range);
    rows = 1;
    map.directions.pop_back();
    CHECK(code() == error::mismatch);
    map.directions.push_back({0.0, 0.0});
    CHECK(code() == error::not_positive);
    map.directions.back() = {std::nan(""), 1.0};
    CHECK(code() == error::not_finite);
    // All on one side: slices on the other are not determined.
    for (std::size_t j = 0; j < 8; ++j) map.directions[j] = shapes::direction(0.01 * double(j));
    CHECK(code() == error::out_of_range);
    // All half way: neighbors could grow against each other for ever.
    slices = {8, 0.0, bearing_function::exact};
    map.directions = shapes::directions(8, 1.0 / 16.0);
    CHECK(code() == error::out_of_range);
    map.directions = shapes::directions(8);
    map.extent = {9, 4};
    CHECK(code() == error::too_small);
    map.extent = {0, 4};
    CHECK(code() == error::not_positive);
}

TEST_CASE("the steepest slope, and what is suggested for the scale") {
    horizons map({37, 3}, 2);
    map.slopes.assign(map.slopes.size(), no_horizon);
    CHECK(steepest_slope(map.view()) == 0.0f);
    CHECK(suggest_max_slope(map.view()) == 4.0f);
    map.at(1, 36, 2) = 1.5f;
    CHECK(steepest_slope(map.view()) == 1.5f);
    CHECK(suggest_max_slope(map.view()) == 1.5f);
    map.at(0, 3, 1) = 17.0f;
    map.at(0, 4, 1) = std::numeric_limits<float>::quiet_NaN();
    CHECK(steepest_slope(map.view()) == 17.0f);
    CHECK(suggest_max_slope(map.view()) == 4.0f);
    CHECK(suggest_max_slope(map.view(), 100.0f) == 17.0f);
}

TEST_CASE("fitted slices as a horizon map: packed by points they are the same texture") {
    const horizons map = horizons::random({33, 9}, 32, 2);
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle}) {
        const horizon_scale scale{stored, 1.1f};
        const slice_set slices{8, 0.0, bearing_function::cubic};
        horizons fitted({33, 9}, 8);
        fill_directions(fitted.directions, slices.phase, slices.function);
        REQUIRE(bool(fit_slices(map.view(), map.directions, slices, scale, {}, fitted.view())));
        const auto once = packed(map, slices, scale), twice = packed(fitted, slices, scale, {.fit = slice_fit::point});
        float worst = 0.0f;
        for (std::size_t i = 0; i < once.size(); ++i) worst = std::max(worst, std::abs(once[i] - twice[i]));
        CHECK(worst < 4e-6f);
    }
    horizons narrow({32, 9}, 8);
    CHECK(fit_slices(map.view(), map.directions, {8}, {}, {}, narrow.view()).code() == error::mismatch);
}

TEST_CASE("rows of numbers: rounded as the scalar functions do, and read back within half a step") {
    std::vector<float> values{0.0f, 1.0f, 0.99999994f, 0.5f, 0.00196f, 6.1e-5f, 6.0e-5f, 5.97e-8f, 2.9e-8f, 1e-30f};
    for (int i = 0; i < 4000; ++i) values.push_back(float(i) / 4000.0f * (i % 7 == 0 ? 0.001f : 1.0f));
    const int count = int(values.size());
    std::vector<std::byte> bytes(values.size() * 4);
    std::vector<float> back(values.size());
    write_row(texel_format::r8, values.data(), count, bytes.data());
    read_row(texel_format::r8, bytes.data(), 0, count, back.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        CHECK(std::to_integer<int>(bytes[i]) == int(to_unorm8(values[i])));
        CHECK(std::abs(back[i] - values[i]) <= 1.0f / 510.0f + 1e-7f);
    }
    const auto number = [&](std::size_t i) {
        return std::to_integer<int>(bytes[2 * i]) + 256 * std::to_integer<int>(bytes[2 * i + 1]);
    };
    write_row(texel_format::r16, values.data(), count, bytes.data());
    read_row(texel_format::r16, bytes.data(), 0, count, back.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        CHECK(number(i) == int(to_unorm16(values[i])));
        CHECK(std::abs(back[i] - values[i]) <= 1.0f / 131070.0f + 1e-7f);
    }
    write_row(texel_format::r16f, values.data(), count, bytes.data());
    read_row(texel_format::r16f, bytes.data(), 0, count, back.data());
    for (std::size_t i = 0; i < values.size(); ++i) {
        CAPTURE(values[i]);
        CHECK(number(i) == int(to_half(values[i])));
        CHECK(std::abs(back[i] - values[i]) <= 1.0f / 4096.0f);
    }
    read_row(texel_format::r16f, bytes.data(), 5, 3, back.data());  // from the middle of a row
    CHECK(back[0] == from_half(to_half(values[5])));
}
