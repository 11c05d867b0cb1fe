#pragma once

// The compute kernel that bakes horizons: plans, maps to try it on, the kernel as C++, and how its slopes compare with
// those of the cascade.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/ext/vector_int4.hpp>

#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/shader/bake_plan.hpp>

#include "support/shapes.hpp"

namespace bake_kernel {

using glm::abs;
using glm::clamp;
using glm::intBitsToFloat;
using glm::ivec3;
using glm::ivec4;
using glm::max;
using glm::min;
using glm::vec2;
using glm::vec3;
using uint = unsigned;

// The kernel, its buffers being members.
struct kernel {
    const float* bumpshadow_bake_heights;
    const ivec4* bumpshadow_bake_tables;
    float* bumpshadow_bake_scratch;
    float* bumpshadow_bake_slopes;

#define BUMPSHADOW_FUNCTION inline
#include <bumpshadow/shader/bake.h>
#undef BUMPSHADOW_FUNCTION
};

struct trial {
    std::string name;
    shapes::field<float> field;
    bumpshadow::height_map<float> heights;
    std::vector<glm::dvec2> directions;
    bumpshadow::bake_options options = {};

    trial(std::string title, shapes::field<float> samples, bumpshadow::edge_mode edge, std::vector<glm::dvec2> list,
          int steps = 12)
        : name(std::move(title)), field(std::move(samples)), heights(field.view(edge)), directions(std::move(list)) {
        options.steps = steps;
    }
    trial(const trial&) = delete;
    trial& operator=(const trial&) = delete;
};

// Stones with grain, and joints between them; no two heights are equal.
[[nodiscard]] inline shapes::field<float> stones(glm::ivec2 extent, std::uint64_t seed) {
    shapes::noise source(seed);
    const auto waves = shapes::waves(extent);
    return shapes::sampled<float>(extent, [&](double x, double y) {
        const double bump = std::abs(std::sin(0.37 * x + 0.11 * y) * std::sin(0.29 * y - 0.05 * x));
        return 1.5 * waves(x, y) + 3.0 * std::sqrt(bump) + 0.4 * source.uniform();
    });
}

// Towers far apart on almost even ground, so that most horizons are of the higher levels.
[[nodiscard]] inline shapes::field<float> towers(glm::ivec2 extent, std::uint64_t seed) {
    shapes::noise source(seed);
    const auto waves = shapes::waves(extent);
    shapes::field<float> field = shapes::sampled<float>(
        extent, [&](double x, double y) { return 0.05 * waves(x, y) + 0.01 * source.uniform(); });
    for (int i = 0; i < (std::max)(extent.x * extent.y / 600, 1); ++i)
        field.at(source.between(0, extent.x - 1), source.between(0, extent.y - 1)) +=
            float(4.0 + 16.0 * source.uniform());
    return field;
}

// Bricks of a few heights, whose tops are even: many occluders make the same slope.
[[nodiscard]] inline shapes::field<float> bricks(glm::ivec2 extent, std::uint64_t seed) {
    shapes::noise source(seed);
    float heights[8][8];
    for (auto& row : heights)
        for (float& height : row) height = 0.1f * float(source.between(10, 14));
    return shapes::sampled<float>(extent, [&](double x, double y) {
        const int i = int(x) / 12 % 8, j = int(y) / 9 % 8;
        const bool joint = int(x) % 12 < 2 || int(y) % 9 < 2;
        return joint ? 0.0f : heights[j][i];
    });
}

constexpr float hole = -1e37f;

// What maps come with besides heights, with an edge mode: sizes, scale and datum, radii, holes, rows that lie apart;
// and all of these at once.
[[nodiscard]] inline std::deque<trial> unusual(bumpshadow::edge_mode edge) {
    const std::vector<glm::dvec2> directions = shapes::directions(8, 0.02);
    const auto with_holes = [](shapes::field<float> field) {
        shapes::noise source(4);
        for (float& height : field.samples)
            if (source.uniform() < 0.02) height = hole;
        for (int y = 20; y < 40; ++y)
            for (int x = 30; x < 50; ++x) field.at(x, y) = hole;
        return field;
    };
    std::deque<trial> all;
    trial& sized = all.emplace_back("texels of 0.5 x 0.8", towers({80, 72}, 5), edge, directions);
    sized.heights.texel_size = {0.5, 0.8};
    sized.heights.height_scale = 0.3;
    sized.heights.datum = 0.25;

    shapes::field<float> high = towers({80, 72}, 5);
    for (float& height : high.samples) height += 1000.0f;
    all.emplace_back("far from zero", std::move(high), edge, directions).heights.datum = 1000.0;

    all.emplace_back("radius 30", towers({80, 72}, 5), edge, directions).options.radius = 30.0;
    all.emplace_back("radius 5", towers({80, 72}, 5), edge, directions).options.radius = 5.0;
    all.emplace_back("holes", with_holes(towers({80, 72}, 6)), edge, directions).heights.no_data = hole;
    all.emplace_back("rows apart", towers({80, 72}, 2), edge, directions).heights.extent.x = 67;

    trial& every = all.emplace_back("all at once", with_holes(stones({80, 72}, 7)), edge, directions, 24);
    every.heights.extent.x = 67;
    every.heights.no_data = hole;
    every.heights.texel_size = {1.5, 1.1};
    every.heights.height_scale = 2.5;
    every.heights.datum = -3.0;
    every.options.radius = 45.0;
    return all;
}

// A plan that owns its memory.
struct owned_plan {
    std::vector<ivec4> tables;
    std::vector<bumpshadow::bake_dispatch> dispatches;
    bumpshadow::bake_plan plan;
};

// What a map's heights differ by, so that the kernel looks as far as the cascade does.
[[nodiscard]] inline double relief_of(const trial& t) {
    double lowest = 1e30, highest = -1e30;
    for (const float height : t.field.samples)
        if (!bumpshadow::is_no_data(t.heights, height)) {
            lowest = (std::min)(lowest, double(height) * t.heights.height_scale);
            highest = (std::max)(highest, double(height) * t.heights.height_scale);
        }
    return highest - lowest;
}

inline void plan(const trial& t, owned_plan& to) {
    bumpshadow::status s = plan_bake(t.heights, t.directions, to.plan, t.options, relief_of(t));
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    to.tables.resize(to.plan.table_count);
    to.dispatches.resize(to.plan.dispatch_count);
    to.plan.tables = to.tables;
    to.plan.dispatches = to.dispatches;
    s = plan_bake(t.heights, t.directions, to.plan, t.options, relief_of(t));
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
}

// Slopes of the kernel run as C++. What it reads before it is written is NaN, and shows.
[[nodiscard]] inline std::vector<float> run_as_cpp(const trial& t, const owned_plan& how) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> scratch(how.plan.scratch_floats, nan), slopes(how.plan.slope_count, nan);
    kernel k{t.field.samples.data(), how.tables.data(), scratch.data(), slopes.data()};
    for (const bumpshadow::bake_dispatch& d : how.dispatches)
        for (int z = 0; z < d.groups.z; ++z)
            for (int y = 0; y < d.groups.y * bumpshadow::bake_group.y; ++y)
                for (int x = 0; x < d.groups.x * bumpshadow::bake_group.x; ++x)
                    k.bumpshadow_bake(d.constants[0], d.constants[1], {x, y, z});
    return slopes;
}

