#include <bumpshadow/encode/sine_layers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "support/textures.hpp"

using namespace bumpshadow;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

pack_options with(slice_fit fit) {
    pack_options options;
    options.fit = fit;
    return options;
}

horizons noisy(glm::ivec2 extent, int bearings, std::uint64_t seed) {
    shapes::noise noise(seed);
    horizons h(extent, bearings);
    for (float& s : h.slopes) s = float(noise.uniform() * 1.5 - 0.2);
    return h;
}

double sine(double slope) { return slope <= 0.0 ? 0.0 : slope / std::sqrt(1.0 + slope * slope); }

}  // namespace

TEST_CASE("sine layers: equations 5.1 and 5.2 worked by hand") {
    // A texel 3 higher at (4, 0): tan^2 = 9/16, sine 1 / sqrt(16/9 + 1) = 0.6. One 4 higher at (2, sqrt(5)): tan^2 =
    // 16/9, sine 0.8. One 5 higher at (5, 0): sine 1 / sqrt(2).
    const auto tangent_square = [](double dh, double dx, double dy) { return dh * dh / (dx * dx + dy * dy); };
    const auto published_sine = [](double square) { return 1.0 / std::sqrt(1.0 / square + 1.0); };
    CHECK(published_sine(tangent_square(3, 4, 0)) == doctest::Approx(0.6));
    CHECK(published_sine(tangent_square(4, 2, std::sqrt(5.0))) == doctest::Approx(0.8));
    for (const double slope : {0.01, 0.75, 4.0 / 3.0, 1.0, 57.0})
        CHECK(double(quantity_of_slope(quantity::sine, float(slope))) ==
              doctest::Approx(published_sine(slope * slope)).epsilon(1e-6));
}

TEST_CASE("sine layers: golden bytes, as an array and as two textures") {
    horizons h({2, 1}, 8);
    // Sines 0.6, 0.8, 1/sqrt(2), 0, 0, sqrt(3/4), 0 and 1 times 255: 153, 204, 180.3, 0, 0, 220.8, 0, 255.
    const float slopes[8] = {0.75f, 4.0f / 3.0f, 1.0f, 0.0f, -1.0f, std::sqrt(3.0f), no_horizon, 1e30f};
    for (int i = 0; i < 8; ++i) {
        h.at(i, 0, 0) = slopes[i];
        h.at(i, 1, 0) = slopes[7 - i];
    }
    const int golden[2][8] = {{153, 204, 180, 0, 255, 0, 221, 0}, {0, 221, 0, 255, 0, 180, 204, 153}};
    const auto directions = shapes::directions(8);
    for (const bool separate : {false, true}) {
        const sine_layers encoding{.separate = separate};
        textures out(encoding, h.extent);
        REQUIRE(bool(pack_sine_layers(h.view(), directions, encoding, with(slice_fit::point), out.views)));
        for (std::size_t i = 0; i < 8; ++i) {
            CHECK(out.byte(0, i) == golden[0][i]);
            CHECK((separate ? out.byte(1, i) : out.byte(0, 8 + i)) == golden[1][i]);
        }
    }
    CHECK(layout_of(sine_layers{}, {3, 5}).bytes_per_texel({3, 5}) == 8.0);
    CHECK(fetches(sine_layers{}) == 2);
}

TEST_CASE("sine layers: slopes in place of sines, clamped and counted") {
    horizons h({1, 1}, 8);
    const float slopes[8] = {1.0f, 2.0f, 4.0f, 5.0f, 400.0f, -3.0f, 0.0f, 3.0f};
    for (int i = 0; i < 8; ++i) h.at(i, 0, 0) = slopes[i];
    const sine_layers encoding{.scale = {quantity::slope, 4.0f}};
    textures out(encoding, h.extent);
    pack_report report;
    pack_options options = with(slice_fit::point);
    options.report = &report;
    REQUIRE(bool(pack_sine_layers(h.view(), shapes::directions(8), encoding, options, out.views)));
    const int golden[8] = {64, 128, 255, 255, 255, 0, 0, 191};
    for (std::size_t i = 0; i < 8; ++i) CHECK(out.byte(0, i) == golden[i]);
    CHECK(report.clamped == 2);
    CHECK(report.steepest == 400.0f);
}

