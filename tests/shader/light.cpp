// Bearings, elevations and shadow factors of the snippets.

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/shader/shader.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <doctest/doctest.h>

using namespace bumpshadow;
using glm::vec2;
using glm::vec3;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

double turns_apart(double a, double b) {
    const double d = std::abs(a - b - std::round(a - b));
    return d;
}

}  // namespace

TEST_CASE("shader bearings are those that the slices are baked for") {
    double worst[6] = {};
    for (int i = 0; i < 20000; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 20000.0, length = std::pow(10.0, i % 13 - 6);
        const vec2 v(float(length * std::cos(angle)), float(length * std::sin(angle)));
        const auto compare = [&](int which, float of_shader, bearing_function function) {
            worst[which] = std::max(worst[which], turns_apart(double(of_shader), double(to_bearing(function, v))));
            CHECK(of_shader >= -0.1250001f);
            CHECK(of_shader <= 0.875f);
        };
        compare(0, shader::bumpshadow_bearing_exact(v), bearing_function::exact);
        compare(1, shader::bumpshadow_bearing_quintic(v), bearing_function::quintic);
        compare(3, shader::bumpshadow_bearing_octant(v), bearing_function::octant);
        compare(4, shader::bumpshadow_bearing_diamond(v), bearing_function::diamond);
        compare(5, shader::bumpshadow_bearing_cubic(v), bearing_function::cubic);
    }
    for (const double w : worst) CHECK(w < 2e-7);
    for (const float zero : {0.0f, -0.0f}) {
        CHECK(shader::bumpshadow_bearing_exact(vec2(zero, zero)) == 0.0f);
        CHECK(shader::bumpshadow_bearing_quintic(vec2(zero, zero)) == 0.0f);
        CHECK(shader::bumpshadow_bearing_cubic(vec2(zero, zero)) == 0.0f);
        CHECK(shader::bumpshadow_bearing_octant(vec2(zero, zero)) == 0.0f);
        CHECK(shader::bumpshadow_bearing_diamond(vec2(zero, zero)) == 0.0f);
    }
}

TEST_CASE("shader elevation of a light") {
    const vec3 thirty(0.6f * std::sqrt(0.75f), -0.8f * std::sqrt(0.75f), 0.5f);
    for (const float length : {1.0f, 1e-6f, 1e6f}) {
        CHECK(shader::bumpshadow_slope(thirty * length) == doctest::Approx(1.0 / std::sqrt(3.0)));
        CHECK(shader::bumpshadow_sine(thirty * length) == doctest::Approx(0.5));
        CHECK(shader::bumpshadow_angle(thirty * length) == doctest::Approx(std::numbers::pi / 6.0));
    }
    CHECK(shader::bumpshadow_slope(vec3(3.0f, 4.0f, -5.0f)) == doctest::Approx(-1.0));
    CHECK(shader::bumpshadow_slope(vec3(0.0f, 0.0f, 1.0f)) == doctest::Approx(1e15));
    CHECK(shader::bumpshadow_sine(vec3(0.0f, 0.0f, 2.0f)) == doctest::Approx(1.0));
    CHECK(shader::bumpshadow_slope(vec3(0.0f, 0.0f, 0.0f)) == 0.0f);
    CHECK(shader::bumpshadow_sine(vec3(0.0f, 0.0f, 0.0f)) == 0.0f);
}

TEST_CASE("shader shadow factors") {
    using shader::bumpshadow_shadow_hard;
    using shader::bumpshadow_shadow_soft;
    CHECK(bumpshadow_shadow_hard(0.5f, 0.5f) == 1.0f);
    CHECK(bumpshadow_shadow_hard(0.49f, 0.5f) == 0.0f);
    CHECK(bumpshadow_shadow_hard(-0.1f, -0.5f) == 0.0f);
    CHECK(bumpshadow_shadow_hard(0.0f, 0.0f) == 1.0f);
    // Lengyel, equation 5.4 with k = 8: 1 at the horizon, 0 at s - 1/8, half way between.
    CHECK(bumpshadow_shadow_soft(0.5f, 0.5f, 8.0f, 1.0f) == 1.0f);
    CHECK(bumpshadow_shadow_soft(0.375f, 0.5f, 8.0f, 1.0f) == 0.0f);
    CHECK(bumpshadow_shadow_soft(0.4375f, 0.5f, 8.0f, 1.0f) == 0.5f);
    // The radial horizon maps' edge: 0.5 + 20 (light - horizon).
    CHECK(bumpshadow_shadow_soft(0.5f, 0.5f, 20.0f, 0.5f) == 0.5f);
    CHECK(bumpshadow_shadow_soft(0.51f, 0.5f, 20.0f, 0.5f) == doctest::Approx(0.7));
    CHECK(bumpshadow_shadow_soft(-1e-6f, 0.0f, 1.0f, 1.0f) == 0.0f);
    // k of 0 and of infinity.
    CHECK(bumpshadow_shadow_soft(0.1f, 0.9f, 0.0f, 1.0f) == 1.0f);
    CHECK(bumpshadow_shadow_soft(0.5f, 0.5f, infinity, 1.0f) == 1.0f);
    CHECK(bumpshadow_shadow_soft(0.5f, 0.5f, infinity, 0.5f) == 0.5f);
    CHECK(bumpshadow_shadow_soft(0.4f, 0.5f, infinity, 0.5f) == 0.0f);
    CHECK(bumpshadow_shadow_soft(1e6f, 0.5f, infinity, 0.5f) == 1.0f);
}

// The published pixel shader compares by `sub r0.a, v0, t2_bias` and `cnd` (greater than 0.5). Its normal comes from
// t0, which is the diffuse map; t1, the normal map, is meant.
TEST_CASE("shader: the published comparison of light and horizon") {
    for (int light = 0; light <= 255; ++light)
        for (int horizon = 0; horizon <= 255; ++horizon) {
            if (light == horizon) continue;  // dark there, lit here
            const float l = float(light) / 255.0f, h = float(horizon) / 255.0f;
            const bool lit = l - (h - 0.5f) > 0.5f;
            CHECK(shader::bumpshadow_shadow_hard(l, h) == (lit ? 1.0f : 0.0f));
        }
}
