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

namespace {

constexpr float largest = std::numeric_limits<float>::max(), denormal = 1e-40f;

const float none = 0.0f, undefined = none / none;

// Zero, too long and too short for their squares, straight up and down, in the surface, grazing, below it.
const vec3 bad_lights[] = {
    {0.0f, 0.0f, 0.0f},
    {-0.0f, -0.0f, -0.0f},
    {3e4f, -2e4f, 7e5f},
    {1e30f, 1e30f, 1e30f},
    {largest, 0.0f, largest},
    {-largest, largest, -largest},
    {denormal, -denormal, denormal},
    {denormal, 0.0f, 1.0f},
    {0.0f, 0.0f, 1.0f},
    {0.0f, 0.0f, largest},
    {0.0f, 0.0f, denormal},
    {0.0f, 0.0f, -1.0f},
    {0.0f, 0.0f, -largest},
    {1.0f, 0.0f, 0.0f},
    {0.0f, -1.0f, -denormal},
    {-0.6f, 0.0f, -0.8f},
    {0.6f, 0.8f, 1e-7f},
    {-1.0f, 1.0f, -1e-7f},
    {1.0f, -1.0f, 1.0f},
};
// Some or all of a light's components.
constexpr float infinite[] = {
    0.0f, 1.0f, -1e-7f, largest, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()};
constexpr float all_k[] = {0.0f, denormal, 1.0f, 8.0f, 1e30f, largest, infinity};

using level_function = float (*)(vec3);
constexpr level_function levels[] = {shader::bumpshadow_slope, shader::bumpshadow_sine, shader::bumpshadow_angle};

// What the head of the paste files has a level divided by.
float divisor_of(float max_slope) { return std::max(max_slope, 1e-6f); }

bool is_factor(float v) { return v >= 0.0f && v <= 1.0f; }  // not so for what is not a number

// Every form of the factor, c of 1 and 0.5.
bool are_factors(float level, float horizon, float k) {
    bool good = is_factor(shader::bumpshadow_shadow_hard(level, horizon));
    for (const float c : {1.0f, 0.5f}) {
        const float soft = shader::bumpshadow_shadow_soft(level, horizon, k, c);
        const float above = shader::bumpshadow_shadow_soft_above(level, horizon, k, c);
        good = good && is_factor(soft) && is_factor(above);
        for (const float distance : {0.0f, 5.0f, infinity})
            for (const float end : {0.0f, 5.0f, infinity})
                good = good && is_factor(shader::bumpshadow_shadow_fade(soft, distance, 5.0f, end));
    }
    return good;
}

}  // namespace

TEST_CASE("shader shadow factors are finite and in [0, 1] for every input") {
    for (const vec3 light : bad_lights)
        for (const level_function level : levels)
            for (const float max_slope : {0.0f, denormal, 4.0f})
                for (const float horizon : {0.0f, 0.3f, 1.0f})
                    for (const float k : all_k) {
                        CAPTURE(light.x);
                        CAPTURE(light.z);
                        CAPTURE(max_slope);
                        CAPTURE(k);
                        CHECK(are_factors(level(light) / divisor_of(max_slope), horizon, k));
                        CHECK(are_factors(level(light) / max_slope, horizon, k));  // 1 / 0 and 0 / 0
                        CHECK(are_factors(level(light), horizon * max_slope, k));
                    }
    for (const float level : {infinity, -infinity, undefined, largest, 0.5f})
        for (const float horizon : {infinity, -infinity, undefined, 0.0f})
            for (const float k : all_k) CHECK(are_factors(level, horizon, k));
    for (const float k : all_k) {
        const bool straight_up = k > 0.0f;
        for (const float c : {1.0f, 0.5f}) {
            CHECK(shader::bumpshadow_shadow_soft(infinity, 0.7f, k, c) == (straight_up ? 1.0f : 0.0f));
            CHECK(shader::bumpshadow_shadow_soft(undefined, 0.7f, k, c) == 0.0f);
            CHECK(shader::bumpshadow_shadow_soft_above(undefined, 0.7f, k, c) == 0.0f);
        }
    }
    CHECK(shader::bumpshadow_shadow_hard(infinity, 0.7f) == 1.0f);
    CHECK(shader::bumpshadow_shadow_hard(undefined, 0.7f) == 0.0f);
    // A horizon that is not a number blocks no light there, and all of it with a soft edge.
    CHECK(shader::bumpshadow_shadow_hard(0.7f, undefined) == 1.0f);
    CHECK(shader::bumpshadow_shadow_hard(-0.7f, undefined) == 0.0f);
    CHECK(shader::bumpshadow_shadow_soft(0.7f, undefined, 8.0f, 1.0f) == 0.0f);
}

