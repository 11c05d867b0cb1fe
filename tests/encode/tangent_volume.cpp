// Forsyth's volume: bytes by hand, round trips of each format, the coordinate, mips, half the slices, his memory table.

#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/shader/shader.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/horizons.hpp"

using namespace bumpshadow;

namespace {

// A texture that owns its bytes.
struct stored {
    texture_layout layout;
    std::vector<std::byte> bytes;

    stored(const tangent_volume& encoding, glm::ivec2 extent, int mips = 1)
        : layout(layout_of(encoding, extent, mips)), bytes(layout.required_size(), std::byte{0xcd}) {}
    [[nodiscard]] texture view() { return {bytes, layout}; }
    [[nodiscard]] float at(int level, int slice, int x, int y) const {
        float value = 0.0f;
        tangent_volume_detail::read_texels(const_texture{bytes, layout}, level, slice, x, y, 1, &value);
        return value;
    }
};

// What a sampler that repeats makes of a coordinate, at a texel's center: linear between the centers of n slices.
float sampled(const stored& t, int level, double coordinate, int x, int y) {
    const int n = t.layout.level_depth(level);
    const double place = coordinate * n - 0.5, below = std::floor(place);
    const int i = ((int(below) % n) + n) % n;
    const float part = float(place - below);
    return t.at(level, i, x, y) * (1.0f - part) + t.at(level, (i + 1) % n, x, y) * part;
}

const texel_format formats[] = {texel_format::r8, texel_format::r16, texel_format::r16f, texel_format::bc4};

}  // namespace

TEST_CASE("golden bytes of a small volume") {
    // 3 x 2 texels, 4 slices in their own directions, max_slope 2: the byte is slope / 2 * 255, rounded.
    horizons map({3, 2}, 4);
    const float slopes[4][6] = {{0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 2.5f},
                                {-1.0f, no_horizon, 0.25f, 0.125f, 0.01f, 0.003f},
                                {2.0f, 1.9f, 1.8f, 1.7f, 1.6f, 1.5f},
                                {0.0039f, 0.004f, 1.996f, 1.9961f, 0.0f, 1e30f}};
    for (int i = 0; i < 4; ++i)
        for (int t = 0; t < 6; ++t) map.at(i, t % 3, t / 3) = slopes[i][t];
    const int wanted[4][6] = {
        {0, 64, 128, 191, 255, 255}, {0, 0, 32, 16, 1, 0}, {255, 242, 230, 217, 204, 191}, {0, 1, 254, 255, 0, 255}};
    tangent_volume encoding{{4}, {quantity::slope, 2.0f}};
    stored t(encoding, map.extent);
    pack_report report;
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, encoding, {.fit = slice_fit::point, .report = &report},
                                     t.view())));
    REQUIRE(t.bytes.size() == 24);
    for (std::size_t i = 0; i < 24; ++i) CHECK(std::to_integer<int>(t.bytes[i]) == wanted[i / 6][i % 6]);
    CHECK(report.clamped == 2);
    CHECK(report.steepest == 1e30f);

    encoding.format = texel_format::r16;  // little-endian: 0.5 / 2 * 65535 = 16383.75
    stored wide(encoding, map.extent);
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, encoding, {.fit = slice_fit::point}, wide.view())));
    CHECK(std::to_integer<int>(wide.bytes[2]) == 0x00);
    CHECK(std::to_integer<int>(wide.bytes[3]) == 0x40);
    encoding.format = texel_format::r16f;  // a quarter is 0x3400
    stored half(encoding, map.extent);
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, encoding, {.fit = slice_fit::point}, half.view())));
    CHECK(std::to_integer<int>(half.bytes[2]) == 0x00);
    CHECK(std::to_integer<int>(half.bytes[3]) == 0x34);
}

