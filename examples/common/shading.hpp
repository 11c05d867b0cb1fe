#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shade.hpp>

#include "common/file.hpp"
#include "common/image.hpp"

namespace examples {

// Towards a far light. Degrees: azimuth from +x (right) towards +y (down in the picture), elevation above the surface.
[[nodiscard]] inline glm::vec3 light_direction(double azimuth, double elevation) {
    const double turn = azimuth * std::numbers::pi / 180.0, rise = elevation * std::numbers::pi / 180.0;
    // The cosine of 90 degrees is not quite 0.
    const double flat = elevation == 90.0 ? 0.0 : std::cos(rise);
    return {std::cos(turn) * flat, std::sin(turn) * flat, std::sin(rise)};
}

// Textures go on as the map does. What is open has no texture beyond, and clamps.
[[nodiscard]] inline bumpshadow::address_mode address_of(bumpshadow::edge_mode edge) {
    switch (edge) {
        case bumpshadow::edge_mode::repeat: return bumpshadow::address_mode::repeat;
        case bumpshadow::edge_mode::mirror: return bumpshadow::address_mode::mirror;
        case bumpshadow::edge_mode::clamp:
        case bumpshadow::edge_mode::open: break;
    }
    return bumpshadow::address_mode::clamp;
}

// What a picture is made of, texel by texel.
struct surface {
    glm::ivec2 extent{0};
    std::vector<float> normals;  // planes, as bumpshadow::normal_map; all zero for a hole in the map
    image8 diffuse;              // RGB or RGBA, sRGB; empty: one plain tone
};

// Sun and sky on a surface.
[[nodiscard]] inline bumpshadow::shade_options sun_and_sky(const surface& surface, glm::vec3 light) {
    bumpshadow::shade_options options;
    options.light.direction = light;
    // A camera would open up as the light gets low: what lies flat keeps much of its brightness.
    const float exposure = 1.9f / (0.55f + std::max(light.z, 0.0f));
    options.light.color = exposure * glm::vec3(1.0f, 0.94f, 0.84f);
    options.ambient = exposure * glm::vec3(0.085f, 0.1f, 0.122f);
    // Read only, but normal_map is a view to write through as well.
    options.normals = {.values = {const_cast<float*>(surface.normals.data()), surface.normals.size()},
                       .extent = surface.extent};
    if (surface.diffuse.samples.empty())
        options.albedo = {0.507f, 0.448f, 0.367f};
    else
        options.diffuse = {std::as_bytes(std::span(surface.diffuse.samples)), surface.extent, surface.diffuse.channels};
    return options;
}

// One pixel a texel; holes are dark. `shadow` as bumpshadow::shade takes it. Throws failure.
template <class Shadow, bumpshadow::executor Executor>
[[nodiscard]] image8 shade_picture(const surface& surface, const bumpshadow::shade_options& options,
                                   const Shadow& shadow, Executor&& execute) {
    const glm::ivec2 extent = surface.extent;
    const std::size_t texels = std::size_t(extent.x) * std::size_t(extent.y);
    std::vector<float> linear(3 * texels);
    const bumpshadow::rgb_image picture{.values = linear, .extent = extent};
    image8 srgb(extent, 3);
    bumpshadow::status s =
        bumpshadow::shade(options, shadow, bumpshadow::flat_surface{.extent = extent}, picture, execute);
    if (s)
        s = bumpshadow::to_srgb8(
            picture, {.bytes = std::as_writable_bytes(std::span(srgb.samples)), .extent = extent, .channels = 3}, 1.0f,
            execute);
    require(s);
    for (std::size_t i = 0; i < texels; ++i)
        if (surface.normals[2 * texels + i] == 0.0f) std::fill_n(srgb.samples.begin() + std::ptrdiff_t(3 * i), 3, 28);
    return srgb;
}

}  // namespace examples
