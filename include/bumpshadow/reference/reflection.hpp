#pragma once

#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/texture.hpp>

namespace bumpshadow {

// What a mirror with the normals of an SSBump map shows of an environment: the normal recovered straight into the
// world, the way to the eye reflected at it, and a cube texture sampled there.
//   masks, encoding: an SSBump map; environment: a cube, +x +y +z of the world as its faces have them
//   eye: towards the eye in the world, finite and of any length; for the zero vector the middle of +z is shown
//   level: of the environment, blurred ones for a rough surface
// Source: Ols 2010, Self-Shadowed Bump maps, second update.
[[nodiscard]] inline glm::vec4 reflected(const ssbump& encoding, const const_texture& masks, const sampler& how,
                                         const surface_point& point, glm::vec3 eye, const const_texture& environment,
                                         float level = 0.0f) {
    glm::vec3 m(sample(masks, how, point.uv));
    if (encoding.y == normal_y::up) m = shader::bumpshadow_ssbump_other_hand(m);
    const glm::vec3 red = shader::bumpshadow_ssbump_world_red(point.tangent, point.normal),
                    green = shader::bumpshadow_ssbump_world_green(point.tangent, point.bitangent, point.normal),
                    blue = shader::bumpshadow_ssbump_world_blue(point.tangent, point.bitangent, point.normal);
    const glm::vec3 normal = shader::bumpshadow_ssbump_world_normal(m, red, green, blue);
    return sample_cube(environment, how, shader::bumpshadow_reflection(shadow_detail::scaled(eye), normal), level);
}

}  // namespace bumpshadow