TEST_CASE("sine layers: the average of five of 32") {
    horizons h = noisy({150, 3}, 32, 11);
    h.at(5, 0, 0) = 1e30f;
    h.at(6, 0, 0) = no_horizon;
    for (int i = 0; i < 32; ++i) h.at(i, 1, 0) = 1e30f;  // five fifths of 1
    const auto directions = shapes::directions(32);
    const sine_layers encoding{};
    textures out(encoding, h.extent);
    REQUIRE(bool(pack_sine_layers_averaged(h.view(), directions, encoding, {}, out.views)));
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 150; ++x)
            for (int i = 0; i < 8; ++i) {
                double average = 0.0;
                for (int d = -2; d <= 2; ++d) average += sine(double(h.at((4 * i + d + 32) % 32, x, y))) / 5.0;
                const int byte = out.byte(0, std::size_t((((i / 4) * 3 + y) * 150 + x) * 4 + i % 4));
                CHECK(std::abs(byte - 255.0 * average) <= 0.5 + 1e-3);
            }
    CHECK(out.byte(0, 4) == 255);

    // Any order, any length.
    std::vector<glm::dvec2> turned(directions.rbegin(), directions.rend());
    for (glm::dvec2& d : turned) d *= 3.0;
    horizons reversed(h.extent, 32);
    for (int i = 0; i < 32; ++i)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 150; ++x) reversed.at(i, x, y) = h.at(31 - i, x, y);
    textures again(encoding, h.extent);
    REQUIRE(bool(pack_sine_layers_averaged(reversed.view(), turned, encoding, {}, again.views, threads(2))));
    CHECK(again.bytes == out.bytes);
}

TEST_CASE("sine layers: least squares against the normal equations of one texel") {
    // 24 directions, dense equations of the eight tents, solved by elimination.
    horizons h = noisy({7, 2}, 24, 12);
    for (float& s : h.slopes) s = 1.0f + 0.5f * s;  // the fit stays inside 0 and 1
    const auto directions = shapes::directions(24, 0.013);
    const sine_layers encoding{};
    textures out(encoding, h.extent);
    REQUIRE(bool(pack_sine_layers(h.view(), directions, encoding, {}, out.views)));
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 7; ++x) {
            double a[8][9] = {};
            for (int m = 0; m < 24; ++m) {
                double tents[8];
                for (int i = 0; i < 8; ++i) {
                    double away = 8.0 * (0.013 + m / 24.0) - i;
                    away -= 8.0 * std::round(away / 8.0);
                    tents[i] = std::max(0.0, 1.0 - std::abs(away));
                }
                for (int i = 0; i < 8; ++i) {
                    for (int j = 0; j < 8; ++j) a[i][j] += tents[i] * tents[j];
                    a[i][8] += tents[i] * sine(double(h.at(m, x, y)));
                }
            }
            for (int i = 0; i < 8; ++i)
                for (int r = 0; r < 8; ++r)
                    if (r != i)
                        for (int c = 8; c >= i; --c) a[r][c] -= a[r][i] / a[i][i] * a[i][c];
            for (int i = 0; i < 8; ++i) {
                const double wanted = std::clamp(a[i][8] / a[i][i], 0.0, 1.0);
                const int byte = out.byte(0, std::size_t((((i / 4) * 2 + y) * 7 + x) * 4 + i % 4));
                CHECK(std::abs(byte - 255.0 * wanted) <= 0.5 + 2e-3);
            }
        }
}

TEST_CASE("sine layers: levels") {
    horizons h = noisy({5, 3}, 32, 13), small = noisy({2, 1}, 32, 14);
    const auto directions = shapes::directions(32);
    const horizon_map levels[2] = {h.view(), small.view()};
    const std::span<const horizon_map> both(levels);
    for (const bool separate : {false, true}) {
        const sine_layers encoding{.separate = separate};
        textures all(encoding, h.extent, 2), first(encoding, h.extent), second(encoding, small.extent);
        REQUIRE(bool(pack_sine_layers(both, directions, encoding, {}, all.views)));
        REQUIRE(bool(pack_sine_layers(h.view(), directions, encoding, {}, first.views)));
        REQUIRE(bool(pack_sine_layers(small.view(), directions, encoding, {}, second.views)));
        for (int layer = 0; layer < 2; ++layer) {
            const std::size_t t = separate ? std::size_t(layer) : 0;
            const int l = separate ? 0 : layer;
            CHECK(std::equal(all.views[t].slice(l, 0), all.views[t].slice(l, 1), first.views[t].slice(l, 0)));
            CHECK(std::equal(all.views[t].slice(l, 1), all.views[t].slice(l, 1) + 8, second.views[t].slice(l, 0)));
        }
    }
}

