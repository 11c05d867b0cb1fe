// Bearings, elevations and shadow factors on a GPU.

#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/gl/expressions.hpp"
#include "support/skip.hpp"

using namespace expressions;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<inputs> all_lights() {
    std::vector<inputs> result;
    for (const vec4 light : lights()) result.push_back({{light}});
    return result;
}

constexpr expression bearings_and_elevations[] = {
    EXPRESSION(1e-6f, bumpshadow_square(vec2(a.x, a.y))),
    EXPRESSION(0.0f, bumpshadow_steep(vec2(a.x, a.y))),
    EXPRESSION(0.0f, bumpshadow_across(vec2(a.x, a.y))),
    EXPRESSION(1e-6f, bumpshadow_unfold(vec2(a.x, a.y), 0.1f)),
    EXPRESSION(1e-6f, bumpshadow_bearing_exact(vec2(a.x, a.y))),
    EXPRESSION(2e-7f, bumpshadow_bearing_quintic(vec2(a.x, a.y))),
    EXPRESSION(2e-7f, bumpshadow_bearing_cubic(vec2(a.x, a.y))),
    EXPRESSION(2e-7f, bumpshadow_bearing_octant(vec2(a.x, a.y))),
    EXPRESSION(2e-7f, bumpshadow_bearing_diamond(vec2(a.x, a.y))),
    EXPRESSION(1e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_sine(vec3(a.x, a.y, a.z))),
    EXPRESSION(5e-6f, bumpshadow_angle(vec3(a.x, a.y, a.z))),
};

// a: light, horizon, k, c. b: factor, distance, start, end.
constexpr expression shadow_factors[] = {
    EXPRESSION(0.0f, bumpshadow_shadow_hard(a.x, a.y)),
    EXPRESSION(1e-6f, bumpshadow_shadow_soft_above(a.x, a.y, a.z, a.w)),
    EXPRESSION(1e-6f, bumpshadow_shadow_soft(a.x, a.y, a.z, a.w)),
    EXPRESSION(1e-6f, bumpshadow_shadow_fade(b.x, b.y, b.z, b.w)),
};

constexpr expression pixel_places[] = {
    EXPRESSION(1e-6f, bumpshadow_pixel_place(a.x, a.y)),
};

std::vector<inputs> all_shadows() {
    std::vector<inputs> result;
    constexpr float distances[] = {0.0f, 5.0f, 10.0f, 12.5f, 20.0f, 1e10f}, ends[] = {20.0f, 10.0f, 5.0f};
    for (const float light : {-1e6f, -0.3f, -1e-40f, -0.0f, 0.0f, 1e-40f, 1e-10f, 0.25f, 0.5f, 1.0f, 3.0f, 1e6f})
        for (const float horizon : {-0.5f, 0.0f, 0.25f, 0.5f, 0.50390625f, 1.0f})
            for (const float k : {0.0f, 1e-40f, 1.0f, 20.0f, 1e10f, infinity})
                for (const float c : {0.5f, 1.0f}) {
                    const std::size_t i = result.size();
                    result.push_back({{vec4(light, horizon, k, c), vec4(c, distances[i % 6], 10.0f, ends[i / 6 % 3])}});
                }
    return result;
}

}  // namespace

TEST_CASE("bearings and elevations are those of C++") { check(bearings_and_elevations, all_lights()); }

TEST_CASE("shadow factors are those of C++, and in [0, 1]") {
    for (const outcome& result : check(shadow_factors, all_shadows())) {
        for (const difference& d : result.differences) {
            CHECK(d.least >= 0.0f);
            CHECK(d.most <= 1.0f);
        }
    }
}

TEST_CASE("places of a pixel are those of C++") {
    std::vector<inputs> places;
    for (const int taps : {1, 2, 3, 4, 8})
        for (int i = 0; i < taps * taps; ++i) places.push_back({{vec4(float(i), float(taps), 0.0f, 0.0f)}});
    check(pixel_places, places);
}

// A comparison that could not fail would be worth nothing.
TEST_CASE("a changed constant is noticed") {
    const std::vector<inputs> at = all_lights();
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (const std::string why = shader_run::missing(with); !why.empty()) {
            skip::because(why);
            continue;
        }
        for (const std::string name :
             {"bumpshadow_bearing_quintic", "bumpshadow_bearing_cubic", "bumpshadow_bearing_octant"}) {
            // The fifth decimal of the function's first constant.
            std::string functions = snippets(with);
            const std::size_t function = functions.find(name + '(');
            REQUIRE(function != std::string::npos);
            char& digit = functions.at(functions.find("0.", function) + 6);
            REQUIRE(digit >= '0');
            REQUIRE(digit <= '9');
            digit = digit == '9' ? '8' : char(digit + 1);
            const outcome result = compare(bearings_and_elevations, at, functions, with);
            REQUIRE_MESSAGE(result.error.empty(), result.error);
            for (std::size_t row = 0; row < result.differences.size(); ++row) {
                const expression& e = bearings_and_elevations[row];
                const bool within = result.differences[row].worst <= e.bound;
                const bool changed = std::string(e.text).starts_with(name);
                CHECK_MESSAGE(within != changed, with.name, " ", name, ": ", e.text);
            }
        }
    }
}
