#pragma once

#include <cstddef>
#include <cstdint>

#include <bumpshadow/config.hpp>
#include <bumpshadow/glm.hpp>

namespace bumpshadow {

// Color of a 16-bit texel, red in the high five bits; alpha is 1.
[[nodiscard]] inline glm::vec4 from_rgb565(std::uint32_t bits) {
    return {float((bits >> 11) & 31u) / 31.0f, float((bits >> 5) & 63u) / 63.0f, float(bits & 31u) / 31.0f, 1.0f};
}

// Texel of a BC1 (DXT1) block of 8 bytes; index counts in rows of four. Interpolated exactly, as D3D states it; GPUs
// and other decoders may differ by up to 1/255. Alpha is 1 everywhere (BC1_RGB): the transparent texel of blocks whose
// first color is not the larger one is black.
[[nodiscard]] inline glm::vec4 decode_bc1(const std::byte* block, int index) {
    const auto byte = [&](int i) { return std::to_integer<std::uint32_t>(block[i]); };
    const std::uint32_t first = byte(0) | byte(1) << 8, second = byte(2) | byte(3) << 8;
    const std::uint32_t code = (byte(4 + index / 4) >> (2 * (index % 4))) & 3u;
    const glm::vec4 a = from_rgb565(first), b = from_rgb565(second);
    switch (code) {
        case 0: return a;
        case 1: return b;
        case 2: return first > second ? (2.0f * a + b) / 3.0f : 0.5f * (a + b);
        default: return first > second ? (a + 2.0f * b) / 3.0f : glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    }
}

}  // namespace bumpshadow
