#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/reference/tangent_shadow.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/texture.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

// From textures to shadow factors, by the shader snippets and the sampler: what a GPU computes for one light at one
// texture coordinate.
//
//   horizon(encoding, textures, how, uv, light, level)   in the quantity that is stored, over what stands for 1
//   light_level(encoding, light)                         elevation of the light, in the same
//   shadow_factor(encoding, textures, how, uv, light, edge, level)
//
// `light` points to the light in tangent space. horizon and light_level take directions whose squares neither overflow
// nor vanish, as the snippets do; shadow_factor takes any:
//   any length           the direction counts, from denormal to the largest
//   below the surface    0, whatever the horizon
//   on the horizon       lit, with a hard edge or c = 1; half lit with c = 0.5
//   straight up          1; with an edge that edge_for() did not give and c = 0.5, unless the stored horizon comes
//                        within 0.5 / k of the zenith
//   the zero vector      as one in the surface, towards +x
//   NaN or infinite      0
// Textures have to pass check() and to have the layout of the encoding. The result is finite and in [0, 1]; ssbump and
// emboss give brightness instead.

namespace bumpshadow {

// ---- Slice layers ----

// Elevation of a light as slice layers store horizons.
[[nodiscard]] inline float light_level(const slice_layers& encoding, glm::vec3 light) {
    return shadow_detail::level_of(encoding.scale, light);
}

// Horizon in a bearing as the encoding's function measures it, in turns.
[[nodiscard]] inline float horizon_at(const slice_layers& encoding, const const_texture& from, const sampler& how,
                                      glm::vec2 uv, float bearing, float level = 0.0f) {
    const float layers = static_cast<float>(from.layout.layers);
    const float position = shader::bumpshadow_slice_position(bearing, static_cast<float>(encoding.slices.phase),
                                                             static_cast<float>(encoding.slices.count));
    const auto layer = [&](float number) {
        return sample(from, how, uv, level, shadow_detail::layer_of(from, number));
    };
    if (encoding.grouping == slice_grouping::overlapping) {
        const glm::vec2 place = shader::bumpshadow_overlapping_layer(position);
        return shader::bumpshadow_overlapping_horizon(layer(place.x), place.y);
    }
    const glm::vec3 place = shader::bumpshadow_grouped_layers(position, layers);
    return shader::bumpshadow_grouped_horizon(layer(place.x), layer(place.y).x, place.z);
}

// Horizon towards a light, from one or two layers of the array.
[[nodiscard]] inline float horizon(const slice_layers& encoding, const const_texture& from, const sampler& how,
                                   glm::vec2 uv, glm::vec3 light, float level = 0.0f) {
    const float bearing = shadow_detail::bearing_of(encoding.slices.function, {light.x, light.y});
    return horizon_at(encoding, from, how, uv, bearing, level);
}

// ---- Sine layers: Lengyel ----

// Where an encoding has two textures in place of an array.
struct two_textures {
    const_texture first, second;  // flat, of the same layout
};

// The textures of sine layers, and the cube that their factors come from.
template <class Textures>
struct with_factor_cube {
    Textures maps;                           // a const_texture of two layers, or two_textures
    const_texture cube;                      // write_factor_cube
    factor_form form = factor_form::biased;  // of the cube
};

namespace shadow_detail {

struct two_texels {
    glm::vec4 first, second;
};
[[nodiscard]] inline two_texels both(const const_texture& from, const sampler& how, glm::vec2 uv, float level) {
    return {sample(from, how, uv, level, 0), sample(from, how, uv, level, 1)};
}
[[nodiscard]] inline two_texels both(const two_textures& from, const sampler& how, glm::vec2 uv, float level) {
    return {sample(from.first, how, uv, level), sample(from.second, how, uv, level)};
}

}  // namespace shadow_detail

// Elevation of a light as sine layers store horizons.
[[nodiscard]] inline float light_level(const sine_layers& encoding, glm::vec3 light) {
    return shadow_detail::level_of(encoding.scale, light);
}

// Horizon towards a light; factors are computed. from: a const_texture of two layers, or two_textures.
template <class Textures>
[[nodiscard]] float horizon(const sine_layers&, const Textures& from, const sampler& how, glm::vec2 uv, glm::vec3 light,
                            float level = 0.0f) {
    const auto [first, second] = shadow_detail::both(from, how, uv, level);
    return shader::bumpshadow_sine_layers(first, second, {light.x, light.y});
}

// Horizon towards a light; factors from the cube, filtered with the sampler's weights.
template <class Textures>
[[nodiscard]] float horizon(const sine_layers&, const with_factor_cube<Textures>& from, const sampler& how,
                            glm::vec2 uv, glm::vec3 light, float level = 0.0f) {
    const auto [first, second] = shadow_detail::both(from.maps, how, uv, level);
    const glm::vec4 texel = sample_cube(from.cube, {.weights = how.weights}, light);
    return shader::bumpshadow_sine_layers_factors(first, second,
                                                  from.form == factor_form::published
                                                      ? shader::bumpshadow_factors_published_cube(texel)
                                                      : shader::bumpshadow_factors_biased_cube(texel));
}

// ---- Fourier: radial horizon maps ----

// The textures with what decoding takes; the first texture_count(encoding) count.
struct fourier_textures {
    std::array<const_texture, 3> maps;  // flat
    fourier_decoding decoding;          // decoding_of(encoding)
};

// Elevation of a light in the quantity of the series.
[[nodiscard]] inline float light_level(const fourier& encoding, glm::vec3 light) {
    return shadow_detail::level_of(encoding.scale, light);
}

// Horizon towards a light: the series summed up. It may overshoot [0, 1].
[[nodiscard]] inline float horizon(const fourier& encoding, const fourier_textures& from, const sampler& how,
                                   glm::vec2 uv, glm::vec3 light, float level = 0.0f) {
    const fourier_decoding& d = from.decoding;
    const auto four = [&](std::size_t i) {
        const glm::vec4 texel = sample(from.maps[i], how, uv, level);
        return encoding.square_root ? shader::bumpshadow_fourier_root_texel(texel, d.scale[i], d.offset[i])
                                    : shader::bumpshadow_fourier_texel(texel, d.scale[i], d.offset[i]);
    };
    const auto constant = [&](std::size_t i) {
        const float texel = sample(from.maps[i], how, uv, level).x;
        return encoding.square_root
                   ? shader::bumpshadow_fourier_root_constant(texel, d.constant_scale, d.constant_offset)
                   : texel * d.constant_scale + d.constant_offset;
    };
    const glm::vec2 direction = shader::bumpshadow_fourier_direction({light.x, light.y});
    switch (encoding.coefficients) {
        case 3: return shader::bumpshadow_fourier_3(glm::vec3(four(0)), direction);
        case 5: return shader::bumpshadow_fourier_5(four(0), constant(1), direction);
        case 7: return shader::bumpshadow_fourier_7(four(0), glm::vec3(four(1)), direction);
        default: return shader::bumpshadow_fourier_9(four(0), four(1), constant(2), direction);
    }
}

// ---- Traced ----

// Horizons baked in the light's own bearing, by bake_exact for instance: a flat r32f texture of slopes, the one slice
// of a horizon_map. They are compared as `scale` says, without its limit. Before they are filtered, what is below 0
// (no_horizon among it) and NaN count as 0, as in the other encodings, and what is above largest_max_slope as that.
struct traced {
    horizon_scale scale;  // quantity that is compared, and the slope that stands for 1
};

// One flat texture of floats.
[[nodiscard]] constexpr texture_layout layout_of(const traced&, glm::ivec2 extent, int mips = 1) {
    return {.format = texel_format::r32f, .extent = extent, .mips = mips};
}
// Elevation of a light in the quantity of the scale.
[[nodiscard]] inline float light_level(const traced& encoding, glm::vec3 light) {
    return shadow_detail::level_of(encoding.scale, light);
}
// Horizon in the bearing that was baked, whatever that of the light.
[[nodiscard]] inline float horizon(const traced& encoding, const const_texture& from, const sampler& how, glm::vec2 uv,
                                   glm::vec3, float level = 0.0f) {
    const auto read = [&](int x, int y, int mip) {
        const float slope = fetch(from, {x, y, 0}, mip).x;
        return glm::vec4(slope > 0.0f ? (std::min)(slope, largest_max_slope) : 0.0f);
    };
    const float slope = sampler_detail::sample_flat(from, how, uv, level, read).x;
    return slope > 0.0f ? quantity_of_slope(encoding.scale.stored, slope) * stored_scale(encoding.scale) : 0.0f;
}

// ---- The factor ----

// Shadow factor in [0, 1] of a light at uv: 0 in shadow, 1 in light.
//   textures: as horizon() of this encoding takes them
//   light: towards the light in tangent space, see above
//   level: of the mip chain
template <class Encoding, class Textures>
[[nodiscard]] float shadow_factor(const Encoding& encoding, const Textures& textures, const sampler& how, glm::vec2 uv,
                                  glm::vec3 light, const shadow_edge& edge = {}, float level = 0.0f) {
    if (!is_finite(light)) return 0.0f;
    const glm::vec3 direction = shadow_detail::scaled(light);
    if (direction.z < 0.0f) return 0.0f;
    return shadow_detail::edge_factor(light_level(encoding, direction),
                                      horizon(encoding, textures, how, uv, direction, level), edge);
}

// Brightness in place of a shadow factor and of the cosine between normal and light, in [0, 1].
[[nodiscard]] inline float shadow_factor(const ssbump& encoding, const const_texture& from, const sampler& how,
                                         glm::vec2 uv, glm::vec3 light, const shadow_edge& = {}, float level = 0.0f) {
    if (!is_finite(light)) return 0.0f;
    const glm::vec3 direction = shadow_detail::scaled(light);
    if (direction.z < 0.0f || direction == glm::vec3(0.0f)) return 0.0f;
    glm::vec3 masks = glm::vec3(sample(from, how, uv, level)) / mask_scale(encoding);
    if (encoding.y == normal_y::up) masks = shader::bumpshadow_ssbump_other_hand(masks);
    const float brightness = shader::bumpshadow_ssbump_light(
        masks, shader::bumpshadow_ssbump_weights(direction * (1.0f / glm::length(direction))));
    return glm::clamp(brightness, 0.0f, 1.0f);
}

// The height texture of embossing, and the shift of a light at the horizon in texture coordinates.
struct emboss_texture {
    const_texture heights;   // pack_emboss
    glm::vec2 amount{0.0f};  // texture coordinates; where it leads beyond what a float holds, the height counts as 0
};

// What the base texture is multiplied by, 0 to 2: 256/255 where the surface is flat, more where it faces the light.
[[nodiscard]] inline float shadow_factor(const emboss&, const emboss_texture& from, const sampler& how, glm::vec2 uv,
                                         glm::vec3 light, const shadow_edge& = {}, float level = 0.0f) {
    if (!is_finite(light)) return 0.0f;
    const glm::vec3 direction = shadow_detail::scaled(light);
    if (direction.z < 0.0f) return 0.0f;
    const glm::vec2 shift = shader::bumpshadow_emboss_shift(direction, from.amount);
    const glm::vec2 there = uv + shift;
    const bool reached = is_finite(there.x) && is_finite(there.y);
    const float inverse = shader::bumpshadow_emboss_inverse(reached ? sample(from.heights, how, there, level).x : 0.0f);
    return 2.0f * shader::bumpshadow_emboss_relief(sample(from.heights, how, uv, level).x, inverse);
}

namespace shadow_detail {

// That textures have the layout of their encoding, and all of their bytes.
template <class Encoding>
[[nodiscard]] status check_textures(const Encoding& encoding, const const_texture& from) {
    return check_layout(from, layout_of(encoding, from.layout.extent, from.layout.mips));
}
[[nodiscard]] inline status check_textures(const sine_layers& encoding, const two_textures& from) {
    if (!encoding.separate) return {error::mismatch, "textures", 2.0, 1.0};
    if (status s = check_textures<sine_layers>(encoding, from.first); !s) return s;
    return check_textures<sine_layers>(encoding, from.second);
}
template <class Textures>
[[nodiscard]] status check_textures(const sine_layers& encoding, const with_factor_cube<Textures>& from) {
    if (from.cube.layout.kind != texture_kind::cube)
        return {error::mismatch, "cube kind", double(from.cube.layout.kind), double(texture_kind::cube)};
    if (status s = check(from.cube); !s) return s;
    return check_textures(encoding, from.maps);
}
[[nodiscard]] inline status check_textures(const fourier& encoding, const fourier_textures& from) {
    for (int i = 0; i < texture_count(encoding); ++i) {
        const const_texture& t = from.maps[std::size_t(i)];
        if (status s = check_layout(t, layout_of(encoding, t.layout.extent, t.layout.mips, i)); !s) return s;
    }
    return {};
}
[[nodiscard]] inline status check_textures(const emboss& encoding, const emboss_texture& from) {
    return check_textures<emboss>(encoding, from.heights);
}

}  // namespace shadow_detail

// A shadow for shade.hpp. Name the template arguments: not every compiler deduces them from designated initializers.
template <class Encoding, class Textures = const_texture>
struct encoded_shadow {
    Encoding encoding = {};  // what the textures hold
    Textures textures = {};  // as horizon() of the encoding takes them
    sampler how = {};        // for all of them
    shadow_edge edge = {};   // shape of the shadow's edge
    // Angular radius of the light in degrees, 0 to 45. Above 0, k is that of edge_for() at each pixel's own elevation
    // of the light: for near lights and curved surfaces.
    double radius = 0.0;
    float level = 0.0f;  // of the mip chain

