#pragma once

#include <bit>
#include <cstdint>

#include <bumpshadow/config.hpp>

namespace bumpshadow {

// Numbers as textures store them, and back as a GPU reads them. Round to nearest; what lies outside the range is
// clamped to it; NaN becomes 0. Errors: half a step, 1/510 for 8 bits and 1/131070 for 16.

// [0, 1] to [0, Last]: 255 for 8 bits, 65535 for 16, 31 and 63 for the channels of RGB565.
template <int Last>
[[nodiscard]] constexpr int to_unorm(float value) {
    // NaN fails the first comparison.
    const float inside = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    return static_cast<int>(inside * static_cast<float>(Last) + 0.5f);
}
// [0, 1] to [0, 255].
[[nodiscard]] constexpr std::uint8_t to_unorm8(float value) { return static_cast<std::uint8_t>(to_unorm<255>(value)); }
// [0, 1] to [0, 65535].
[[nodiscard]] constexpr std::uint16_t to_unorm16(float value) {
    return static_cast<std::uint16_t>(to_unorm<65535>(value));
}
// [0, 255] to [0, 1].
[[nodiscard]] constexpr float from_unorm8(std::uint8_t value) { return static_cast<float>(value) / 255.0f; }
// [0, 65535] to [0, 1].
[[nodiscard]] constexpr float from_unorm16(std::uint16_t value) { return static_cast<float>(value) / 65535.0f; }

// IEEE half precision: 11 significant bits, largest 65504. Ties go to even; what is larger becomes 65504, not infinity.
[[nodiscard]] constexpr std::uint16_t to_half(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = (bits >> 16) & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) return 0;                                            // NaN
    if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7bffu);  // rounds to 65536 or more
    if (magnitude < 0x33000001u) return static_cast<std::uint16_t>(sign);             // rounds to 0
    if (magnitude < 0x38800000u) {                                                    // a multiple of 2^-24
        const std::uint32_t shift = 126u - (magnitude >> 23);
        const std::uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u;
        const std::uint32_t half = mantissa >> shift, rest = mantissa & ((1u << shift) - 1u), tie = 1u << (shift - 1u);
        return static_cast<std::uint16_t>(sign | (half + (rest > tie || (rest == tie && (half & 1u)) ? 1u : 0u)));
    }
    const std::uint32_t rounded = magnitude + 0xfffu + ((magnitude >> 13) & 1u);
    return static_cast<std::uint16_t>(sign | ((rounded - 0x38000000u) >> 13));
}

// The number that 16 bits of half precision stand for, exactly.
[[nodiscard]] constexpr float from_half(std::uint16_t half) {
    const std::uint32_t sign = std::uint32_t(half & 0x8000u) << 16;
    const std::uint32_t exponent = (half >> 10) & 31u, mantissa = half & 0x3ffu;
    if (exponent == 0) {
        const float magnitude = static_cast<float>(mantissa) / 16777216.0f;
        return sign != 0 ? -magnitude : magnitude;
    }
    if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | (mantissa << 13));
    return std::bit_cast<float>(sign | ((exponent + 112u) << 23) | (mantissa << 13));
}

}  // namespace bumpshadow
