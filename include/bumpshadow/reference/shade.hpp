#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

// Shades a whole picture of a bumpy surface: one light with its shadow, and ambient light.
//
//   out = albedo * (ambient + color * s * max(n . l, 0)) + color * s * specular * max(n . h, 0)^shininess
//   s: shadow factor * existing shadow * falloff of the light; h: halfway between light and viewer (Blinn-Phong)
//
// Works through rows in chunks that stay in the first cache, one pass for each of the steps. A far light on the flat
// surface itself, with a tangent volume of 8 bits, takes about 5 ns a pixel on one core with 512-bit vectors.

namespace bumpshadow {

// No shadow, and the model of what shade() takes: a callable that takes uv and the light in tangent space (unit length,
// or 0) and gives a factor in [0, 1]; shadow.hpp has one for each encoding. It may also have
//   bool row(glm::ivec2 extent, glm::ivec2 first, int count, glm::vec3 light, float* factors) const
//     the same for `count` texels from `first` on, of a map of that extent; false where it would rather be called
//   static constexpr bool shades: what it gives is brightness, max(n . l, 0) included
//   status check() const: whether it can be used at all
struct no_shadow {
    // Lit.
    float operator()(glm::vec2, glm::vec3) const { return 1.0f; }
    // Lit, `count` times.
    [[nodiscard]] bool row(glm::ivec2, glm::ivec2, int count, glm::vec3, float* factors) const {
        std::fill(factors, factors + count, 1.0f);
        return true;
    }
};

// What shade() takes besides shadow, surface and picture. Colors are linear RGB.
struct shade_options {
    light_source light = {};  // in the space of the surface
    glm::vec3 ambient{0.0f};  // never shadowed; give it to one of several lights
    // Read texel by texel on a flat_surface, whose extent they must have; at uv, filtered and repeated, on any other.
    normal_map normals = {};                        // from bake_normals or decode_normals; empty: straight up
    const_pixels diffuse = {};                      // 3 or 4 channels, the fourth is ignored; empty: white
    bool diffuse_is_srgb = true;                    // false: linear
    glm::vec3 albedo{1.0f};                         // times the diffuse map
    glm::vec3 specular{0.0f};                       // factor of the highlight
    float shininess = 32.0f;                        // exponent of the highlight
    glm::vec3 viewer_direction{0.0f, 0.0f, 1.0f};   // far away, any length
    std::optional<glm::vec3> viewer_position = {};  // if near
    std::span<const float> existing_shadow = {};    // [y][x], tightly packed, multiplied in; empty: none
    // Distances from the viewer, in the space of the surface, at which shadows begin to fade and at which they have
    // gone; encoded shadows alone.
    float fade_start = std::numeric_limits<float>::infinity();
    float fade_end = std::numeric_limits<float>::infinity();  // not below fade_start
    bool add = false;                                         // to what the picture holds: for several lights
};

namespace shade_detail {

inline constexpr int chunk = 256;  // pixels of a row that are worked on at a time
inline constexpr int band = 16;    // rows an item of an executor

struct vectors {
    float x[chunk], y[chunk], z[chunk];

    [[nodiscard]] glm::vec3 at(int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, glm::vec3 v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
    void fill(glm::vec3 v) {
        std::fill(x, x + chunk, v.x);
        std::fill(y, y + chunk, v.y);
        std::fill(z, z + chunk, v.z);
    }
};

struct work {
    surface_point points[chunk];  // where they are needed
    vectors normal, light, albedo;
    float strength[chunk];  // falloff, factor and existing shadow
    float factor[chunk];
    float gloss[chunk];
};

[[nodiscard]] inline glm::vec3 unit(glm::vec3 v) {
    const glm::vec3 s = shadow_detail::scaled(v);
    const float square = glm::dot(s, s);
    return square > 0.0f ? s * (1.0f / std::sqrt(square)) : glm::vec3(0.0f);
}

// read(x, y) at the four texels around uv, blended; the map repeats.
template <class Read>
[[nodiscard]] glm::vec3 bilinear(glm::ivec2 extent, glm::vec2 uv, const Read& read) {
    const glm::vec2 p = (uv - glm::floor(uv)) * glm::vec2(extent) - 0.5f, floor = glm::floor(p), w = p - floor;
    const int x0 = (int(floor.x) + extent.x) % extent.x, y0 = (int(floor.y) + extent.y) % extent.y;
    const int x1 = (x0 + 1) % extent.x, y1 = (y0 + 1) % extent.y;
    return glm::mix(glm::mix(read(x0, y0), read(x1, y0), w.x), glm::mix(read(x0, y1), read(x1, y1), w.x), w.y);
}

// Light of a byte.
struct byte_table {
    float light[256];

