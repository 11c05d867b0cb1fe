#pragma once

// Needs stb_dxt.h (github.com/nothings/stb) in the include path; Debian's libstb-dev has it in /usr/include/stb. One
// source file of the program defines STB_DXT_IMPLEMENTATION before it includes this header or stb_dxt.h, as stb wants
// it.
#include <cstddef>
#include <cstdint>
#include <cstring>  // stb_dxt.h uses memcpy and leaves including it to others

#include <stb_dxt.h>

#include <bumpshadow/quantize.hpp>

// Block compression by stb_dxt, for comparison with encode/bc4.hpp, and BC1.

namespace bumpshadow {

// The same as encode_bc4: 16 values in [0, 1], quantized to 8 bits first.
inline void encode_bc4_stb(const float* values, std::byte* block) {
    std::uint8_t texels[16];
    for (int i = 0; i < 16; ++i) texels[i] = to_unorm8(values[i]);
    stb_compress_bc4_block(reinterpret_cast<unsigned char*>(block), texels);
}

// A block of BC1 (DXT1) from 16 texels of rgba8; alpha is not read.
inline void encode_bc1_stb(const std::byte* texels, std::byte* block) {
    std::uint8_t opaque[64];
    for (int i = 0; i < 64; ++i) opaque[i] = i % 4 == 3 ? 255 : std::to_integer<std::uint8_t>(texels[i]);
    stb_compress_dxt_block(reinterpret_cast<unsigned char*>(block), opaque, 0, STB_DXT_HIGHQUAL);
}

}  // namespace bumpshadow
