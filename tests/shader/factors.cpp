#include <bumpshadow/shader/shader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include <doctest/doctest.h>

#include "support/shapes.hpp"

using namespace bumpshadow::shader;

namespace {

std::array<float, 8> list(const bumpshadow_eight& f) {
    return {f.layer0.x, f.layer0.y, f.layer0.z, f.layer0.w, f.layer1.x, f.layer1.y, f.layer1.z, f.layer1.w};
}

float sum(const bumpshadow_eight& f) {
    float all = 0.0f;
    for (const float v : list(f)) all += v;
    return all;
}

vec2 direction(double turns, double length = 1.0) {
    const double a = turns * 2.0 * std::numbers::pi;
    return vec2(std::cos(a) * length, std::sin(a) * length);
}

// Tent functions of the angle, written from the text of section 5.3.
double tent(double turns, int i) {
    double away = 8.0 * turns - i;
    away -= 8.0 * std::round(away / 8.0);
    return std::max(0.0, 1.0 - std::abs(away));
}

const vec4 layer0(0.1f, 0.2f, 0.3f, 0.4f), layer1(0.5f, 0.6f, 0.7f, 0.8f);

// Listing 5.1 after its texture fetches, `color` being 1. It says float4, which GLSL does not know: vec4 is meant.
float listing(vec3 ldir, vec4 factors, vec4 h0, vec4 h1) {
    const float kShadowHardness = 8.0f;
    const vec3 L = normalize(ldir);
    const vec4 f0 = clamp(factors * 2.0f - 1.0f, 0.0f, 1.0f);
    const vec4 f1 = clamp(factors * -2.0f + 1.0f, 0.0f, 1.0f);
    const float s0 = dot(h0, f0);
    const float s1 = dot(h1, f1);
    return clamp((L.z - (s0 + s1)) * kShadowHardness + 1.0f, 0.0f, 1.0f);
}

}  // namespace

TEST_CASE("factors: equation 5.3 worked by hand") {
    // 255, 51, 102 and 178.5 of 255: 2 f - 1 is 1, -0.6, -0.2 and 0.4.
    const auto f = list(bumpshadow_factors_published_cube(vec4(1.0f, 0.2f, 0.4f, 0.7f)));
    const std::array<double, 8> wanted = {1.0, 0.0, 0.0, 0.4, 0.0, 0.6, 0.2, 0.0};
    for (std::size_t i = 0; i < 8; ++i) CHECK(double(f[i]) == doctest::Approx(wanted[i]));
    // 0.1 + 0.4 * 0.4 + 0.6 * 0.6 + 0.2 * 0.7
    const float s =
        bumpshadow_sine_layers_factors(layer0, layer1, bumpshadow_factors_published_cube(vec4(1.0f, 0.2f, 0.4f, 0.7f)));
    CHECK(double(s) == doctest::Approx(0.76));
    // Half way between 0 and 45 degrees, and between 270 and 315.
    CHECK(double(bumpshadow_sine_layers_factors(layer0, layer1, bumpshadow_factors_of_bearing(0.0625f))) ==
          doctest::Approx(0.15));
    CHECK(double(bumpshadow_sine_layers_factors(layer0, layer1, bumpshadow_factors_of_bearing(0.8125f))) ==
          doctest::Approx(0.75));
}

TEST_CASE("factors: equation 5.4 worked by hand") {
    // F = 8 (0.5 - 0.55) + 1; the edge is 1/8 wide and ends where light and horizon meet.
    CHECK(double(bumpshadow_shadow_soft(0.5f, 0.55f, 8.0f, 1.0f)) == doctest::Approx(0.6));
    CHECK(bumpshadow_shadow_soft(0.5f, 0.5f, 8.0f, 1.0f) == 1.0f);
    CHECK(bumpshadow_shadow_soft(0.375f, 0.5f, 8.0f, 1.0f) == 0.0f);
}

TEST_CASE("factors: bytes of the two forms of a cube") {
    for (int byte = 0; byte < 256; ++byte) {
        const float stored = float(byte) / 255.0f;
        const vec4 texel(stored, stored, stored, stored);
        const auto published = bumpshadow_factors_published_cube(texel), biased = bumpshadow_factors_biased_cube(texel);
        const double p = 2.0 * byte / 255 - 1.0, b = std::max(byte - 128, -127) / 127.0;
        CHECK(double(published.layer0.y) == doctest::Approx(std::max(p, 0.0)).epsilon(1e-6));
        CHECK(double(published.layer1.y) == doctest::Approx(std::max(-p, 0.0)).epsilon(1e-6));
        CHECK(std::abs(double(biased.layer0.y) - std::max(b, 0.0)) < 3e-7);
        CHECK(std::abs(double(biased.layer1.y) - std::max(-b, 0.0)) < 3e-7);
    }
}

TEST_CASE("factors: a biased cube without the structure") {
    // 255, 26, 77 and 166 of 255 stand for 1, -102/127, -51/127 and 38/127.
    const vec4 texel(1.0f, 26.0f / 255.0f, 77.0f / 255.0f, 166.0f / 255.0f);
    const double wanted = (127 * 0.1 + 38 * 0.4 + 102 * 0.6 + 51 * 0.7) / 127.0;
    CHECK(double(bumpshadow_sine_layers_biased_cube(layer0, layer1, texel)) == doctest::Approx(wanted).epsilon(1e-6));
    CHECK(bumpshadow_sine_layers_biased_cube(layer0, layer1, texel) ==
          bumpshadow_sine_layers_factors(layer0, layer1, bumpshadow_factors_biased_cube(texel)));
}

