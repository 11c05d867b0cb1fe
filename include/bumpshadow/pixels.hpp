#pragma once

#include <cstddef>
#include <span>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// A view of an ordinary 8-bit picture, [y][x][channel], first row first; owns nothing. For what comes from image files
// and for the levels of rgba8 and rg8 textures alike.
template <class Byte>
struct basic_pixels {
    std::span<Byte> bytes = {};  // from texel (0, 0) on
    glm::ivec2 extent{0};        // texels
    int channels = 4;            // bytes a texel
    std::size_t row_stride = 0;  // bytes from one row to the next; 0: tightly packed

    // row_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t row_step() const {
        return row_stride != 0 ? row_stride : std::size_t(extent.x) * std::size_t(channels);
    }
    // First byte of row y.
    [[nodiscard]] constexpr Byte* row(int y) const { return bytes.data() + std::size_t(y) * row_step(); }
    // First byte of texel (x, y).
    [[nodiscard]] constexpr Byte* at(int x, int y) const { return row(y) + std::size_t(x) * std::size_t(channels); }
    // Bytes that `bytes` has to have; the largest std::size_t where they are more than it counts.
    [[nodiscard]] constexpr std::size_t required_size() const {
        return saturated_sum(saturated_product(std::size_t(extent.y) - 1, row_step()),
                             saturated_product(std::size_t(extent.x), std::size_t(channels)));
    }
    // The same picture to read from.
    constexpr operator basic_pixels<const std::byte>() const { return {bytes, extent, channels, row_stride}; }
};
// A picture that is written.
using pixels = basic_pixels<std::byte>;
// A picture that is read.
using const_pixels = basic_pixels<const std::byte>;

// Checks a picture of `extent` texels that has between `fewest` and 4 channels.
template <class Byte>
[[nodiscard]] status check(const basic_pixels<Byte>& picture, glm::ivec2 extent, int fewest) {
    if (picture.extent.x != extent.x)
        return {error::mismatch, "picture extent.x", double(picture.extent.x), double(extent.x)};
    if (picture.extent.y != extent.y)
        return {error::mismatch, "picture extent.y", double(picture.extent.y), double(extent.y)};
    if (extent.x <= 0) return {error::not_positive, "picture extent.x", double(extent.x)};
    if (extent.y <= 0) return {error::not_positive, "picture extent.y", double(extent.y)};
    if (picture.channels < fewest)
        return {error::too_small, "picture channels", double(picture.channels), double(fewest)};
    if (picture.channels > 4) return {error::out_of_range, "picture channels", double(picture.channels), 4.0};
    const std::size_t row = saturated_product(std::size_t(extent.x), std::size_t(picture.channels));
    if (picture.row_step() < row)
        return {error::too_small, "picture row_stride", double(picture.row_step()), double(row)};
    if (picture.bytes.size() < picture.required_size())
        return {error::too_small, "picture size", double(picture.bytes.size()), double(picture.required_size())};
    return {};
}

}  // namespace bumpshadow