TEST_CASE("round trip of every format within its bound") {
    const horizons map = horizons::random({13, 9}, 16, 21);  // no multiple of a block
    for (const texture_kind kind : {texture_kind::volume, texture_kind::array})
        for (const texel_format format : formats) {
            const tangent_volume encoding{{16, 0.0, bearing_function::exact}, {quantity::slope, 1.5f}, format, kind};
            stored t(encoding, map.extent);
            REQUIRE(
                bool(pack_tangent_volume(map.view(), map.directions, encoding, {.fit = slice_fit::point}, t.view())));
            // Blocks of noise: all values, ends included, lie within half a step of seven between any two.
            const float bound = format == texel_format::r8    ? 1.0f / 510.0f
                                : format == texel_format::r16 ? 1.0f / 131070.0f
                                : format == texel_format::bc4 ? 0.5f
                                                              : 1.0f / 4096.0f;
            float worst = 0.0f;
            double sum = 0.0;
            for (int i = 0; i < 16; ++i)
                for (int y = 0; y < 9; ++y)
                    for (int x = 0; x < 13; ++x) {
                        const float error = std::abs(t.at(0, i, x, y) - std::clamp(map.at(i, x, y) / 1.5f, 0.0f, 1.0f));
                        worst = std::max(worst, error);
                        sum += double(error) * double(error);
                    }
            CHECK(worst <= bound + 2e-7f);
            // A ramp of eight levels over [0, 1] has a step of 1/7; nearest values are off by 1/7/sqrt(12) = 0.041.
            if (format == texel_format::bc4) CHECK(std::sqrt(sum / (16.0 * 9.0 * 13.0)) < 0.0413);
        }
}

TEST_CASE("layout: bytes a texel and fetches") {
    tangent_volume encoding{{8}};
    CHECK(layout_of(encoding, {64, 32}).bytes_per_texel({64, 32}) == 8.0);
    CHECK(layout_of(encoding, {64, 32}).depth == 8);
    CHECK(fetches(encoding) == 1);
    encoding.format = texel_format::bc4;
    encoding.slices.count = 16;
    CHECK(layout_of(encoding, {64, 32}).bytes_per_texel({64, 32}) == 8.0);
    encoding.kind = texture_kind::array;
    CHECK(layout_of(encoding, {64, 32}).layers == 16);
    CHECK(layout_of(encoding, {64, 32}).depth == 1);
    CHECK(fetches(encoding) == 2);
}

TEST_CASE("the volume coordinate of a slice's bearing hits the center of its texel") {
    for (const int count : {1, 4, 7, 16})
        for (const double phase : {0.0, 0.125, -0.3}) {
            const tangent_volume encoding{{count, phase}};
            for (int i = 0; i < count; ++i) {
                const double bearing = phase + double(i) / count;
                const float coordinate =
                    shader::bumpshadow_volume_coordinate(float(bearing), float(coordinate_offset(encoding)));
                CHECK(double(coordinate) == doctest::Approx((i + 0.5) / count).epsilon(1e-6));
            }
        }
}

TEST_CASE("array layers of a bearing: parts add up, both signs, across the seam") {
    for (const float slices : {1.0f, 3.0f, 12.0f, 16.0f})
        for (const float phase : {0.0f, 0.25f, -0.1f})
            for (int k = -700; k <= 1700; ++k) {
                const float bearing = float(k) / 1000.0f;
                const shader::vec3 l = shader::bumpshadow_tangent_layers(bearing, phase, slices);
                CHECK(l.x >= 0.0f);
                CHECK(l.x < slices);
                CHECK(l.x == std::floor(l.x));
                CHECK(l.y == (l.x + 1.0f < slices ? l.x + 1.0f : 0.0f));
                CHECK(l.z >= 0.0f);
                CHECK(l.z <= 1.0f);
                double position = (double(bearing) - double(phase)) * double(slices);
                position -= double(slices) * std::floor(position / double(slices));
                double apart = std::abs(double(l.x + l.z) - position);
                apart = std::min(apart, double(slices) - apart);
                CHECK(apart < 1e-5);
            }
    CHECK(shader::bumpshadow_tangent_horizon(0.25f, 0.75f, 0.5f) == 0.5f);
}