    explicit byte_table(bool srgb) {
        for (int i = 0; i < 256; ++i) light[i] = srgb ? srgb_to_linear(float(i) / 255.0f) : float(i) / 255.0f;
    }
    [[nodiscard]] float operator()(std::byte b) const { return light[std::to_integer<int>(b)]; }
};

// A near light as a point sees it: direction in tangent space, and falloff.
[[nodiscard]] inline float see_near(const light_source& light, const surface_point& point, glm::vec3& toward) {
    const glm::vec3 way = light.position - point.position;
    const float square = (std::max)(glm::dot(way, way), 1e-20f);
    const glm::vec3 direction = unit(way);
    toward = shader::bumpshadow_to_tangent_space(direction, point.tangent, point.bitangent, point.normal);
    if (light.kind == light_kind::point) return 1.0f / square;
    const float cosine = -glm::dot(direction, unit(light.axis));
    const float ramp =
        glm::clamp((cosine - light.outer_cosine) / (light.inner_cosine - light.outer_cosine), 0.0f, 1.0f);
    return ramp * ramp / square;
}

// The sum for a chunk. Loops run to its end, whatever the count: that is what lets compilers vectorize them at -O2.
inline void combine(const work& w, const shade_options& options, bool shades, int count, float* out) {
    const glm::vec3 color = options.light.color, ambient = options.ambient, gloss = color * options.specular;
    float lit[chunk], sum[3][chunk];
    if (shades)
        std::copy(w.strength, w.strength + chunk, lit);
    else
        for (int i = 0; i < chunk; ++i) {
            const float cosine =
                w.normal.x[i] * w.light.x[i] + w.normal.y[i] * w.light.y[i] + w.normal.z[i] * w.light.z[i];
            lit[i] = (cosine > 0.0f ? cosine : 0.0f) * w.strength[i];
        }
    for (int i = 0; i < chunk; ++i) sum[0][i] = w.albedo.x[i] * (ambient.x + color.x * lit[i]);
    for (int i = 0; i < chunk; ++i) sum[1][i] = w.albedo.y[i] * (ambient.y + color.y * lit[i]);
    for (int i = 0; i < chunk; ++i) sum[2][i] = w.albedo.z[i] * (ambient.z + color.z * lit[i]);
    if (options.specular != glm::vec3(0.0f))
        for (glm::length_t c = 0; c < 3; ++c)
            for (int i = 0; i < chunk; ++i) sum[c][i] += gloss[c] * w.gloss[i] * w.strength[i];
    if (options.add)
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) out[3 * i + c] += sum[c][i];
    else
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) out[3 * i + c] = sum[c][i];
}

template <class Shadow, class Surface>
class pass {
public:
    pass(const shade_options& options, const Shadow& shadow, const Surface& surface, const rgb_image& out)
        : options_(options), shadow_(shadow), surface_(surface), out_(out), table_(options.diffuse_is_srgb) {}

    void rows(int first, int last) const {
        work w{};
        if (far_ && flat) w.light.fill(unit(options_.light.direction));
        if (options_.normals.values.empty()) w.normal.fill({0.0f, 0.0f, 1.0f});
        if (options_.diffuse.bytes.empty()) w.albedo.fill(options_.albedo);
        for (int y = first; y < last; ++y)
            for (int x = 0; x < out_.extent.x; x += chunk) {
                const int count = (std::min)(chunk, out_.extent.x - x);
                if (placed_)
                    for (int i = 0; i < count; ++i) w.points[i] = surface_(glm::ivec2(x + i, y));
                read_normals(w, {x, y}, count);
                see_light(w, count);
                cast_shadow(w, {x, y}, count);
                read_albedo(w, {x, y}, count);
                if (options_.specular != glm::vec3(0.0f)) reflect(w, count);
                combine(w, options_, shades, count, out_.row(y) + 3 * std::size_t(x));
            }
    }

private:
    static constexpr bool flat = std::is_same_v<Surface, flat_surface>;
    static constexpr bool shades = [] {
        if constexpr (requires { Shadow::shades; }) return bool(Shadow::shades);
        return false;
    }();

