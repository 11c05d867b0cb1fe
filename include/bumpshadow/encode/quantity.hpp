#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// The quantity with the slope that stands for 1. Horizons steeper than max_slope are stored as 1, those below 0 as 0.
struct horizon_scale {
    quantity stored = quantity::slope;  // what is stored of an elevation
    // Tangent of the elevation that stands for 1, smallest_max_slope to largest_max_slope; for sine and angle any
    // larger one, and infinity: all elevations up to 90 degrees.
    float max_slope = 4.0f;
};

// The inverse of a smaller one, times a light straight up, would overflow.
inline constexpr float smallest_max_slope = 1e-18f;
// A light straight up has a slope of 1e15 (shader/light.h), which has to be above all horizons.
inline constexpr float largest_max_slope = 1e14f;

// Checks max_slope.
[[nodiscard]] inline status check(const horizon_scale& scale) {
    if (!(scale.max_slope > 0.0f)) return {error::not_positive, "max_slope", double(scale.max_slope)};
    if (!(scale.max_slope >= smallest_max_slope))
        return {error::out_of_range, "max_slope", double(scale.max_slope), double(smallest_max_slope)};
    if (scale.stored != quantity::slope) return {};
    if (!is_finite(scale.max_slope)) return {error::not_finite, "max_slope", double(scale.max_slope)};
    if (!(scale.max_slope <= largest_max_slope))
        return {error::out_of_range, "max_slope", double(scale.max_slope), double(largest_max_slope)};
    return {};
}

// The quantity of a slope, not scaled: the slope itself, its sine, or radians. Any finite slope, and infinity.
[[nodiscard]] inline float quantity_of_slope(quantity stored, float slope) {
    switch (stored) {
        case quantity::sine: {
            // Neither the square of a large slope nor that of its inverse overflows.
            const float s = std::abs(slope);
            const float sine = s <= 1.0f ? s / std::sqrt(1.0f + s * s) : 1.0f / std::sqrt(1.0f + (1.0f / s) / s);
            return slope < 0.0f ? -sine : sine;
        }
        case quantity::angle: return std::atan(slope);
        case quantity::slope: break;
    }
    return slope;
}

// Its inverse. Sines of 1 and angles of 90 degrees are infinite slopes.
[[nodiscard]] inline float slope_of_quantity(quantity stored, float value) {
    switch (stored) {
        case quantity::sine: {
            const float cosine_square = (1.0f - value) * (1.0f + value);
            return cosine_square > 0.0f ? value / std::sqrt(cosine_square)
                                        : std::copysign(std::numeric_limits<float>::infinity(), value);
        }
        case quantity::angle:
            return std::abs(value) < 1.57079632f ? std::tan(value)
                                                 : std::copysign(std::numeric_limits<float>::infinity(), value);
        case quantity::slope: break;
    }
    return value;
}

// Factor from the quantity to what is stored: 1 where the slope is max_slope.
[[nodiscard]] inline float stored_scale(const horizon_scale& scale) {
    return 1.0f / quantity_of_slope(scale.stored, scale.max_slope);
}

// Slope to stored value, clamped to [0, 1].
[[nodiscard]] inline float to_stored(const horizon_scale& scale, float slope) {
    const float value = quantity_of_slope(scale.stored, slope) * stored_scale(scale);
    return value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

}  // namespace bumpshadow
