#pragma once

// Encodings of several textures, shared by their tests.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/quantize.hpp>
#include <bumpshadow/texture.hpp>

#include "support/horizons.hpp"

// The textures of an encoding with their bytes, filled with 77.
struct textures {
    std::vector<std::vector<std::byte>> bytes;
    std::vector<bumpshadow::texture> views;

    template <class Encoding>
    textures(const Encoding& encoding, glm::ivec2 extent, int mips = 1) {
        for (int i = 0; i < texture_count(encoding); ++i) {
            bumpshadow::texture_layout layout;
            if constexpr (requires { layout_of(encoding, extent, mips, i); })
                layout = layout_of(encoding, extent, mips, i);
            else
                layout = layout_of(encoding, extent, mips);
            bytes.push_back(std::vector<std::byte>(layout.required_size(), std::byte(77)));
            views.push_back({bytes.back(), layout});
        }
    }
    [[nodiscard]] int byte(std::size_t of, std::size_t at) const { return std::to_integer<int>(bytes[of][at]); }
    // Texel of level 0 as a shader sees it; formats of 8 and 16 bits a channel.
    [[nodiscard]] glm::vec4 texel(std::size_t of, int x, int y) const {
        using namespace bumpshadow;
        const texture_layout& l = views[of].layout;
        const std::size_t channels = std::size_t(traits_of(l.format).channels);
        const bool wide = l.format == texel_format::r16 || l.format == texel_format::rgba16;
        glm::vec4 v(0.0f, 0.0f, 0.0f, 1.0f);
        for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t i = (std::size_t(y) * std::size_t(l.extent.x) + std::size_t(x)) * channels + c;
            v[int(c)] = wide ? from_unorm16(std::uint16_t(byte(of, 2 * i) | byte(of, 2 * i + 1) << 8))
                             : from_unorm8(std::uint8_t(byte(of, i)));
        }
        return v;
    }
    [[nodiscard]] bool untouched() const {
        for (const auto& b : bytes)
            if (!std::all_of(b.begin(), b.end(), [](std::byte v) { return v == std::byte(77); })) return false;
        return true;
    }
};
