#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

#include <glm/geometric.hpp>

// What shade.hpp is given besides shadows: lights, the shape of the surface, and pictures in linear light.

namespace bumpshadow {

// What a light is, as glTF has it.
enum class light_kind : unsigned char {
    directional,  // far away
    point,        // at a position; falls off with the square of the distance
    spot,         // a point light that shines along an axis
};

// Positions and directions are in the space in which the surface's points and frames are.
struct light_source {
    light_kind kind = light_kind::directional;  // says which of the others count
    glm::vec3 direction{0.0f, 0.0f, 1.0f};      // directional: towards the light, any length
    glm::vec3 position{0.0f, 0.0f, 1.0f};       // point, spot
    glm::vec3 axis{0.0f, 0.0f, -1.0f};          // spot: the way it shines, any length
    // Spot: full within the inner angle from the axis, nothing outside the outer one, between them the square of a ramp
    // in the cosine. Source: glTF extension KHR_lights_punctual.
    float inner_cosine = 0.9f;  // above outer_cosine, at most 1
    float outer_cosine = 0.8f;  // spot: cosine of the angle from the axis at which nothing is left, -1 or more
    // What a white surface facing the light sends back, linear RGB; for point and spot lights at distance 1.
    glm::vec3 color{1.0f};
};

namespace lighting_detail {

// An error with the first component that is not finite.
[[nodiscard]] inline status check_finite(const char* name, glm::vec3 v) {
    for (const float part : {v.x, v.y, v.z})
        if (!is_finite(part)) return {error::not_finite, name, double(part)};
    return {};
}

}  // namespace lighting_detail

// Checks what the light's kind takes.
[[nodiscard]] inline status check(const light_source& light) {
    using lighting_detail::check_finite;
    if (status s = check_finite("light.color", light.color); !s) return s;
    if (light.kind == light_kind::directional) {
        if (status s = check_finite("light.direction", light.direction); !s) return s;
        return {};
    }
    if (status s = check_finite("light.position", light.position); !s) return s;
    if (light.kind == light_kind::spot) {
        if (status s = check_finite("light.axis", light.axis); !s) return s;
        if (light.axis == glm::vec3(0.0f)) return {error::not_positive, "length of light.axis", 0.0};
        if (!(light.outer_cosine >= -1.0f && light.outer_cosine < 1.0f))
            return {error::out_of_range, "light.outer_cosine", double(light.outer_cosine), 1.0};
        if (!(light.inner_cosine > light.outer_cosine && light.inner_cosine <= 1.0f))
            return {error::out_of_range, "light.inner_cosine", double(light.inner_cosine), double(light.outer_cosine)};
    }
    return {};
}

// A pixel's place on the surface, all of it finite. The frame is orthonormal; the maps' tangent space is (tangent,
// bitangent, normal).
struct surface_point {
    glm::vec2 uv{0.0f};                     // texture coordinates
    glm::vec3 position{0.0f};               // in the space of the lights
    glm::vec3 tangent{1.0f, 0.0f, 0.0f};    // unit vector along +u there
    glm::vec3 bitangent{0.0f, 1.0f, 0.0f};  // along +v, the way of growing row numbers
    glm::vec3 normal{0.0f, 0.0f, 1.0f};     // out of the surface
};

// The map itself, one pixel a texel: pixel (x, y) is texel (x, y), its position (x, y, 0) * texel_size. A curved
// surface is any callable that takes a pixel (glm::ivec2) and gives its surface_point.
struct flat_surface {
    glm::ivec2 extent{0};        // texels, and pixels
    glm::vec2 texel_size{1.0f};  // units between texel centers, finite

    // The surface at a pixel.
    [[nodiscard]] surface_point operator()(glm::ivec2 pixel) const {
        surface_point point;
        point.uv = {(float(pixel.x) + 0.5f) / float(extent.x), (float(pixel.y) + 0.5f) / float(extent.y)};
        point.position = {float(pixel.x) * texel_size.x, float(pixel.y) * texel_size.y, 0.0f};
        return point;
    }
};

// A view of a picture in linear RGB, [y][x][channel]; owns nothing.
struct rgb_image {
    std::span<float> values = {};  // from pixel (0, 0) on
    glm::ivec2 extent{0};          // pixels
    std::size_t row_stride = 0;    // floats from one row to the next; 0: tightly packed

    // row_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t row_step() const {
        return row_stride != 0 ? row_stride : 3 * std::size_t(extent.x);
    }
    // First value of row y.
    [[nodiscard]] constexpr float* row(int y) const { return values.data() + std::size_t(y) * row_step(); }
    // Floats that `values` has to have; the largest std::size_t where they are more than it counts.
    [[nodiscard]] constexpr std::size_t required_size() const {
        return saturated_sum(saturated_product(std::size_t(extent.y) - 1, row_step()),
                             saturated_product(3, std::size_t(extent.x)));
    }
};

// Checks extent, stride and size.
[[nodiscard]] inline status check(const rgb_image& image) {
    if (image.extent.x <= 0) return {error::not_positive, "image extent.x", double(image.extent.x)};
    if (image.extent.y <= 0) return {error::not_positive, "image extent.y", double(image.extent.y)};
    if (image.row_step() < saturated_product(3, std::size_t(image.extent.x)))
        return {error::too_small, "image row_stride", double(image.row_step()), 3.0 * image.extent.x};
    if (image.values.size() < image.required_size())
        return {error::too_small, "image size", double(image.values.size()), double(image.required_size())};
    return {};
}

// sRGB in [0, 1] to linear light. Source: IEC 61966-2-1.
[[nodiscard]] inline float srgb_to_linear(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}
// Its inverse.
[[nodiscard]] inline float linear_to_srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

// Linear light to 8-bit sRGB: light * exposure, clamped to [0, 1]. `out` has 3 or 4 channels, the fourth becomes 255.
// Errors: what the checks find, an exposure that is not finite.
template <executor Executor = serial>
[[nodiscard]] status to_srgb8(const rgb_image& from, const pixels& out, float exposure = 1.0f,
                              Executor&& execute = {}) {
    if (status s = check(from); !s) return s;
    if (status s = check(out, from.extent, 3); !s) return s;
    if (!is_finite(exposure)) return {error::not_finite, "exposure", double(exposure)};
    std::forward<Executor>(execute)(std::size_t(from.extent.y), [&](std::size_t y) {
        const float* light = from.row(int(y));
        std::byte* texel = out.row(int(y));
        for (int x = 0; x < from.extent.x; ++x, light += 3, texel += out.channels) {
            for (int c = 0; c < 3; ++c)
                texel[c] = std::byte(to_unorm8(linear_to_srgb((std::min)(light[c] * exposure, 1.0f))));
            if (out.channels == 4) texel[3] = std::byte{255};
        }
    });
    return {};
}

}  // namespace bumpshadow
