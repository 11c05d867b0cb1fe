#include <bumpshadow/measure/sample.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

std::vector<glm::ivec2> drawn(glm::ivec2 extent, std::uint32_t seed, std::size_t count) {
    std::vector<glm::ivec2> texels(count, glm::ivec2(-1));
    const status s = sample_texels(extent, seed, texels);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return texels;
}

// How often each texel was drawn.
std::vector<int> counts(glm::ivec2 extent, const std::vector<glm::ivec2>& texels) {
    std::vector<int> result(std::size_t(extent.x * extent.y));
    for (const glm::ivec2 t : texels) {
        REQUIRE(t.x >= 0);
        REQUIRE(t.y >= 0);
        REQUIRE(t.x < extent.x);
        REQUIRE(t.y < extent.y);
        ++result[std::size_t(t.y * extent.x + t.x)];
    }
    return result;
}

void check_refused(const status& s, error code, const char* argument) {
    CHECK(s.code() == code);
    CHECK(std::string_view(s.argument()) == argument);
}

}  // namespace

// The first numbers of SplitMix64 from 1234567: 6457827717110365317 3203168211198807973 9817491932198370423
// 4593380528125082431 16408922859458223821 (Rosetta Code, "Pseudo-random numbers/Splitmix64"); over 2^64, times a
// million.
TEST_CASE("the generator") {
    measure_detail::generator random(1234567);
    for (const int wanted : {350079, 173644, 532207, 249007, 889529}) CHECK(random.below(1000000) == wanted);
    for (int i = 0; i < 20; ++i) CHECK(random.below(1) == 0);
}

// From the same generator, written down in another language from the comment of sample_texels.
TEST_CASE("the same texels on every machine") {
    const auto check = [](glm::ivec2 extent, std::uint32_t seed, const std::vector<glm::ivec2>& wanted) {
        CHECK(drawn(extent, seed, wanted.size()) == wanted);
    };
    check({512, 512}, 1, {{455, 494}, {23, 64}, {269, 2}, {338, 328}, {17, 279}, {196, 260}});
    check({100, 37}, 42, {{83, 11}, {8, 20}, {47, 19}, {82, 34}, {4, 32}, {36, 32}, {65, 26}});
    check({3, 2}, 7, {{1, 0}, {2, 0}, {0, 0}, {1, 1}, {2, 1}, {0, 1}});
}

TEST_CASE("distinct as long as there are enough, then each as often as any") {
    const glm::ivec2 extents[] = {{1, 1}, {7, 5}, {5, 7}, {1, 40}, {40, 1}, {33, 3}, {16, 16}};
    for (const glm::ivec2 extent : extents) {
        const int all = extent.x * extent.y;
        for (int count = 1; count <= all; count += count < 20 ? 1 : 13)
            for (std::uint32_t seed = 0; seed < 5; ++seed)
                for (const int n : counts(extent, drawn(extent, seed, std::size_t(count)))) CHECK(n <= 1);
        for (const int n : counts(extent, drawn(extent, 3, std::size_t(all)))) CHECK(n == 1);
        for (const int n : counts(extent, drawn(extent, 3, std::size_t(3 * all)))) CHECK(n == 3);
    }
}

TEST_CASE("one in each cell of a grid that begins somewhere") {
    const glm::ivec2 extent{64, 48};
    const auto texels = drawn(extent, 11, 12);  // 4 x 3 cells of 16 x 16
    int fitting = 0;
    for (int sy = 0; sy < 16; ++sy)
        for (int sx = 0; sx < 16; ++sx) {
            std::vector<int> cells(12);
            for (const glm::ivec2 t : texels) ++cells[std::size_t((t.y + sy) % 48 / 16 * 4 + (t.x + sx) % 64 / 16)];
            fitting += std::all_of(cells.begin(), cells.end(), [](int n) { return n == 1; });
        }
    CHECK(fitting >= 1);
    CHECK(drawn(extent, 11, 12) == texels);
    CHECK(drawn(extent, 12, 12) != texels);
}

// 5 of 84 texels in 20000 runs: each is drawn 1190 times, give or take 34 (standard deviation).
TEST_CASE("every texel is equally likely") {
    const glm::ivec2 extent{12, 7};
    std::vector<int> sum(84);
    for (std::uint32_t seed = 0; seed < 20000; ++seed) {
        const auto once = counts(extent, drawn(extent, seed, 5));
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += once[i];
    }
    CHECK(*std::min_element(sum.begin(), sum.end()) > 1190 - 5 * 34);
    CHECK(*std::max_element(sum.begin(), sum.end()) < 1190 + 5 * 34);
}

