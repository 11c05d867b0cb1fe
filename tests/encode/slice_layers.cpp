// Slices in the channels of layers: golden bytes, decoding against linear interpolation, both groupings.

#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/shader/shader.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/horizons.hpp"

using namespace bumpshadow;

namespace {

struct stored {
    texture_layout layout;
    std::vector<std::byte> bytes;

    stored(const slice_layers& encoding, glm::ivec2 extent, int mips = 1)
        : layout(layout_of(encoding, extent, mips)), bytes(layout.required_size(), std::byte{0xcd}) {}
    [[nodiscard]] texture view() { return {bytes, layout}; }
    [[nodiscard]] shader::vec4 at(float layer, int x, int y) const {
        REQUIRE(layer == std::floor(layer));
        REQUIRE(layer >= 0.0f);
        REQUIRE(layer < float(layout.layers));
        const const_texture t{bytes, layout};
        const std::byte* const texel =
            t.slice(int(layer), 0) + std::size_t(y) * layout.row_bytes(0) + 4 * std::size_t(x);
        const auto channel = [&](int c) { return float(std::to_integer<int>(texel[c])) / 255.0f; };
        return {channel(0), channel(1), channel(2), channel(3)};
    }
};

// Through the snippets, as a shader does it.
float decoded(const stored& t, const slice_layers& encoding, float bearing, int x, int y) {
    const float slices = float(encoding.slices.count);
    const float position = shader::bumpshadow_slice_position(bearing, float(encoding.slices.phase), slices);
    if (encoding.grouping == slice_grouping::overlapping) {
        const shader::vec2 l = shader::bumpshadow_overlapping_layer(position);
        return shader::bumpshadow_overlapping_horizon(t.at(l.x, x, y), l.y);
    }
    const shader::vec3 l = shader::bumpshadow_grouped_layers(position, slices / 4.0f);
    return shader::bumpshadow_grouped_horizon(t.at(l.x, x, y), t.at(l.y, x, y).x, l.z);
}

constexpr slice_grouping groupings[] = {slice_grouping::four, slice_grouping::overlapping};

}  // namespace

TEST_CASE("golden bytes: neighbors in the channels") {
    // One texel, 12 slices; slice i has the slope (i + 1) / 255.
    horizons map({1, 1}, 12);
    for (int i = 0; i < 12; ++i) map.at(i, 0, 0) = float(i + 1) / 255.0f;
    slice_layers encoding{{12, 0.0, bearing_function::exact}, {quantity::slope, 1.0f}, slice_grouping::four};
    stored four(encoding, {1, 1});
    REQUIRE(bool(pack_slice_layers(map.view(), map.directions, encoding, {.fit = slice_fit::point}, four.view())));
    REQUIRE(four.bytes.size() == 12);
    for (int i = 0; i < 12; ++i) CHECK(std::to_integer<int>(four.bytes[std::size_t(i)]) == i + 1);

    encoding.grouping = slice_grouping::overlapping;
    stored overlapping(encoding, {1, 1});
    REQUIRE(
        bool(pack_slice_layers(map.view(), map.directions, encoding, {.fit = slice_fit::point}, overlapping.view())));
    const int wanted[16] = {1, 2, 3, 4, 4, 5, 6, 7, 7, 8, 9, 10, 10, 11, 12, 1};
    REQUIRE(overlapping.bytes.size() == 16);
    for (std::size_t i = 0; i < 16; ++i) CHECK(std::to_integer<int>(overlapping.bytes[i]) == wanted[i]);
}

TEST_CASE("layout: bytes a texel and fetches") {
    slice_layers encoding{{16}};
    CHECK(layout_of(encoding, {32, 16}).bytes_per_texel({32, 16}) == 16.0);
    CHECK(layout_of(encoding, {32, 16}).layers == 4);
    CHECK(fetches(encoding) == 2);
    encoding = {{24}, {}, slice_grouping::overlapping};
    CHECK(layout_of(encoding, {32, 16}).layers == 8);
    CHECK(layout_of(encoding, {32, 16}).kind == texture_kind::array);
    CHECK(fetches(encoding) == 1);
}

TEST_CASE("channels and the next layer are interpolated linearly, and their parts add up to 1") {
    for (int k = 0; k <= 4000; ++k) {
        const float place = float(k) / 1000.0f;
        CHECK(std::abs(shader::bumpshadow_grouped_horizon({1, 1, 1, 1}, 1.0f, place) - 1.0f) < 1e-6f);
        CHECK(std::abs(shader::bumpshadow_grouped_horizon({0, 1, 2, 3}, 4.0f, place) - place) < 2e-6f);
    }
}