TEST_CASE("decoded slices reproduce horizons that are linear between them, in both kinds") {
    // Every texel is a zigzag over 8 slices; 32 bearings of it are baked.
    const slice_set slices{8, 0.125, bearing_function::octant};
    horizons map({4, 3}, 32);
    const auto zigzag = [&](double bearing, int x) {
        double p = (bearing - slices.phase) * 8.0;
        p -= 8.0 * std::floor(p / 8.0);
        const auto corner = [&](int i) { return double((i * 5 + x * 3) % 8) / 8.0; };
        const int i = int(p);
        return corner(i % 8) * (1.0 - (p - i)) + corner((i + 1) % 8) * (p - i);
    };
    for (int j = 0; j < 32; ++j)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 4; ++x)
                map.at(j, x, y) = float(2.0 * zigzag(octant_bearing(map.directions[std::size_t(j)]), x));
    tangent_volume encoding{slices, {quantity::slope, 2.0f}, texel_format::r16};
    stored volume(encoding, map.extent);
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, encoding, {}, volume.view())));
    encoding.kind = texture_kind::array;
    stored array(encoding, map.extent);
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, encoding, {}, array.view())));
    CHECK(volume.bytes == array.bytes);
    for (int k = 0; k < 97; ++k) {
        const glm::dvec2 d = shapes::direction(k / 97.0);
        const float bearing = shader::bumpshadow_bearing_octant(shader::vec2(float(d.x), float(d.y)));
        for (int x = 0; x < 4; ++x) {
            const double wanted = zigzag(octant_bearing(d), x);
            const float offset = float(coordinate_offset(encoding));
            CHECK(double(sampled(volume, 0, double(shader::bumpshadow_volume_coordinate(bearing, offset)), x, 1)) ==
                  doctest::Approx(wanted).epsilon(3e-5));
            const shader::vec3 l = shader::bumpshadow_tangent_layers(bearing, float(slices.phase), 8.0f);
            CHECK(double(shader::bumpshadow_tangent_horizon(array.at(0, int(l.x), x, 1), array.at(0, int(l.y), x, 1),
                                                            l.z)) == doctest::Approx(wanted).epsilon(3e-5));
        }
    }
}

TEST_CASE("mips of a volume stand where the unchanged coordinate finds them") {
    const tangent_volume encoding{{8, 0.125, bearing_function::exact}};
    // Level 1 has 4 slices; center (2 j + 1) / 8 of coordinate bearing - phase + 1/16, so bearing phase + (2 j + 0.5)
    // / 8.
    const slice_set first = slices_of_level(encoding, 1);
    CHECK(first.count == 4);
    for (int j = 0; j < 4; ++j)
        CHECK(first.phase + j / 4.0 == doctest::Approx(0.125 + (2.0 * j + 0.5) / 8.0).epsilon(1e-12));
    CHECK(slices_of_level(encoding, 0).phase == doctest::Approx(0.125));
    CHECK(slices_of_level(encoding, 5).count == 1);

    // Horizons that grow and fall linearly with the bearing over half a turn each: what a level decodes at its centers
    // is that triangle, but for its two corners.
    horizons map({8, 4}, 64);
    const auto triangle = [](double bearing) { return 2.0 * std::abs(bearing - std::floor(bearing + 0.5)); };
    for (int j = 0; j < 64; ++j)
        for (int t = 0; t < 32; ++t) map.at(j, t % 8, t / 8) = float(triangle(j / 64.0));
    horizons half({4, 2}, 64);
    for (int j = 0; j < 64; ++j)
        for (int t = 0; t < 8; ++t) half.at(j, t % 4, t / 4) = float(triangle(j / 64.0));
    tangent_volume fine = encoding;
    fine.slices.count = 16;
    fine.scale.max_slope = 1.0f;
    fine.format = texel_format::r16;
    stored t(fine, map.extent, 2);
    const horizon_map levels[] = {map.view(), half.view()};
    REQUIRE(bool(pack_tangent_volume(levels, map.directions, fine, {}, t.view())));
    for (int k = 0; k < 64; ++k) {
        const double bearing = k / 64.0;
        if (std::abs(bearing) < 0.13 || std::abs(bearing - 0.5) < 0.13 || bearing > 0.87) continue;
        CHECK(double(sampled(t, 1, bearing + coordinate_offset(fine), 1, 1)) ==
              doctest::Approx(triangle(bearing)).epsilon(0.01));
    }
    CHECK(pack_tangent_volume(levels, map.directions, fine, {.fit = slice_fit::point}, t.view()).code() ==
          error::not_supported);
}

