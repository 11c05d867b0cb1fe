#pragma once

// Height maps to plan for, scenes and their recipes, shared by the tests of plan.hpp.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>

#include <bumpshadow/plan.hpp>

#include "support/shapes.hpp"

namespace plans {

using namespace bumpshadow;

inline constexpr double degree = std::numbers::pi / 180.0;
using lights = std::vector<glm::dvec3>;

template <height_sample Sample>
[[nodiscard]] recipe planned(const height_map<Sample>& heights, const scene& wanted, const plan_options& options = {}) {
    recipe r;
    const status s = plan(heights, wanted, r, options);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    CHECK(r.lines > 0);
    return r;
}

// Far light at a bearing in turns and an elevation in degrees.
[[nodiscard]] inline glm::dvec3 light_at(double bearing, double elevation) {
    return glm::dvec3(shapes::direction(bearing) * std::cos(elevation * degree), std::sin(elevation * degree));
}

// Smooth hills as wide as the map, up to 5/8 of an eighth of it high.
[[nodiscard]] inline shapes::field<float> hills(int side = 64) {
    const auto waves = shapes::waves({side, side});
    return shapes::sampled<float>({side, side}, [&](double x, double y) { return 0.06 * side * waves(x, y); });
}

// One cone of 45 degrees and height 1 to 2 in each square of 8 x 8 texels: what they shadow under light of slope s is
// at most 2 / s away.
[[nodiscard]] inline shapes::field<float> studs(int side = 64) {
    shapes::noise random(5);
    std::vector<glm::dvec3> tips;  // in its square, and how high
    for (int i = 0; i < side * side / 64; ++i)
        tips.push_back({2.0 + 3.0 * random.uniform(), 2.0 + 3.0 * random.uniform(), 1.0 + random.uniform()});
    return shapes::sampled<float>({side, side}, [&](double x, double y) {
        const glm::dvec3 tip = tips[std::size_t(int(y) / 8 * (side / 8) + int(x) / 8)];
        return std::max(0.0, tip.z - std::hypot(std::fmod(x, 8.0) - tip.x, std::fmod(y, 8.0) - tip.y));
    });
}

// Cones anywhere, some on top of each other: sharp, and nowhere alike.
[[nodiscard]] inline shapes::field<float> heap(int side = 64) {
    shapes::noise random(11);
    shapes::field<float> all{{side, side}, std::vector<float>(std::size_t(side) * std::size_t(side))};
    for (int i = 0; i < side * side / 100; ++i) {
        const glm::dvec2 center(random.uniform() * side, random.uniform() * side);
        const double height = 2.0 + 5.0 * random.uniform();
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const auto apart = [side](double a, double b) {
                    return std::min(std::abs(a - b), side - std::abs(a - b));
                };
                const double here = height - std::hypot(apart(x, center.x), apart(y, center.y));
                all.at(x, y) = std::max(all.at(x, y), float(here));
            }
    }
    return all;
}

[[nodiscard]] inline scene with_lights(const lights& some) {
    scene s;
    s.lights = some;
    return s;
}
[[nodiscard]] inline scene with_arc(const light_arc& arc, double mismatch = 0.015) {
    scene s;
    s.arc = arc;
    s.mismatch = mismatch;
    return s;
}

}  // namespace plans
