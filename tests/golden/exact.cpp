// Bytes that are the same on every machine and compiler: of slopes that are multiples of 1/256 of max_slope, a power
// of two, every product and sum on the way to the byte has at most 24 significant bits. So nothing is rounded before
// the last step, and it does not matter whether a compiler fuses multiplications and additions, or in which order and
// width it computes. What is expected is worked out in whole numbers.

#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "golden/slopes.hpp"

using namespace bumpshadow;

namespace {

// Byte or word of k / 256, halves up.
std::uint32_t unorm(int k, std::uint32_t last) { return (std::uint32_t(k) * last + 128u) >> 8; }

// Half precision of k / 256: 8 bits at the most, so that none are lost.
std::uint32_t half(int k) {
    if (k == 0) return 0;
    const int exponent = int(std::bit_width(unsigned(k))) - 1;
    return std::uint32_t(exponent - 8 + 15) << 10 | ((std::uint32_t(k) << (10 - exponent)) & 0x3ffu);
}

std::uint32_t stored(texel_format format, int k) {
    return format == texel_format::r8 ? unorm(k, 255u) : format == texel_format::r16 ? unorm(k, 65535u) : half(k);
}

}  // namespace

TEST_CASE("slices of 8 and 16 bits") {
    const golden::slopes map;
    for (const texel_format format : {texel_format::r8, texel_format::r16, texel_format::r16f}) {
        CAPTURE(int(format));
        tangent_volume encoding;
        encoding.slices = {.count = golden::bearings, .function = bearing_function::exact};
        encoding.scale.max_slope = golden::max_slope;
        encoding.format = format;
        const texture_layout layout = layout_of(encoding, golden::extent);
        std::vector<std::byte> bytes(layout.required_size());
        const pack_options points{.fit = slice_fit::point};
        REQUIRE(pack_tangent_volume(map.view(), map.directions, encoding, points, {bytes, layout}));

        const std::size_t each = format == texel_format::r8 ? 1 : 2;
        std::size_t wrong = 0, at = 0;
        for (int i = 0; i < golden::bearings; ++i)
            for (int y = 0; y < golden::extent.y; ++y)
                for (int x = 0; x < golden::extent.x; ++x) {
                    const std::uint32_t wanted = stored(format, golden::parts(i, x, y));
                    for (std::size_t b = 0; b < each; ++b)
                        wrong += std::to_integer<std::uint32_t>(bytes[at++]) != (wanted >> (8 * b) & 255u);
                }
        CHECK(at == bytes.size());
        CHECK(wrong == 0);
    }
}

TEST_CASE("layers of four slices, and of three that overlap") {
    const golden::slopes map;
    for (const slice_grouping grouping : {slice_grouping::four, slice_grouping::overlapping}) {
        CAPTURE(int(grouping));
        const int step = slices_per_layer(grouping), count = golden::bearings;
        slice_layers encoding;
        encoding.slices = {.count = count, .function = bearing_function::exact};
        encoding.scale.max_slope = golden::max_slope;
        encoding.grouping = grouping;
        const texture_layout layout = layout_of(encoding, golden::extent);
        std::vector<std::byte> bytes(layout.required_size());
        const pack_options points{.fit = slice_fit::point};
        REQUIRE(pack_slice_layers(map.view(), map.directions, encoding, points, {bytes, layout}));

        std::size_t wrong = 0, at = 0;
        for (int layer = 0; layer < count / step; ++layer)
            for (int y = 0; y < golden::extent.y; ++y)
                for (int x = 0; x < golden::extent.x; ++x)
                    for (int c = 0; c < 4; ++c) {
                        const int k = golden::parts((layer * step + c) % count, x, y);
                        wrong += std::to_integer<std::uint32_t>(bytes[at++]) != unorm(k, 255u);
                    }
        CHECK(at == bytes.size());
        CHECK(wrong == 0);
    }
}
