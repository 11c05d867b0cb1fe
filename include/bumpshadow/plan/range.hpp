#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/plan/scene.hpp>

// Where the light of a scene comes from, and how steep a surface is. Part of plan.hpp.
namespace bumpshadow::plan_detail {

[[nodiscard]] inline double degrees_of(double slope) { return std::atan(slope) * (180.0 / std::numbers::pi); }

// Where light comes from.
struct light_range {
    double first = 0.0, arc = 1.0;  // bearings, true angles in turns; arc 1: all of them, 0: one
    double lowest_slope = 0.0;
    double highest_slope = (std::numeric_limits<double>::max)();
};

inline constexpr double least_arc = 1e-5;  // turns: 0.0036 degrees

[[nodiscard]] inline double middle_elevation(const light_range& r) {
    return 0.5 * (degrees_of(r.lowest_slope) + degrees_of(r.highest_slope));
}

[[nodiscard]] inline light_range range_of(const scene& s) {
    light_range r;
    if (!s.lights.empty()) {
        r.lowest_slope = (std::numeric_limits<double>::max)();
        r.highest_slope = 0.0;
        // The widest gap between neighboring bearings is what the arc leaves out. A light straight up has no bearing.
        double widest = 0.0;
        int sides = 0;
        for (const glm::dvec3& v : s.lights) {
            const double flat = std::hypot(v.x, v.y), slope = flat > 0.0 ? v.z / flat : 1e9;
            r.lowest_slope = (std::min)(r.lowest_slope, slope);
            r.highest_slope = (std::max)(r.highest_slope, slope);
            if (!(flat > 0.0)) continue;
            ++sides;
            const double at = exact_bearing(glm::dvec2(v));
            double gap = 1.0;  // to the next bearing
            for (const glm::dvec3& w : s.lights) {
                if (!(std::hypot(w.x, w.y) > 0.0)) continue;
                const double way = exact_bearing(glm::dvec2(w)) - at;
                const double turns = way - std::floor(way);
                if (turns > 1e-6 && turns < 1.0 - 1e-6) gap = (std::min)(gap, turns);
            }
            if (gap <= widest) continue;
            widest = gap;
            r.first = at + (gap < 1.0 ? gap : 0.0);
        }
        r.arc = sides == 0 ? 0.0 : 1.0 - widest;
    } else if (s.positions.empty()) {
        r.first = s.arc.first_bearing;
        r.arc = s.arc.last_bearing - s.arc.first_bearing;
        r.lowest_slope = std::tan(s.arc.lowest * (std::numbers::pi / 180.0));
        if (s.arc.highest < 89.9) r.highest_slope = std::tan(s.arc.highest * (std::numbers::pi / 180.0));
    }
    // What light sees as one bearing is one.
    if (r.arc > 0.0 && r.arc < least_arc) r.first += 0.5 * r.arc, r.arc = 0.0;
    // An arc saves less than its ends cost.
    if (r.arc > 0.9) r.first = 0.0, r.arc = 1.0;
    return r;
}

// No horizon is above the steepest rise of the surface in any direction.
template <height_sample Sample>
[[nodiscard]] double steepest_rise(const height_map<Sample>& heights) {
    double x_rise = 0.0, y_rise = 0.0;
    const bool around = heights.edge == edge_mode::repeat;
    for (int y = 0; y < heights.extent.y; ++y) {
        const bool last = y + 1 == heights.extent.y;
        const Sample* const row = heights.samples + y * heights.row_stride;
        const Sample* const below = last ? (around ? heights.samples : row) : row + heights.row_stride;
        double along = 0.0, across = 0.0;
        const auto rise = [&](Sample a, Sample b) {
            return is_no_data(heights, a) || is_no_data(heights, b) ? 0.0 : std::abs(double(a) - double(b));
        };
        for (int x = 0; x + 1 < heights.extent.x; ++x) along = (std::max)(along, rise(row[x], row[x + 1]));
        if (around) along = (std::max)(along, rise(row[heights.extent.x - 1], row[0]));
        for (int x = 0; x < heights.extent.x; ++x) across = (std::max)(across, rise(row[x], below[x]));
        x_rise = (std::max)(x_rise, along);
        y_rise = (std::max)(y_rise, across);
    }
    const double unit = std::abs(unit_height(heights));
    return std::hypot(unit * x_rise / heights.texel_size.x, unit * y_rise / heights.texel_size.y);
}

}  // namespace bumpshadow::plan_detail