TEST_CASE("half the slices: dropped bytes are those of a pack of half, fitted ones are closer") {
    const horizons map = horizons::random({12, 8}, 32, 4);
    for (const texel_format format : formats)
        for (const texture_kind kind : {texture_kind::volume, texture_kind::array}) {
            const tangent_volume encoding{{16, 0.0, bearing_function::exact}, {quantity::slope, 2.0f}, format, kind};
            const tangent_volume half = halved(encoding);
            CHECK(half.slices.count == 8);
            stored whole(encoding, map.extent), dropped(half, map.extent), direct(half, map.extent),
                fitted(half, map.extent);
            REQUIRE(bool(
                pack_tangent_volume(map.view(), map.directions, encoding, {.fit = slice_fit::point}, whole.view())));
            REQUIRE(
                bool(pack_tangent_volume(map.view(), map.directions, half, {.fit = slice_fit::point}, direct.view())));
            REQUIRE(bool(halve_slices(whole.view(), encoding, {.fit = slice_fit::point}, dropped.view(), threads(2))));
            CHECK(dropped.bytes == direct.bytes);
            REQUIRE(bool(halve_slices(whole.view(), encoding, {}, fitted.view())));
            double error_of_dropped = 0.0, error_of_fitted = 0.0;
            for (int i = 0; i < 16; ++i)
                for (int t = 0; t < 96; ++t) {
                    const int x = t % 12, y = t / 12, a = i / 2, b = (a + i % 2) % 8;
                    const auto error = [&](const stored& s) {
                        const double e =
                            0.5 * (double(s.at(0, a, x, y)) + double(s.at(0, b, x, y))) - double(whole.at(0, i, x, y));
                        return e * e;
                    };
                    error_of_dropped += error(dropped);
                    error_of_fitted += error(fitted);
                }
            CHECK(error_of_fitted < 0.9 * error_of_dropped);
        }
    const tangent_volume odd{{5}};
    stored t(odd, {4, 4});
    CHECK(halve_slices(t.view(), odd, {}, t.view()).code() == error::not_a_multiple);
}

TEST_CASE("every executor writes the same bytes") {
    const horizons map = horizons::random({70, 50}, 32, 9);
    const horizons half = horizons::random({35, 25}, 32, 10);
    const horizon_map levels[] = {map.view(), half.view()};
    for (const texel_format format : formats) {
        const tangent_volume encoding{{8}, {}, format};
        stored one(encoding, map.extent, 2), many(encoding, map.extent, 2);
        pack_report first, second;
        REQUIRE(bool(pack_tangent_volume(levels, map.directions, encoding, {.report = &first}, one.view())));
        REQUIRE(
            bool(pack_tangent_volume(levels, map.directions, encoding, {.report = &second}, many.view(), threads(3))));
        CHECK(one.bytes == many.bytes);
        CHECK(first.clamped == second.clamped);
        CHECK(first.steepest == second.steepest);
    }
}

TEST_CASE("the memory table of the paper") {
    // Forsyth, section 5: kbytes.
    const std::array<double, 8> published{1024, 128, 1024, 256, 4096, 1024, 256, 128};
    const auto table = memory_table({512, 512});
    for (std::size_t i = 0; i < published.size(); ++i) CHECK(table[i].kbytes == published[i]);
    CHECK(table[7].extent == glm::ivec2(128, 128));
    CHECK(table[7].slices == 8);
    static_assert(texture_kbytes({512, 512}, 1, 4.0) == 128.0);
}

TEST_CASE("bad input is named and nothing is written") {
    const horizons map = horizons::random({8, 4}, 16, 1);
    tangent_volume encoding{{8}};
    stored t(encoding, map.extent);
    texture out = t.view();
    const auto code = [&] {
        const status s = pack_tangent_volume(map.view(), map.directions, encoding, {}, out);
        CHECK(s.message().view().size() > 4);
        CHECK(std::all_of(t.bytes.begin(), t.bytes.end(), [](std::byte b) { return b == std::byte{0xcd}; }));
        return s.code();
    };
    encoding.format = texel_format::rgba8;
    CHECK(code() == error::not_supported);
    encoding.format = texel_format::r16;
    CHECK(code() == error::mismatch);
    encoding.format = texel_format::r8;
    encoding.kind = texture_kind::cube;
    CHECK(code() == error::not_supported);
    encoding.kind = texture_kind::array;
    CHECK(code() == error::mismatch);
    encoding.kind = texture_kind::volume;
    encoding.slices.count = 4;
    CHECK(code() == error::mismatch);
    encoding.slices.count = 8;
    encoding.scale.max_slope = -1.0f;
    CHECK(code() == error::not_positive);
    encoding.scale.max_slope = 4.0f;
    out.bytes = out.bytes.first(out.bytes.size() - 1);
    CHECK(code() == error::too_small);
    out = t.view();
    out.layout.extent.x = 7;
    CHECK(code() == error::mismatch);
    CHECK(pack_tangent_volume(std::span<const horizon_map>{}, map.directions, encoding, {}, t.view()).code() ==
          error::missing);
    const horizon_map levels[] = {map.view(), map.view()};  // the second one is not half as large
    stored mips(encoding, map.extent, 2);
    CHECK(pack_tangent_volume(levels, map.directions, encoding, {}, mips.view()).code() == error::mismatch);
}