TEST_CASE("texels cannot be drawn from nothing") {
    std::vector<glm::ivec2> texels(4);
    check_refused(sample_texels({0, 5}, 1, texels), error::not_positive, "extent.x");
    check_refused(sample_texels({5, -1}, 1, texels), error::not_positive, "extent.y");
    check_refused(sample_texels({5, 5}, 1, {}), error::missing, "texels");
}

// Heights 0 up to x = 19 and 9.5 from 20 on: from d texels before the step the horizon towards it is 9.5 / d, and 0 the
// other way, along the step, and on top.
TEST_CASE("horizons before a wall") {
    const auto field = shapes::sampled<float>({40, 6}, shapes::step(20, 9.5));
    auto map = field.view(edge_mode::clamp);
    const std::vector<glm::ivec2> texels{{19, 0}, {0, 5}, {10, 2}, {30, 3}};
    const std::vector<glm::dvec2> directions{{1.0, 0.0}, {-3.0, 0.0}, {0.0, 1.0}};
    std::vector<float> slopes(12, -7.0f);
    REQUIRE(sample_horizons(map, texels, directions, slopes));
    const float wanted[12] = {9.5f, 9.5f / 20.0f, 9.5f / 10.0f, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 12; ++i) CHECK(double(slopes[i]) == doctest::Approx(double(wanted[i])));

    bake_options options;
    options.radius = 10.5;
    REQUIRE(sample_horizons(map, texels, directions, slopes, options));
    CHECK(slopes[1] == doctest::Approx(0.0));
    CHECK(slopes[2] == doctest::Approx(0.95));
}

TEST_CASE("the same as exact_horizon, whoever runs it") {
    shapes::noise source(5);
    auto field = shapes::sampled<float>({70, 50}, shapes::rough(source));
    field.at(20, 30) = std::numeric_limits<float>::quiet_NaN();
    auto map = field.view();
    map.no_data = std::numeric_limits<float>::quiet_NaN();
    auto texels = drawn({70, 50}, 1, 131);
    texels.push_back({20, 30});
    const auto directions = shapes::directions(5, 0.03);
    std::vector<float> slopes(texels.size() * 5 + 3, -7.0f), again(slopes);
    REQUIRE(sample_horizons(map, texels, directions, slopes));
    for (std::size_t d = 0; d < 5; ++d) {
        for (std::size_t t = 0; t < texels.size(); ++t)
            CHECK(slopes[d * texels.size() + t] == float(exact_horizon(map, texels[t], directions[d]).slope));
        CHECK(slopes[d * texels.size() + 131] == no_horizon);
    }
    CHECK(slopes.back() == -7.0f);

    bake_options options;
    std::vector<std::byte> scratch(sample_scratch_size(map));
    options.scratch = scratch;
    REQUIRE(sample_horizons(map, texels, directions, again, options, threads(3)));
    CHECK(again == slopes);
}

TEST_CASE("a sample of horizons that cannot be taken is refused") {
    auto field = shapes::sampled<float>({8, 6}, shapes::plane(1.0));
    const std::vector<glm::dvec2> directions{{1.0, 0.0}, {0.0, 1.0}};
    std::vector<glm::ivec2> texels{{7, 5}, {0, 0}};
    std::vector<float> slopes(4, -7.0f);
    const auto take = [&](const bake_options& options = {}) {
        return sample_horizons(field.view(), texels, directions, slopes, options);
    };
    texels[1] = {8, 0};
    check_refused(take(), error::out_of_range, "texels x");
    texels[1] = {0, -1};
    check_refused(take(), error::out_of_range, "texels y");
    texels[1] = {0, 0};
    check_refused(sample_horizons(field.view(), {}, directions, slopes), error::missing, "texels");
    check_refused(sample_horizons(field.view(), texels, {}, slopes), error::not_positive, "bearings");
    check_refused(sample_horizons(field.view(), texels, directions, std::span(slopes).first(3)), error::too_small,
                  "slopes");
    check_refused(sample_horizons(height_map<float>{}, texels, directions, slopes), error::missing, "heights.samples");
    std::byte little[8];
    bake_options options;
    options.scratch = little;
    check_refused(take(options), error::too_small, "options.scratch");
    field.at(3, 2) = std::numeric_limits<float>::infinity();
    check_refused(take(), error::not_finite, "height");
    for (const float s : slopes) CHECK(s == -7.0f);
}