TEST_CASE("sine layers: bad input leaves the textures alone") {
    horizons h = noisy({4, 4}, 32, 15);
    const auto directions = shapes::directions(32);
    const sine_layers encoding{};
    textures out(encoding, h.extent);
    const std::span<const texture> views(out.views);

    horizons eight = noisy({4, 4}, 8, 16);
    CHECK(pack_sine_layers_averaged(eight.view(), shapes::directions(8), encoding, {}, views).code() ==
          error::mismatch);
    CHECK(pack_sine_layers_averaged(h.view(), shapes::directions(32, 0.001), encoding, {}, views).code() ==
          error::mismatch);
    CHECK(
        pack_sine_layers(eight.view(), shapes::directions(8, 0.001), encoding, with(slice_fit::point), views).code() ==
        error::mismatch);
    CHECK(pack_sine_layers(h.view(), shapes::directions(31), encoding, {}, views).code() == error::mismatch);
    horizons six = noisy({4, 4}, 6, 17);
    CHECK(pack_sine_layers(six.view(), shapes::directions(6), encoding, {}, views).code() == error::too_small);
    CHECK(pack_sine_layers(std::span<const horizon_map>(), directions, encoding, {}, views).code() == error::missing);
    CHECK(pack_sine_layers(h.view(), directions, encoding, {}, {}).code() == error::mismatch);
    CHECK(pack_sine_layers(h.view(), directions, {.separate = true}, {}, views).code() == error::mismatch);
    CHECK(pack_sine_layers(h.view(), directions, {.scale = {quantity::slope, infinity}}, {}, views).code() ==
          error::not_finite);
    CHECK(pack_sine_layers(h.view(), directions, {.scale = {quantity::sine, 0.0f}}, {}, views).code() ==
          error::not_positive);
    texture shorter = out.views[0];
    shorter.bytes = shorter.bytes.first(shorter.bytes.size() - 1);
    CHECK(pack_sine_layers(h.view(), directions, encoding, {}, {&shorter, 1}).code() == error::too_small);
    texture other = out.views[0];
    other.layout.format = texel_format::r8;
    CHECK(pack_sine_layers(h.view(), directions, encoding, {}, {&other, 1}).code() == error::mismatch);
    horizon_map wide = h.view();
    wide.extent.x = 3;
    CHECK(pack_sine_layers(wide, directions, encoding, {}, views).code() == error::mismatch);
    horizon_map empty = h.view();
    empty.extent = {0, 0};
    CHECK(!pack_sine_layers(empty, directions, encoding, {}, views));
    pack_options little;
    std::byte scratch[16];
    little.scratch = scratch;
    CHECK(pack_sine_layers(h.view(), directions, encoding, little, views).code() == error::too_small);
    CHECK(out.untouched());
}

TEST_CASE("sine layers: scratch of the stated size is enough") {
    horizons h = noisy({33, 40}, 32, 18);
    const auto directions = shapes::directions(32);
    textures one(sine_layers{}, h.extent), two(sine_layers{}, h.extent);
    std::vector<std::byte> scratch(slice_scratch_size(h.extent, 32, 32));
    pack_options options;
    options.scratch = scratch;
    REQUIRE(bool(pack_sine_layers_averaged(h.view(), directions, {}, options, one.views)));
    REQUIRE(bool(pack_sine_layers_averaged(h.view(), directions, {}, {}, two.views, threads(3))));
    CHECK(one.bytes == two.bytes);
    scratch.resize(slice_scratch_size(h.extent, 32, 8));
    options.scratch = scratch;
    CHECK(bool(pack_sine_layers(h.view(), directions, {}, options, one.views)));
}