    void read_normals(work& w, glm::ivec2 at, int count) const {
        const normal_map& map = options_.normals;
        if (map.values.empty()) return;
        if constexpr (flat) {
            std::copy_n(map.row(0, at.y) + at.x, count, w.normal.x);
            std::copy_n(map.row(1, at.y) + at.x, count, w.normal.y);
            std::copy_n(map.row(2, at.y) + at.x, count, w.normal.z);
        } else {
            for (int i = 0; i < count; ++i)
                w.normal.set(i, unit(bilinear(map.extent, w.points[i].uv, [&](int x, int y) { return map.at(x, y); })));
        }
    }

    void read_albedo(work& w, glm::ivec2 at, int count) const {
        const const_pixels& map = options_.diffuse;
        if (map.bytes.empty()) return;
        const glm::vec3 times = options_.albedo;
        if constexpr (flat) {
            const std::byte* texel = map.at(at.x, at.y);
            for (int i = 0; i < count; ++i, texel += map.channels) {
                w.albedo.x[i] = times.x * table_(texel[0]);
                w.albedo.y[i] = times.y * table_(texel[1]);
                w.albedo.z[i] = times.z * table_(texel[2]);
            }
        } else {
            for (int i = 0; i < count; ++i)
                w.albedo.set(i, times * bilinear(map.extent, w.points[i].uv, [&](int x, int y) {
                                    const std::byte* texel = map.at(x, y);
                                    return glm::vec3(table_(texel[0]), table_(texel[1]), table_(texel[2]));
                                }));
        }
    }

    void see_light(work& w, int count) const {
        std::fill(w.strength, w.strength + chunk, 1.0f);
        if (!far_) {
            for (int i = 0; i < count; ++i) {
                glm::vec3 toward;
                w.strength[i] = see_near(options_.light, w.points[i], toward);
                w.light.set(i, toward);
            }
        } else if constexpr (!flat) {
            const glm::vec3 direction = unit(options_.light.direction);
            for (int i = 0; i < count; ++i) {
                const surface_point& p = w.points[i];
                w.light.set(i, shader::bumpshadow_to_tangent_space(direction, p.tangent, p.bitangent, p.normal));
            }
        }
    }

    void cast_shadow(work& w, glm::ivec2 at, int count) const {
        bool done = false;
        if constexpr (flat && requires { shadow_.row(at, at, count, glm::vec3(), w.factor); })
            done = far_ && shadow_.row(out_.extent, at, count, w.light.at(0), w.factor);
        for (int i = 0; !done && i < count; ++i)
            w.factor[i] = shadow_(placed_ ? w.points[i].uv : surface_(at + glm::ivec2(i, 0)).uv, w.light.at(i));
        if (is_finite(options_.fade_start) && !shades)
            for (int i = 0; i < count; ++i)
                w.factor[i] = shader::bumpshadow_shadow_fade(
                    w.factor[i], glm::length(*options_.viewer_position - w.points[i].position), options_.fade_start,
                    options_.fade_end);
        for (int i = 0; i < chunk; ++i) w.strength[i] *= w.factor[i];
        if (options_.existing_shadow.empty()) return;
        const float* existing =
            options_.existing_shadow.data() + std::size_t(at.y) * std::size_t(out_.extent.x) + std::size_t(at.x);
        for (int i = 0; i < count; ++i) w.strength[i] *= existing[i];
    }

    void reflect(work& w, int count) const {
        for (int i = 0; i < count; ++i) {
            glm::vec3 view = unit(options_.viewer_direction);
            if (options_.viewer_position) view = unit(*options_.viewer_position - w.points[i].position);
            if constexpr (!flat) {
                const surface_point& p = w.points[i];
                view = shader::bumpshadow_to_tangent_space(view, p.tangent, p.bitangent, p.normal);
            }
            const glm::vec3 normal = w.normal.at(i), light = w.light.at(i);
            const float cosine = glm::dot(normal, unit(light + view));
            // A cosine that is rounded to above 1 would grow with the exponent.
            w.gloss[i] = glm::dot(normal, light) > 0.0f && cosine > 0.0f
                             ? std::pow((std::min)(cosine, 1.0f), options_.shininess)
                             : 0.0f;
        }
    }

