#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/texture.hpp>

// Horizons from the textures of a tangent volume, and shadows of a row of its texels; reference/shadow.hpp says what
// the functions take and give.

namespace bumpshadow {

namespace shadow_detail {

[[nodiscard]] inline float bearing_of(bearing_function function, glm::vec2 v) {
    switch (function) {
        case bearing_function::quintic: return shader::bumpshadow_bearing_quintic(v);
        case bearing_function::cubic: return shader::bumpshadow_bearing_cubic(v);
        case bearing_function::octant: return shader::bumpshadow_bearing_octant(v);
        case bearing_function::diamond: return shader::bumpshadow_bearing_diamond(v);
        case bearing_function::exact: break;
    }
    return shader::bumpshadow_bearing_exact(v);
}

// Finite for any max_slope, 0 included.
[[nodiscard]] inline float level_of(const horizon_scale& scale, glm::vec3 light) {
    constexpr float most = (std::numeric_limits<float>::max)();
    const float factor = (std::min)(stored_scale(scale), most);
    const float level = scale.stored == quantity::sine    ? shader::bumpshadow_sine(light)
                        : scale.stored == quantity::angle ? shader::bumpshadow_angle(light)
                                                          : shader::bumpshadow_slope(light);
    return (std::clamp)(factor * level, -most, most);
}

// As a GPU rounds and clamps the layer of an array.
[[nodiscard]] inline int layer_of(const const_texture& t, float layer) {
    return (std::clamp)(static_cast<int>(layer + 0.5f), 0, t.layout.layers - 1);
}

// Third coordinate of a volume.
[[nodiscard]] inline float coordinate_at(const tangent_volume& encoding, float bearing) {
    if (!is_arc(encoding.slices))
        return shader::bumpshadow_volume_coordinate(bearing, static_cast<float>(coordinate_offset(encoding)));
    const arc_coordinate c = arc_coordinate_of(encoding);
    return shader::bumpshadow_arc_coordinate(bearing, c.start, c.scale, c.offset);
}
[[nodiscard]] constexpr address_mode address_of(const tangent_volume& encoding) {
    return is_arc(encoding.slices) ? address_mode::clamp : address_mode::repeat;
}

// Layers of an array and the part of the second one.
[[nodiscard]] inline sampler_detail::tap layers_at(const tangent_volume& encoding, const const_texture& from,
                                                   float bearing) {
    const float count = static_cast<float>(encoding.slices.count);
    glm::vec3 at;
    if (is_arc(encoding.slices)) {
        const arc_coordinate c = arc_coordinate_of(encoding);
        at = shader::bumpshadow_arc_layers(bearing, c.start, c.scale, c.offset, count);
    } else {
        at = shader::bumpshadow_tangent_layers(bearing, static_cast<float>(encoding.slices.phase), count);
    }
    return {layer_of(from, at.x), layer_of(from, at.y), at.z};
}

}  // namespace shadow_detail

// Elevation of a light as a tangent volume stores horizons.
[[nodiscard]] inline float light_level(const tangent_volume& encoding, glm::vec3 light) {
    return shadow_detail::level_of(encoding.scale, light);
}

// Horizon in a bearing as the encoding's function measures it, in turns, e.g. an interpolated one.
[[nodiscard]] inline float horizon_at(const tangent_volume& encoding, const const_texture& from, sampler how,
                                      glm::vec2 uv, float bearing, float level = 0.0f) {
    if (encoding.kind == texture_kind::flat) return sample(from, how, uv, level).x;
    if (encoding.kind == texture_kind::volume) {
        how.z = shadow_detail::address_of(encoding);
        return sample_volume(from, how, {uv.x, uv.y, shadow_detail::coordinate_at(encoding, bearing)}, level).x;
    }
    const auto at = shadow_detail::layers_at(encoding, from, bearing);
    return shader::bumpshadow_tangent_horizon(sample(from, how, uv, level, at.first).x,
                                              sample(from, how, uv, level, at.second).x, at.weight);
}

// Horizon towards a light.
[[nodiscard]] inline float horizon(const tangent_volume& encoding, const const_texture& from, const sampler& how,
                                   glm::vec2 uv, glm::vec3 light, float level = 0.0f) {
    const float bearing = shadow_detail::bearing_of(encoding.slices.function, {light.x, light.y});
    return horizon_at(encoding, from, how, uv, bearing, level);
}

namespace shadow_detail {

// Texels first.x ... of a row, of an 8-bit tangent volume whose texels are the pixels: slices are blended with the same
// weights all along it.
inline void volume_row(const tangent_volume& encoding, const const_texture& from, const sampler& how, glm::ivec2 first,
                       int count, glm::vec3 light, const shadow_edge& edge, float* factors) {
    const float bearing = bearing_of(encoding.slices.function, {light.x, light.y});
    sampler_detail::tap slices;  // of a flat texture the only one
    if (encoding.kind == texture_kind::volume)
        slices = sampler_detail::linear_tap(coordinate_at(encoding, bearing), encoding.slices.count,
                                            address_of(encoding), how.weights);
    else if (encoding.kind == texture_kind::array)
        slices = layers_at(encoding, from, bearing);
    const float part = slices.weight;
    const std::size_t at = std::size_t(first.y) * from.layout.row_bytes(0) + std::size_t(first.x);
    const auto* const a =
        reinterpret_cast<const unsigned char*>(tangent_volume_detail::slice_bytes(from, 0, slices.first) + at);
    const auto* const b =
        reinterpret_cast<const unsigned char*>(tangent_volume_detail::slice_bytes(from, 0, slices.second) + at);
    const float elevation = level_of(encoding.scale, light);
    const float to_a = (1.0f - part) / 255.0f, to_b = part / 255.0f, k = edge.k, c = edge.c;
    // Blocks of known size in a local array are vectorized even at -O2; bytes may alias anything.
    constexpr int block = 16;
    for (int x = 0; x < count; x += block) {
        const int left = (std::min)(block, count - x);
        float values[block] = {};
        if (left == block)
            for (int i = 0; i < block; ++i) values[i] = float(a[x + i]) * to_a + float(b[x + i]) * to_b;
        else
            for (int i = 0; i < left; ++i) values[i] = float(a[x + i]) * to_a + float(b[x + i]) * to_b;
        if (is_infinite(k))
            for (float& v : values) v = shader::bumpshadow_shadow_hard(elevation, v);
        else
            for (float& v : values) v = shader::bumpshadow_shadow_soft(elevation, v, k, c);
        std::copy(values, values + left, factors + x);
    }
}

}  // namespace shadow_detail

}  // namespace bumpshadow
