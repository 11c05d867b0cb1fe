#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/status.hpp>

// What a scene asks of its shadows: where light comes from, what error is bearable, and what there is to spend.

namespace bumpshadow {

// Far lights anywhere within an arc of bearings and a range of elevations: the path of a sun, say.
struct light_arc {
    double first_bearing = 0.0;  // turns, 0 along +x towards +y; lights lie from here on in growing bearing
    double last_bearing = 1.0;   // ... to here, at most a turn farther
    double lowest = 5.0;         // elevation above the surface, degrees
    double highest = 90.0;       // degrees, lowest to 90
};

// The lights of a scene, the error that is bearable, the budgets and the platform.
struct scene {
    // Lights: the first of these that is not empty counts, else the arc. No component is above largest_light in size.
    std::span<const glm::dvec3> lights = {};     // directions to far lights that do not move, in tangent space
    std::span<const glm::dvec3> positions = {};  // places of point lights: x, y from texel (0, 0) on, z above the
                                                 // surface that the bumps stand on, all in the unit of texel_size
    light_arc arc = {};                          // where neither of these says anything
    double light_radius = 0.0;                   // angular radius in degrees, 0 to 45; 0: hard edges

    // Error that is bearable.
    // Share of (texel, light) that is lit or shadowed wrongly; of pixels of many texels, mean difference of the factor.
    double mismatch = 0.015;
    double degrees = std::numeric_limits<double>::infinity();  // mean error of the horizon's elevation in the bearings

    // What there is to spend.
    double bytes = std::numeric_limits<double>::infinity();         // a texel of the height map
    double bake_seconds = std::numeric_limits<double>::infinity();  // bake and packing, on one thread of this machine
    double gpu_cost = std::numeric_limits<double>::infinity();      // cycles a wave as shader_cost prints them

    // Textures that the platform has, besides flat ones of 8 bits: volumes, arrays, BC4. Without volumes and arrays
    // there is one slice for all bearings alike.
    bool volumes = true, arrays = true, bc4 = true;
    bool has_normals = true;        // a normal map exists; else one is proposed
    bool has_lightmaps = false;     // light is baked in three directions: masks serve it without a light's direction
    double texels_per_pixel = 1.0;  // of the nearest view, at least 1; taken as 1, 2, 4 or 8
};

// The length of a vector of much larger components would overflow.
inline constexpr double largest_light = 1e150;

// Checks all of it, and names what is wrong.
[[nodiscard]] inline status check(const scene& s) {
    const auto positive = [](const char* name, double value) {
        return value > 0.0 ? status{} : status{error::not_positive, name, value};
    };
    const auto measurable = [](const char* name, const glm::dvec3& v) -> status {
        for (const double part : {v.x, v.y, v.z}) {
            if (!is_finite(part)) return {error::not_finite, name, part};
            if (std::abs(part) > largest_light) return {error::out_of_range, name, part, largest_light};
        }
        return {};
    };
    for (const glm::dvec3& v : s.lights) {
        if (status e = measurable("scene.lights", v); !e) return e;
        if (!(v.z >= 0.0)) return {error::out_of_range, "scene.lights z (below the surface)", v.z, 0.0};
        if (v == glm::dvec3(0.0)) return {error::not_positive, "length of one of scene.lights", 0.0};
    }
    for (const glm::dvec3& v : s.positions) {
        if (status e = measurable("scene.positions", v); !e) return e;
        if (!(v.z > 0.0)) return {error::not_positive, "scene.positions z", v.z};
    }
    const light_arc& a = s.arc;
    if (!is_finite(a.first_bearing)) return {error::not_finite, "scene.arc.first_bearing", a.first_bearing};
    if (!is_finite(a.last_bearing)) return {error::not_finite, "scene.arc.last_bearing", a.last_bearing};
    if (!(a.last_bearing > a.first_bearing))
        return {error::out_of_range, "scene.arc.last_bearing (an empty arc)", a.last_bearing, a.first_bearing};
    if (a.last_bearing > a.first_bearing + 1.0)
        return {error::out_of_range, "scene.arc.last_bearing (more than a turn)", a.last_bearing,
                a.first_bearing + 1.0};
    if (!(a.lowest >= 0.0)) return {error::out_of_range, "scene.arc.lowest", a.lowest, 0.0};
    if (!(a.highest <= 90.0)) return {error::out_of_range, "scene.arc.highest", a.highest, 90.0};
    if (!(a.highest >= a.lowest))
        return {error::out_of_range, "scene.arc.highest (below the lowest)", a.highest, a.lowest};
    if (!(s.light_radius >= 0.0 && s.light_radius <= 45.0))
        return {error::out_of_range, "scene.light_radius", s.light_radius, 45.0};
    if (!(s.mismatch >= 0.0)) return {error::out_of_range, "scene.mismatch", s.mismatch, 0.0};
    if (status e = positive("scene.degrees", s.degrees); !e) return e;
    if (status e = positive("scene.bytes", s.bytes); !e) return e;
    if (status e = positive("scene.bake_seconds", s.bake_seconds); !e) return e;
    if (status e = positive("scene.gpu_cost", s.gpu_cost); !e) return e;
    if (!(s.texels_per_pixel >= 1.0 && is_finite(s.texels_per_pixel)))
        return {error::out_of_range, "scene.texels_per_pixel", s.texels_per_pixel, 1.0};
    return {};
}

}  // namespace bumpshadow