TEST_CASE("decoding is linear between slices, over the seam, at every bearing and phase") {
    for (const slice_grouping grouping : groupings)
        for (const int count : {12, 24})
            for (const double phase : {0.0, 0.125, -0.2}) {
                const slice_layers encoding{{count, phase, bearing_function::exact}, {quantity::slope, 1.0f}, grouping};
                horizons map({3, 2}, count);
                fill_directions(map.directions, phase);
                map.fill(6);
                stored t(encoding, map.extent);
                REQUIRE(
                    bool(pack_slice_layers(map.view(), map.directions, encoding, {.fit = slice_fit::point}, t.view())));
                float worst = 0.0f;
                for (int k = -300; k <= 1300; ++k) {
                    const float bearing = float(k) / 1000.0f;
                    double p = (double(bearing) - phase) * count;
                    p -= count * std::floor(p / count);
                    const int i = int(p) % count;
                    const double part = p - std::floor(p);
                    for (int x = 0; x < 3; ++x) {
                        const auto slice = [&](int n) {
                            return std::round(std::clamp(double(map.at(n % count, x, 1)), 0.0, 1.0) * 255.0) / 255.0;
                        };
                        const double wanted = slice(i) * (1.0 - part) + slice(i + 1) * part;
                        worst = std::max(worst, std::abs(decoded(t, encoding, bearing, x, 1) - float(wanted)));
                    }
                }
                CHECK(worst < 2e-5f);
            }
}

TEST_CASE("every bearing finds a layer that exists, the last ones before a full turn included") {
    for (const float slices : {3.0f, 9.0f, 12.0f, 24.0f, 36.0f, 48.0f, 96.0f}) {
        for (float position :
             {0.0f, slices, std::nextafter(slices, 0.0f), shader::bumpshadow_slice_position(-1e-9f, 0.0f, slices)}) {
            const shader::vec2 l = shader::bumpshadow_overlapping_layer(position);
            CHECK(l.x >= 0.0f);
            CHECK(l.x <= slices / 3.0f - 1.0f);
            CHECK(l.y >= -1e-5f);
            CHECK(l.y <= 3.0f + 1e-5f);
        }
        for (int i = 0; i < int(slices); ++i) {
            const shader::vec2 l = shader::bumpshadow_overlapping_layer(float(i));
            CHECK(l.x * 3.0f + l.y == float(i));
            CHECK(l.x == std::floor(l.x));
        }
    }
    for (const float slices : {4.0f, 12.0f, 16.0f, 100.0f})
        for (float position : {0.0f, 0.5f, slices, std::nextafter(slices, 0.0f)}) {
            const shader::vec3 l = shader::bumpshadow_grouped_layers(position, slices / 4.0f);
            CHECK(l.x >= 0.0f);
            CHECK(l.x <= slices / 4.0f - 1.0f);
            CHECK(l.y < slices / 4.0f);
            CHECK(l.z <= 4.0f);
        }
}

TEST_CASE("least squares, mips and executors") {
    const horizons map = horizons::random({21, 18}, 32, 3), half = horizons::random({10, 9}, 32, 4);
    const horizon_map levels[] = {map.view(), half.view()};
    for (const slice_grouping grouping : groupings) {
        const slice_layers encoding{{12}, {quantity::sine, 3.0f}, grouping};
        stored one(encoding, map.extent, 2), many(encoding, map.extent, 2), alone(encoding, half.extent);
        pack_report report, of_half;
        REQUIRE(bool(pack_slice_layers(levels, map.directions, encoding, {.report = &report}, one.view())));
        REQUIRE(bool(pack_slice_layers(levels, map.directions, encoding, {}, many.view(), threads(3))));
        REQUIRE(bool(pack_slice_layers(half.view(), map.directions, encoding, {.report = &of_half}, alone.view())));
        CHECK(one.bytes == many.bytes);
        CHECK(report.clamped == 0);
        CHECK(report.steepest == std::max(steepest_slope(map.view()), steepest_slope(half.view())));
        for (int layer = 0; layer < one.layout.layers; ++layer)
            CHECK(std::equal(one.view().slice(layer, 1), one.view().slice(layer, 1) + one.layout.slice_bytes(1),
                             alone.view().slice(layer, 0)));
    }
}

TEST_CASE("bad input is named and nothing is written") {
    const horizons map = horizons::random({4, 4}, 16, 1);
    slice_layers encoding{{8}};
    stored t(encoding, map.extent);
    texture out = t.view();
    const auto code = [&] {
        const status s = pack_slice_layers(map.view(), map.directions, encoding, {}, out);
        CHECK(s.message().view().size() > 4);
        CHECK(std::all_of(t.bytes.begin(), t.bytes.end(), [](std::byte b) { return b == std::byte{0xcd}; }));
        return s.code();
    };
    encoding.slices.count = 10;
    CHECK(code() == error::not_a_multiple);
    encoding.grouping = slice_grouping::overlapping;
    encoding.slices.count = 8;
    CHECK(code() == error::not_a_multiple);
    encoding.slices.count = 0;
    CHECK(code() == error::not_positive);
    encoding = {{8}};
    out.layout.format = texel_format::rgba16;
    CHECK(code() == error::mismatch);
    out = t.view();
    out.bytes = {};
    CHECK(code() == error::too_small);
    CHECK(pack_slice_layers(std::span<const horizon_map>{}, map.directions, encoding, {}, t.view()).code() ==
          error::missing);
}
