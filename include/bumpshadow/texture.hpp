#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// What a texel, or a block of 4 x 4 texels, is made of. Numbers are little-endian and named as in Vulkan and D3D:
// r8 is R8_UNORM, r16f R16_SFLOAT, bc1 four channels of which the fourth is 1, bc4 one unsigned channel.
enum class texel_format : unsigned char { r8, rg8, rgba8, r16, rgba16, r16f, rgba16f, r32f, rgba32f, rgb565, bc1, bc4 };

// Sizes of a format.
struct format_traits {
    int channels;     // 1 to 4
    int block;        // texels along a side of what is stored together
    int block_bytes;  // bytes of that
};

// The sizes of each format.
[[nodiscard]] constexpr format_traits traits_of(texel_format format) {
    switch (format) {
        case texel_format::r8: return {1, 1, 1};
        case texel_format::rg8: return {2, 1, 2};
        case texel_format::rgba8: return {4, 1, 4};
        case texel_format::r16: return {1, 1, 2};
        case texel_format::rgba16: return {4, 1, 8};
        case texel_format::r16f: return {1, 1, 2};
        case texel_format::rgba16f: return {4, 1, 8};
        case texel_format::r32f: return {1, 1, 4};
        case texel_format::rgba32f: return {4, 1, 16};
        case texel_format::rgb565: return {3, 1, 2};
        case texel_format::bc1: return {3, 4, 8};
        case texel_format::bc4: return {1, 4, 8};
    }
    return {0, 1, 0};
}

// Shape of a texture. flat: one 2D image; array: several; cube: six, in the order +x -x +y -y +z -z of GL, Vulkan and
// D3D; volume: one 3D image.
enum class texture_kind : unsigned char { flat, array, cube, volume };

// Extent of a texture's mip level along one axis, in texels: halved, rounded down, at least 1. level: 0 or more.
[[nodiscard]] constexpr int mip_extent(int extent, int level) {
    BUMPSHADOW_ASSERT(level >= 0);
    return (std::max)(1, extent >> (std::min)(level, 31));
}

// Levels of the full mip chain of an extent; 1 where it is not positive.
[[nodiscard]] constexpr int full_mips(glm::ivec2 extent) {
    int levels = 1;
    while (levels < 31 && ((std::max)(extent.x, extent.y) >> levels) > 0) ++levels;
    return levels;
}

// How a texture lies in memory, tightly packed, as DDS files and D3D have it: for each layer (or face), for each mip
// level, its image; an image is [slice][row of blocks][block]. A volume has one layer, whose levels halve the depth,
// too.
struct texture_layout {
    texel_format format = texel_format::r8;  // of every level
    texture_kind kind = texture_kind::flat;  // decides which of depth and layers may be above 1
    glm::ivec2 extent{0};                    // texels of level 0
    int depth = 1;                           // slices of a volume's level 0
    int layers = 1;                          // of an array; 6 for a cube
    int mips = 1;                            // levels, that of the full extent included

    // Texels of a level.
    [[nodiscard]] GLM_CONSTEXPR glm::ivec2 level_extent(int level) const {
        return {mip_extent(extent.x, level), mip_extent(extent.y, level)};
    }
    // Slices of a level of a volume.
    [[nodiscard]] constexpr int level_depth(int level) const { return mip_extent(depth, level); }
    // Bytes from one row of blocks to the next.
    [[nodiscard]] constexpr std::size_t row_bytes(int level) const {
        const format_traits f = traits_of(format);
        return saturated_product(std::size_t(part_count(mip_extent(extent.x, level), f.block)),
                                 std::size_t(f.block_bytes));
    }
    // Bytes of one slice, layer or face of a level.
    [[nodiscard]] constexpr std::size_t slice_bytes(int level) const {
        return saturated_product(row_bytes(level),
                                 std::size_t(part_count(mip_extent(extent.y, level), traits_of(format).block)));
    }
    // Bytes of one layer with all its levels.
    [[nodiscard]] constexpr std::size_t layer_bytes() const { return bytes_above(mips); }
    // Bytes of the whole texture. This and the two above are the largest std::size_t where it does not count as far.
    [[nodiscard]] constexpr std::size_t required_size() const {
        return saturated_product(layer_bytes(), std::size_t(layers));
    }
    // Bytes before slice `slice` of a level of a layer, of a texture that passes check().
    [[nodiscard]] constexpr std::size_t offset(int layer, int level, int slice = 0) const {
        const std::size_t layers_before = layer > 0 ? layer_bytes() * std::size_t(layer) : 0;
        return layers_before + bytes_above(level) + slice_bytes(level) * std::size_t(slice);
    }
    // Bytes for each texel of a map of extent `texels`, level 0 alone.
    [[nodiscard]] constexpr double bytes_per_texel(glm::ivec2 texels) const {
        return double(slice_bytes(0)) * double(depth) * double(layers) / (double(texels.x) * double(texels.y));
    }

private:
    // Bytes of the levels of one layer before this one.
    [[nodiscard]] constexpr std::size_t bytes_above(int level) const {
        std::size_t bytes = 0;
        for (int i = 0; i < level; ++i)
            bytes = saturated_sum(bytes, saturated_product(slice_bytes(i), std::size_t(level_depth(i))));
        return bytes;
    }
};

// Bytes with their layout; owns nothing. Producers write through `bytes`, readers take the const form.
template <class Byte>
struct basic_texture {
    std::span<Byte> bytes = {};  // layout.required_size() of them, or more
    texture_layout layout = {};  // where in them what lies

    // First byte of a layer's level, or of slice `index` of it.
    [[nodiscard]] constexpr Byte* slice(int layer, int level, int index = 0) const {
        return bytes.data() + layout.offset(layer, level, index);
    }
    // The same texture to read from.
    constexpr operator basic_texture<const std::byte>() const { return {bytes, layout}; }
};
// A texture that is written.
using texture = basic_texture<std::byte>;
// A texture that is read.
using const_texture = basic_texture<const std::byte>;

// Checks a layout, and that the bytes are enough for it.
template <class Byte>
[[nodiscard]] status check(const basic_texture<Byte>& t) {
    const texture_layout& l = t.layout;
    if (l.extent.x <= 0) return {error::not_positive, "texture extent.x", double(l.extent.x)};
    if (l.extent.y <= 0) return {error::not_positive, "texture extent.y", double(l.extent.y)};
    if (l.depth <= 0) return {error::not_positive, "texture depth", double(l.depth)};
    if (l.kind != texture_kind::volume && l.depth != 1) return {error::mismatch, "texture depth", double(l.depth), 1.0};
    if (l.layers <= 0) return {error::not_positive, "texture layers", double(l.layers)};
    if (l.kind == texture_kind::cube && l.layers != 6)
        return {error::mismatch, "texture layers", double(l.layers), 6.0};
    if (l.kind == texture_kind::cube && l.extent.x != l.extent.y)
        return {error::mismatch, "texture extent.y", double(l.extent.y), double(l.extent.x)};
    if ((l.kind == texture_kind::flat || l.kind == texture_kind::volume) && l.layers != 1)
        return {error::mismatch, "texture layers", double(l.layers), 1.0};
    if (l.mips <= 0) return {error::not_positive, "texture mips", double(l.mips)};
    const int most = full_mips({(std::max)(l.extent.x, l.depth), l.extent.y});
    if (l.mips > most) return {error::out_of_range, "texture mips", double(l.mips), double(most)};
    if (t.bytes.size() < l.required_size())
        return {error::too_small, "texture size", double(t.bytes.size()), double(l.required_size())};
    return {};
}

}  // namespace bumpshadow
