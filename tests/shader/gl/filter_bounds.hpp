#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/texture.hpp>

// What a horizon decoded by the software renderer may differ from that of C++.
namespace encoded_maps {

// Largest differences of a filtered texel of the software renderer, 2D and 3D; of 16 bits and floats 2e-6. A decoder
// whose horizon is a mean of texels, its weights adding up to 1, is off by as much; other bounds say what they are
// made of.
inline constexpr float filter_2d = 0.006f, filter_3d = 0.0067f;
// 565 is widened to 8 bits, blocks are decoded to 8 bits, before they are filtered.
inline constexpr float filter_565 = 0.011f, filter_bc4 = 0.0067f + filter_2d;
inline constexpr float exact = 1e-4f;  // 16 bits and floats
// Cubes are filtered in float, whatever they store.
inline constexpr float filter_cube = 2e-6f;

// A slice is one channel: the error of the filter is that of the horizon.
[[nodiscard]] inline float bound_of(const bumpshadow::tangent_volume& e) {
    using bumpshadow::texel_format;
    if (e.format == texel_format::bc4) return filter_bc4;
    if (e.format != texel_format::r8) return exact;
    return e.kind == bumpshadow::texture_kind::volume ? filter_3d : filter_2d;
}

// Each coefficient is off by the error of the filter times its scale; those of a pair are multiplied by sine and
// cosine, which are at most as large as the pair is long. Roots are squared after that: the derivative of r |r| is
// 2 |r|, and r may be off itself.
[[nodiscard]] inline float bound_of(const bumpshadow::fourier& e) {
    if (e.bits == 16) return exact;
    const bumpshadow::fourier_decoding d = decoding_of(e);
    const auto error = [&](float scale, float offset) {
        const float step = filter_2d * scale;
        const float root = std::max(std::abs(offset), std::abs(offset + scale));
        return e.square_root ? step * (2.0f * root + step) : step;
    };
    float sum = 0.0f;
    std::array<float, 8> waves{};
    std::size_t count = 0;
    for (int t = 0; t < texture_count(e); ++t) {
        const std::array<int, 4> channels = channels_of(e, t);
        for (int c = 0; c < 4; ++c) {
            if (channels[std::size_t(c)] < 0) continue;
            const bool one = channels[1] < 0;
            const float here = error(one ? d.constant_scale : d.scale[t][c], one ? d.constant_offset : d.offset[t][c]);
            if (channels[std::size_t(c)] == 0)
                sum += here;
            else
                waves[count++] = here;
        }
    }
    for (std::size_t i = 0; i + 1 < count; i += 2) sum += std::hypot(waves[i], waves[i + 1]);
    return sum;
}

}  // namespace encoded_maps
