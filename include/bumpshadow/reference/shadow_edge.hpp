#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// Edge of a shadow: factor clamp(k (light - horizon) + c, 0, 1), in the quantity that the texture stores, over what
// stands for 1 there.
struct shadow_edge {
    // Inverse of the edge's width, 0 to infinity; infinity: a hard edge.
    float k = std::numeric_limits<float>::infinity();
    // 1: the edge lies inside the shadow, and all that the light's middle sees is fully lit (Lengyel 2016,
    // equation 5.4, with k = 8); 0.5: it is centered. Does not matter for a hard edge.
    float c = 1.0f;
};

// Checks k and c.
[[nodiscard]] inline status check(const shadow_edge& edge) {
    if (!(edge.k >= 0.0f)) return {error::out_of_range, "edge.k", double(edge.k), 0.0};
    if (!(edge.c >= 0.0f && edge.c <= 1.0f)) return {error::out_of_range, "edge.c", double(edge.c), 1.0};
    return {};
}

// Half the sun's apparent size, degrees.
inline constexpr double sun_radius = 0.2666;

// The edge under a light of an angular radius, as every encoding shows it alike: the factor goes from 1 to 0 while the
// horizon rises by 2 radius, from 2 radius (1 - c) below the light's middle to 2 radius c above. In what is stored
// that is 2 radius times its derivative by the elevation: 1 + slope^2 for slopes, the cosine for sines, 1 for angles.
// It is taken as a difference over the penumbra, cut off where the encoding's horizons end, at max_slope. So it depends
// on the light's elevation: once a light, or once a pixel for one that is near.
//   radius, elevation  degrees; radius 0 to 45 (0: a hard edge), elevation of the light's middle above the surface
// Against a ramp that is linear in the elevation, and so between encodings, with c = 0.5 and radians, the factor is off
// by at most radius tan(elevation) / 2 + radius^2 / 2 for slopes, less for sines, and by nothing for angles: 0.003 for
// the sun up to 45 degrees. With c = 1, twice that.
[[nodiscard]] inline shadow_edge edge_for(double radius, const horizon_scale& scale, double elevation, float c = 0.5f) {
    constexpr double degree = std::numbers::pi / 180.0;
    // Not quite 90 degrees, where slopes end.
    constexpr double highest = 89.9999 * degree;
    const double width = 2.0 * radius * degree, middle = (std::min)(elevation * degree, highest);
    const double last = (std::min)(std::atan(double(scale.max_slope)), highest);
    const double low = middle - (1.0 - double(c)) * width;
    const double high = (std::min)(middle + double(c) * width, (std::max)(last, middle));
    const auto stored = [&](double angle) {
        switch (scale.stored) {
            case quantity::sine: return std::sin(angle);
            case quantity::angle: return angle;
            case quantity::slope: break;
        }
        return std::tan(angle);
    };
    // Of a penumbra that reaches beyond the zenith the part above the light's middle is cut off: straight up, all light
    // is seen over any horizon.
    const double beyond = (middle + double(c) * width - highest) / (double(c) * width);
    if (last == highest && width > 0.0 && beyond > 0.0) {
        const double left = double(c) + (1.0 - double(c)) * (std::min)(beyond, 1.0);
        const double below = (stored(middle) - stored(low)) * double(stored_scale(scale));
        if (below > 0.0) return {static_cast<float>(left / below), static_cast<float>(left)};
        return {std::numeric_limits<float>::infinity(), 1.0f};
    }
    // Part of the penumbra that is left, over the range that it takes up.
    const double share = (high - low) / width, range = (stored(high) - stored(low)) * double(stored_scale(scale));
    if (!(width > 0.0) || !(range > 0.0)) return {std::numeric_limits<float>::infinity(), c};
    return {static_cast<float>(share / range), c};
}

// Elevation of a light's direction in degrees; 0 for the zero vector and what is not finite.
[[nodiscard]] inline double elevation_of(glm::vec3 light) {
    const double z = double(light.z), flat = std::hypot(double(light.x), double(light.y));
    const double degrees = std::atan2(z, flat) * (180.0 / std::numbers::pi);
    return is_finite(degrees) ? degrees : 0.0;
}

// Neither NaN nor infinite in any component.
[[nodiscard]] inline bool is_finite(glm::vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

namespace shadow_detail {

// Largest component 1 in size, as the shader snippets need directions whose squares neither overflow nor vanish; the
// zero vector stays. v is finite.
[[nodiscard]] inline glm::vec3 scaled(glm::vec3 v) {
    const float size = (std::max)({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    // Through double: the inverse of a tiny float would be infinite.
    const double inverse = size > 0.0f ? 1.0 / double(size) : 0.0;
    return {static_cast<float>(double(v.x) * inverse), static_cast<float>(double(v.y) * inverse),
            static_cast<float>(double(v.z) * inverse)};
}

[[nodiscard]] inline float edge_factor(float light, float horizon, const shadow_edge& edge) {
    return is_infinite(edge.k) ? shader::bumpshadow_shadow_hard(light, horizon)
                               : shader::bumpshadow_shadow_soft(light, horizon, edge.k, edge.c);
}

}  // namespace shadow_detail

}  // namespace bumpshadow