    const shade_options& options_;
    const Shadow& shadow_;
    const Surface& surface_;
    const rgb_image& out_;
    const byte_table table_;
    const bool far_ = options_.light.kind == light_kind::directional;
    const bool placed_ = !flat || !far_ || options_.viewer_position.has_value();
};

[[nodiscard]] inline status check_maps(const shade_options& options, glm::ivec2 extent, bool flat) {
    if (!options.normals.values.empty())
        if (status s = check(options.normals, flat ? extent : options.normals.extent); !s) return s;
    if (!options.diffuse.bytes.empty())
        if (status s = check(options.diffuse, flat ? extent : options.diffuse.extent, 3); !s) return s;
    const std::size_t texels = std::size_t(extent.x) * std::size_t(extent.y);
    if (!options.existing_shadow.empty() && options.existing_shadow.size() != texels)
        return {error::mismatch, "existing_shadow size", double(options.existing_shadow.size()), double(texels)};
    return {};
}

[[nodiscard]] inline status check_numbers(const shade_options& options) {
    using lighting_detail::check_finite;
    if (status s = check_finite("ambient", options.ambient); !s) return s;
    if (status s = check_finite("albedo", options.albedo); !s) return s;
    if (status s = check_finite("specular", options.specular); !s) return s;
    if (status s = check_finite("viewer_direction", options.viewer_direction); !s) return s;
    if (options.viewer_position)
        if (status s = check_finite("viewer_position", *options.viewer_position); !s) return s;
    if (!(options.shininess >= 0.0f && is_finite(options.shininess)))
        return {error::out_of_range, "shininess", double(options.shininess), 0.0};
    if (is_nan(options.fade_start)) return {error::not_finite, "fade_start", double(options.fade_start)};
    if (is_finite(options.fade_start)) {
        if (!options.viewer_position) return {error::missing, "viewer_position (needed to fade)"};
        if (!(options.fade_end >= options.fade_start))
            return {error::out_of_range, "fade_end", double(options.fade_end), double(options.fade_start)};
    }
    return {};
}

}  // namespace shade_detail

// Writes out.extent pixels; for a flat_surface that is the extent of the surface and of the maps.
// Errors: what the checks of light, picture, maps and shadow find, numbers that are not finite, an existing shadow of
// another size, fading without a near viewer.
template <class Shadow, class Surface, executor Executor = serial>
[[nodiscard]] status shade(const shade_options& options, const Shadow& shadow, const Surface& surface,
                           const rgb_image& out, Executor&& execute = {}) {
    constexpr bool flat = std::is_same_v<Surface, flat_surface>;
    if (status s = check(out); !s) return s;
    if (status s = check(options.light); !s) return s;
    if (status s = shade_detail::check_numbers(options); !s) return s;
    if constexpr (flat) {
        if (surface.extent.x != out.extent.x)
            return {error::mismatch, "surface extent.x", double(surface.extent.x), double(out.extent.x)};
        if (surface.extent.y != out.extent.y)
            return {error::mismatch, "surface extent.y", double(surface.extent.y), double(out.extent.y)};
        for (const float size : {surface.texel_size.x, surface.texel_size.y})
            if (!is_finite(size)) return {error::not_finite, "surface texel_size", double(size)};
    }
    if (status s = shade_detail::check_maps(options, out.extent, flat); !s) return s;
    if constexpr (requires { shadow.check(); })
        if (status s = shadow.check(); !s) return s;
    const shade_detail::pass<Shadow, Surface> pass(options, shadow, surface, out);
    constexpr int band = shade_detail::band;
    std::forward<Executor>(execute)(std::size_t(part_count(out.extent.y, band)), [&](std::size_t item) {
        const int first = int(item) * band;
        pass.rows(first, first + (std::min)(band, out.extent.y - first));
    });
    return {};
}

}  // namespace bumpshadow
