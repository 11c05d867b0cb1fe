#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <bumpshadow/quantize.hpp>
#include <bumpshadow/texture.hpp>

// Rows of values in [0, 1] to the numbers of a texture and back, in loops that compilers vectorize. Nothing is clamped.

namespace bumpshadow {

namespace stored_rows_detail {

// Textures are little-endian.
inline void put(std::byte* to, std::uint16_t value) {
    if constexpr (std::endian::native == std::endian::big)
        value = static_cast<std::uint16_t>((value << 8) | (value >> 8));
    std::memcpy(to, &value, sizeof value);
}
[[nodiscard]] inline std::uint16_t get(const std::byte* from) {
    std::uint16_t value;
    std::memcpy(&value, from, sizeof value);
    if constexpr (std::endian::native == std::endian::big)
        value = static_cast<std::uint16_t>((value << 8) | (value >> 8));
    return value;
}

// to_half for values in [0, 1], without branches: below 2^-14 the step of a half is 2^-24, and adding 2^23 of them
// leaves their number in the last bits.
[[nodiscard]] inline std::uint16_t half_of_unit(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t normal = (bits + 0xfffu + ((bits >> 13) & 1u) - 0x38000000u) >> 13;
    const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(value + 0.5f) & 0xffffu;
    return static_cast<std::uint16_t>(bits < 0x38800000u ? subnormal : normal);
}

}  // namespace stored_rows_detail

// A row of r8, r16 or r16f.
inline void write_row(texel_format format, const float* values, int count, std::byte* to) {
    using namespace stored_rows_detail;
    switch (format) {
        case texel_format::r8:
            for (int x = 0; x < count; ++x) to[x] = static_cast<std::byte>(int(values[x] * 255.0f + 0.5f));
            break;
        case texel_format::r16:
            for (int x = 0; x < count; ++x)
                put(to + 2 * x, static_cast<std::uint16_t>(int(values[x] * 65535.0f + 0.5f)));
            break;
        case texel_format::r16f:
            for (int x = 0; x < count; ++x) put(to + 2 * x, half_of_unit(values[x]));
            break;
        default: break;
    }
}

// A row of rgba8: one row of values a channel.
inline void write_row_rgba8(const float* r, const float* g, const float* b, const float* a, int count, std::byte* to) {
    for (int x = 0; x < count; ++x) {
        to[4 * x] = static_cast<std::byte>(int(r[x] * 255.0f + 0.5f));
        to[4 * x + 1] = static_cast<std::byte>(int(g[x] * 255.0f + 0.5f));
        to[4 * x + 2] = static_cast<std::byte>(int(b[x] * 255.0f + 0.5f));
        to[4 * x + 3] = static_cast<std::byte>(int(a[x] * 255.0f + 0.5f));
    }
}

// `count` texels of a row of r8, r16 or r16f, from texel x on.
inline void read_row(texel_format format, const std::byte* row, int x, int count, float* values) {
    using namespace stored_rows_detail;
    switch (format) {
        case texel_format::r8:
            for (int i = 0; i < count; ++i) values[i] = from_unorm8(std::to_integer<std::uint8_t>(row[x + i]));
            break;
        case texel_format::r16:
            for (int i = 0; i < count; ++i) values[i] = from_unorm16(get(row + 2 * (x + i)));
            break;
        case texel_format::r16f:
            for (int i = 0; i < count; ++i) values[i] = from_half(get(row + 2 * (x + i)));
            break;
        default: break;
    }
}

}  // namespace bumpshadow