TEST_CASE("factors: without a cube they add up to 1 in every direction") {
    double worst = 0.0, apart = 0.0;
    for (const double length : {1e-6, 0.3, 1.0, 1e6})
        for (int i = 0; i < 20000; ++i) {
            const double turns = i / 20000.0;
            const auto f = bumpshadow_factors(direction(turns, length));
            worst = std::max(worst, std::abs(double(sum(f)) - 1.0));
            const auto values = list(f);
            int used = 0;
            for (int c = 0; c < 8; ++c) {
                const double v = double(values[std::size_t(c)]);
                CHECK((v >= 0.0 && v <= 1.0));
                apart = std::max(apart, std::abs(v - tent(turns, c)));
                used += v > 1e-6 ? 1 : 0;
            }
            CHECK(used <= 2);
        }
    CHECK(worst < 5e-7);
    CHECK(apart < 0.35 / 45.0);
    for (int i = 0; i < 20000; ++i) {
        const double turns = i / 10000.0 - 1.0;
        const auto f = bumpshadow_factors_of_bearing(float(turns));
        CHECK(std::abs(double(sum(f)) - 1.0) < 1e-6);
        const auto values = list(f);
        for (int c = 0; c < 8; ++c) CHECK(std::abs(double(values[std::size_t(c)]) - tent(turns, c)) < 2e-6);
    }
}

TEST_CASE("factors: the eight directions themselves are exact, and the zero vector is +x") {
    const float s = std::sqrt(0.5f);
    const vec2 own[8] = {{1, 0}, {s, s}, {0, 1}, {-s, s}, {-1, 0}, {-s, -s}, {0, -1}, {s, -s}};
    for (std::size_t i = 0; i < 8; ++i) {
        const auto f = list(bumpshadow_factors(3.0f * own[i]));
        const auto b = list(bumpshadow_factors_of_bearing(float(i) / 8.0f));
        for (std::size_t c = 0; c < 8; ++c) {
            CHECK(std::abs(f[c] - (c == i ? 1.0f : 0.0f)) < 5e-7f);
            CHECK(b[c] == (c == i ? 1.0f : 0.0f));
        }
    }
    for (const float zero : {0.0f, -0.0f}) {
        const auto f = list(bumpshadow_factors(vec2(zero, zero)));
        for (std::size_t c = 0; c < 8; ++c) CHECK(std::abs(f[c] - (c == 0 ? 1.0f : 0.0f)) < 5e-7f);
        CHECK(bumpshadow_sine_layers(layer0, layer1, vec2(zero, zero)) == layer0.x);
        CHECK(bumpshadow_sine_first_layer(vec2(zero, zero)) == 0.0f);
        CHECK(bumpshadow_sine_half(layer0, layer1.x, vec2(zero, zero)) == layer0.x);
    }
    // Too short for the square: finite, and no factor outside 0 and 1.
    for (const float tiny : {1e-15f, 1e-20f, 1e-38f, 1e-45f})
        for (int i = 0; i < 64; ++i)
            for (const float v : list(bumpshadow_factors(tiny * direction(i / 64.0)))) CHECK((v >= 0.0f && v <= 1.0f));
}

TEST_CASE("sine layers: two picked horizons are the sum of all") {
    shapes::noise noise(3);
    for (int i = 0; i < 20000; ++i) {
        const auto some = [&] { return float(noise.uniform()); };
        const vec4 a(some(), some(), some(), some()), b(some(), some(), some(), some());
        const vec2 light = direction(i < 64 ? i / 64.0 : noise.uniform(), i % 2 == 0 ? 1.0 : 40.0);
        const double all = double(bumpshadow_sine_layers_factors(a, b, bumpshadow_factors(light)));
        CHECK(std::abs(double(bumpshadow_sine_layers(a, b, light)) - all) < 2e-6);
        const bool swapped = bumpshadow_sine_first_layer(light) == 1.0f;
        const float half = bumpshadow_sine_half(swapped ? b : a, swapped ? a.x : b.x, light);
        CHECK(std::abs(double(half) - all) < 2e-6);
    }
    // Half way between 0 and 45 degrees, and between 270 and 315, as near as the turn is known.
    CHECK(std::abs(bumpshadow_sine_layers(layer0, layer1, direction(0.0625)) - 0.15f) < 0.1f * 0.35f / 45.0f);
    CHECK(std::abs(bumpshadow_sine_layers(layer0, layer1, direction(0.8125)) - 0.75f) < 0.1f * 0.35f / 45.0f);
}

TEST_CASE("sine layers: Lengyel's listing") {
    shapes::noise noise(5);
    for (int i = 0; i < 2000; ++i) {
        const auto some = [&] { return float(noise.uniform()); };
        const vec4 a(some(), some(), some(), some()), b(some(), some(), some(), some());
        const vec4 texel(some(), some(), some(), some());
        // At and above the surface; below it the listing still lights what is within 1 / k, ours nothing.
        const vec3 light(some() * 2 - 1, some() * 2 - 1, some());
        const float horizon = bumpshadow_sine_layers_factors(a, b, bumpshadow_factors_published_cube(texel));
        const float ours = bumpshadow_shadow_soft(bumpshadow_sine(light), horizon, 8.0f, 1.0f);
        CHECK(std::abs(ours - listing(light, texel, a, b)) < 1e-5f);
    }
    const vec4 flat(0.0f);
    CHECK(listing(vec3(1.0f, 0.0f, -0.05f), vec4(1.0f), flat, flat) > 0.5f);
    CHECK(bumpshadow_shadow_soft(bumpshadow_sine(vec3(1.0f, 0.0f, -0.05f)), 0.0f, 8.0f, 1.0f) == 0.0f);
}
