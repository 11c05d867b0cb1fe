#pragma once

#include <array>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/shader/shader.hpp>

#include <glm/geometric.hpp>

// Shadows where the light is computed at the vertices of a triangle and interpolated over it (shader/vertex.h).
//
// Points of a triangle that are lit or shadowed wrongly, in percent, by the length of its edges over the height of a
// point light; 16 slices of a map of stones, hard edge, most = 4 (the program `encodings` prints it):
//
//                        middle at 45 degrees         light above a vertex         light above the middle
//   edge               0.1    0.2   0.5    1    2     0.2   0.5    1     2         0.2   0.5    1     2
//   raw_bearing        0.22   0.45  1.5   3.7  8.7    0     1.8   4.5   9.7        0     1.0   6.2  13.1
//   bearing            0.01   0.06  0.4   1.6  5.3    0     1.3   2.9   7.8        0     0.7   5.6  12.6
//   direction          0.01   0.06  0.4   1.6  4.7    0     1.2   2.5   7.4        0     0.7   5.2  10.5
//   light              0      0     0     0    0      0     0     0     0          0     0     0     0

namespace bumpshadow {

// What is interpolated.
enum class interpolant : unsigned char {
    raw_bearing,  // bearing and slope as they are: wrong in triangles that cross the seam
    bearing,      // bearing and slope, the bearings unwrapped: Forsyth, with the wrap mode of Direct3D
    direction,    // unit direction in the surface, and slope; the bearing a pixel
    light,        // the light itself; bearing and slope a pixel
};

// A light as a pixel looks it up.
struct pixel_light {
    float bearing = 0.0f;  // as the encoding's function measures it, in turns, any number of them
    float slope = 0.0f;    // tangent of the elevation
};

// The light of a pixel from those of a triangle's vertices.
// lights: at the vertices, in tangent space, of lengths whose squares neither overflow nor vanish; for `light` they
//   have to be vectors to the light in one unit
// weights: the pixel's barycentric coordinates
// most: where slopes are cut before they are interpolated; above the steepest horizon
[[nodiscard]] inline pixel_light interpolate_light(const std::array<glm::vec3, 3>& lights, glm::vec3 weights,
                                                   interpolant what, bearing_function function, float most) {
    using namespace shader;
    glm::vec3 bearings(0.0f), slopes(0.0f), sum(0.0f);
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::vec3 light = lights[std::size_t(i)];
        bearings[i] = shadow_detail::bearing_of(function, {light.x, light.y});
        slopes[i] = bumpshadow_vertex_slope(light, most);
        sum += weights[i] * (what == interpolant::direction ? bumpshadow_vertex_direction(light, most) : light);
    }
    const glm::vec2 along(sum.x, sum.y);
    switch (what) {
        case interpolant::bearing: bearings = bumpshadow_unwrap_bearings(bearings); break;
        case interpolant::direction: return {shadow_detail::bearing_of(function, along), sum.z};
        case interpolant::light: return {shadow_detail::bearing_of(function, along), bumpshadow_slope(sum)};
        case interpolant::raw_bearing: break;
    }
    return {glm::dot(bearings, weights), glm::dot(slopes, weights)};
}

// Shadow factor of an encoding that is looked up by bearing: tangent_volume or slice_layers. In [0, 1] for any light; 0
// for a bearing that is not finite and a slope that is not a number. An infinite slope is a light straight up or down.
template <class Encoding, class Textures>
[[nodiscard]] float shadow_factor(const Encoding& encoding, const Textures& textures, const sampler& how, glm::vec2 uv,
                                  pixel_light light, const shadow_edge& edge = {}, float level = 0.0f) {
    if (!is_finite(light.bearing) || is_nan(light.slope)) return 0.0f;
    const float elevation = quantity_of_slope(encoding.scale.stored, light.slope) * stored_scale(encoding.scale);
    return shadow_detail::edge_factor(elevation, horizon_at(encoding, textures, how, uv, light.bearing, level), edge);
}

}  // namespace bumpshadow