    // True where the encoding gives brightness in place of a shadow factor.
    static constexpr bool shades = std::is_same_v<Encoding, ssbump> || std::is_same_v<Encoding, emboss>;

    // Checks encoding, edge, radius, level and textures; shade() begins with it.
    [[nodiscard]] status check() const {
        if constexpr (requires { bumpshadow::check(encoding); })
            if (status s = bumpshadow::check(encoding); !s) return s;
        if constexpr (!shades)
            if (status s = bumpshadow::check(encoding.scale); !s) return s;
        if (status s = bumpshadow::check(edge); !s) return s;
        if (is_nan(level)) return {error::not_finite, "level", double(level)};
        if (!(radius >= 0.0 && radius <= 45.0)) return {error::out_of_range, "radius", radius, 45.0};
        return shadow_detail::check_textures(encoding, textures);
    }

    // The edge under a light in this direction.
    [[nodiscard]] shadow_edge edge_at(glm::vec3 light) const {
        if constexpr (!shades)
            if (radius > 0.0) return edge_for(radius, encoding.scale, elevation_of(light), edge.c);
        return edge;
    }
    // Shadow factor at uv.
    [[nodiscard]] float operator()(glm::vec2 uv, glm::vec3 light) const {
        return shadow_factor(encoding, textures, how, uv, light, edge_at(light), level);
    }
    // Shadow factors of `count` texels from `first` on, of a map of that extent; false where this has no fast way.
    [[nodiscard]] bool row(glm::ivec2 extent, glm::ivec2 first, int count, glm::vec3 light,
                           float* factors) const requires std::is_same_v<Encoding, tangent_volume> {
        if (textures.layout.format != texel_format::r8 || textures.layout.extent != extent || level != 0.0f ||
            how.texels != filter_mode::linear)
            return false;
        if (!is_finite(light) || light.z < 0.0f)
            std::fill(factors, factors + count, 0.0f);
        else
            shadow_detail::volume_row(encoding, textures, how, first, count, shadow_detail::scaled(light),
                                      edge_at(light), factors);
        return true;
    }
};

}  // namespace bumpshadow