TEST_CASE(
    "shader shadow factors of lights that are not finite are 0 or 1 without a soft edge, and in [0, 1] with one") {
    for (const float x : infinite)
        for (const float y : infinite)
            for (const float z : infinite) {
                const vec3 light(x, y, z);
                const bool undefined_level = std::isnan(x) || std::isnan(y) || std::isnan(z);
                for (const level_function level : levels)
                    for (const float horizon : {0.0f, 0.3f, 1.0f})
                        for (const float k : all_k) {
                            CHECK(are_factors(level(light) / divisor_of(4.0f), horizon, k));
                            if (!undefined_level) continue;
                            CHECK(shader::bumpshadow_shadow_hard(level(light), horizon) == 0.0f);
                            CHECK(shader::bumpshadow_shadow_soft(level(light), horizon, k, 0.5f) == 0.0f);
                            CHECK(shader::bumpshadow_shadow_soft_above(level(light), horizon, k, 0.5f) == 0.0f);
                        }
                // Horizons of decoders that compute with the bearing of such a light.
                const glm::vec4 low(0.1f, 0.2f, 0.3f, 0.4f), high(0.5f, 0.6f, 0.7f, 0.8f);
                const vec2 v(x, y);
                for (const float horizon :
                     {shader::bumpshadow_sine_layers(low, high, v), shader::bumpshadow_sine_half(low, high.x, v),
                      shader::bumpshadow_sine_layers_factors(low, high, shader::bumpshadow_factors(v)),
                      shader::bumpshadow_fourier_5(low, 0.5f, shader::bumpshadow_fourier_direction(v))})
                    for (const float k : all_k) CHECK(are_factors(shader::bumpshadow_slope(light), horizon, k));
            }
}

// Its max_slope is 0, and so is all that its texture holds.
TEST_CASE("shader: a flat map is lit from above, in its plane as c says, and not from below") {
    const float divisor = divisor_of(0.0f);
    for (const level_function level : levels)
        for (const float k : {1.0f, 8.0f, infinity})
            for (const float c : {1.0f, 0.5f}) {
                const auto factor = [&](vec3 light) {
                    return shader::bumpshadow_shadow_soft(level(light) / divisor, 0.0f, k, c);
                };
                for (const vec3 up : {vec3(0, 0, 1), vec3(0, 0, 1e15f), vec3(3, -4, 0.01f), vec3(-1e-6f, 0, 1e-6f)})
                    CHECK(factor(up) == 1.0f);
                for (const vec3 plane : {vec3(0, 0, 0), vec3(1, 0, 0), vec3(-1e10f, 1e10f, 0)})
                    CHECK(factor(plane) == c);
                for (const vec3 down : {vec3(0, 0, -1), vec3(1, 2, -0.01f)}) CHECK(factor(down) == 0.0f);
            }
}

TEST_CASE("shader bearings and decoders are finite for every light") {
    constexpr float (*bearings[])(vec2) = {shader::bumpshadow_bearing_exact, shader::bumpshadow_bearing_quintic,
                                           shader::bumpshadow_bearing_cubic, shader::bumpshadow_bearing_octant,
                                           shader::bumpshadow_bearing_diamond};
    const glm::vec4 low(0.1f, 0.2f, 0.3f, 0.4f), high(0.5f, 0.6f, 0.7f, 0.8f);
    for (const vec3 light : bad_lights) {
        CAPTURE(light.x);
        CAPTURE(light.y);
        const vec2 v(light.x, light.y);
        for (const auto bearing : bearings) {
            const float b = bearing(v);
            CHECK((b >= -0.1250001f && b <= 0.875f));
            const vec3 layers = shader::bumpshadow_tangent_layers(b, 0.0f, 16.0f);
            CHECK((layers.x >= 0.0f && layers.x < 16.0f && layers.y >= 0.0f && layers.y < 16.0f));
            CHECK(is_factor(layers.z));
        }
        CHECK(is_factor(shader::bumpshadow_sine_layers(low, high, v)));
        CHECK(is_factor(shader::bumpshadow_sine_half(low, high.x, v)));
        CHECK(is_factor(shader::bumpshadow_sine_layers_factors(low, high, shader::bumpshadow_factors(v))));
        const float series = shader::bumpshadow_fourier_5(low, 0.5f, shader::bumpshadow_fourier_direction(v));
        CHECK((series >= -0.5f && series <= 1.5f));
    }
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