[[nodiscard]] inline std::vector<float> run_cascade(const trial& t) {
    std::vector<float> slopes(bumpshadow::required_size(t.heights.extent, int(t.directions.size())));
    const bumpshadow::horizon_map out{
        .values = slopes, .extent = t.heights.extent, .bearings = int(t.directions.size())};
    const bumpshadow::status s = bake_cascade(t.heights, t.directions, out, t.options);
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    return slopes;
}

// Differences over max(1, |slope|).
struct agreement {
    double worst = 0.0;
    double apart = 0.0;  // share of slopes that differ by more than 1e-5

    void include(const agreement& other) {
        worst = (std::max)(worst, other.worst);
        apart = (std::max)(apart, other.apart);
    }
};
[[nodiscard]] inline agreement compare(std::span<const float> slopes, std::span<const float> expected) {
    REQUIRE(slopes.size() == expected.size());
    agreement a;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        if (slopes[i] == expected[i]) continue;
        const double size = (std::max)(1.0, std::abs(double(expected[i])));
        double difference = std::abs(double(slopes[i]) - double(expected[i])) / size;
        if (!(difference < 1e30)) difference = 1e30;
        a.worst = (std::max)(a.worst, difference);
        apart += difference > 1e-5 ? 1 : 0;
    }
    a.apart = double(apart) / double(slopes.size());
    return a;
}

[[nodiscard]] inline agreement check(const trial& t, std::span<const float> slopes) {
    const agreement a = compare(slopes, run_cascade(t));
    CHECK_MESSAGE(a.apart <= 0.001, t.name, ": ", a.apart, ", worst ", a.worst);
    return a;
}

inline void print(const agreement& a, const std::string& of) {
    std::printf("%s: worst difference %.2g, at most %.4f %% above 1e-5\n", of.c_str(), a.worst, 100.0 * a.apart);
}

}  // namespace bake_kernel
