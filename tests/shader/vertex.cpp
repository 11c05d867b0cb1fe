#include <bumpshadow/shader/shader.hpp>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include <doctest/doctest.h>

using namespace bumpshadow::shader;

namespace {

vec3 light_at(double turns, double elevation) {
    const double a = turns * 2.0 * std::numbers::pi, e = elevation * std::numbers::pi / 180.0;
    return vec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
}

// Distance of two bearings, in turns.
double apart(double a, double b) {
    const double d = a - b - std::floor(a - b + 0.5);
    return std::abs(d);
}

}  // namespace

TEST_CASE("into tangent space by three dots") {
    // Tangent along world z, bitangent along world x, normal along world y.
    const vec3 v = bumpshadow_to_tangent_space(vec3(1, 2, 3), vec3(0, 0, 1), vec3(1, 0, 0), vec3(0, 1, 0));
    CHECK(v == vec3(3, 1, 2));
    const vec3 same = bumpshadow_to_tangent_space(vec3(0.3f, -0.2f, 5), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1));
    CHECK(same == vec3(0.3f, -0.2f, 5));
}

TEST_CASE("bearing and slope at a vertex") {
    const vec2 v = bumpshadow_vertex_bearing_cubic(vec3(0, 2, 3), 8.0f);
    CHECK(v.x == 0.25f);
    CHECK(v.y == doctest::Approx(1.5));
    CHECK(bumpshadow_vertex_bearing_octant(vec3(-3, -3, 0), 8.0f).x == doctest::Approx(0.625));
    for (int i = 0; i < 40; ++i)
        CHECK(apart(double(bumpshadow_vertex_bearing_exact(light_at(i / 40.0, 30), 8.0f).x), i / 40.0) < 1e-6);
    // On an axis and on a diagonal all bearing functions agree.
    for (int i = 0; i < 8; ++i) {
        const vec3 light = light_at(i / 8.0, 60);
        for (const vec2 b :
             {bumpshadow_vertex_bearing_exact(light, 8.0f), bumpshadow_vertex_bearing_quintic(light, 8.0f),
              bumpshadow_vertex_bearing_cubic(light, 8.0f), bumpshadow_vertex_bearing_octant(light, 8.0f),
              bumpshadow_vertex_bearing_diamond(light, 8.0f)}) {
            CHECK(apart(double(b.x), i / 8.0) < 1e-4);
            CHECK(double(b.y) == doctest::Approx(std::sqrt(3.0)));
        }
    }
    // The octant function puts 22.5 degrees at sin(22.5) / 8 sin(45) of a turn, the diamond one at 1 / 4 (1 +
    // cot 22.5).
    CHECK(double(bumpshadow_vertex_bearing_octant(light_at(1 / 16.0, 0), 8.0f).x) == doctest::Approx(0.06764951));
    CHECK(double(bumpshadow_vertex_bearing_diamond(light_at(1 / 16.0, 0), 8.0f).x) == doctest::Approx(0.07322330));
    CHECK(bumpshadow_vertex_slope(light_at(0.1, 45), 8.0f) == doctest::Approx(1.0));
    CHECK(bumpshadow_vertex_slope(light_at(0.1, -45), 8.0f) == doctest::Approx(-1.0));
    CHECK(bumpshadow_vertex_slope(light_at(0.1, 89), 8.0f) == 8.0f);
    CHECK(bumpshadow_vertex_slope(vec3(0, 0, 1), 8.0f) == 8.0f);
    CHECK(bumpshadow_vertex_slope(vec3(0, 0, -1), 8.0f) == -8.0f);
    for (const vec3 light : {vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1), vec3(1e-20f, 0, 1)}) {
        const vec2 b = bumpshadow_vertex_bearing_exact(light, 8.0f);
        const vec3 d = bumpshadow_vertex_direction(light, 8.0f);
        CHECK(std::isfinite(b.x));
        CHECK(std::isfinite(b.y));
        CHECK(std::isfinite(d.x));
        CHECK(std::isfinite(d.y));
        CHECK(std::isfinite(d.z));
        const vec3 s = bumpshadow_vertex_direction_sine(light);
        CHECK(s == vec3(d.x, d.y, light.z));
    }
    const vec3 sines = bumpshadow_vertex_direction_sine(7.0f * light_at(0.3, 30));
    CHECK(double(sines.x) == doctest::Approx(std::cos(0.6 * std::numbers::pi)));
    CHECK(double(sines.y) == doctest::Approx(std::sin(0.6 * std::numbers::pi)));
    CHECK(double(sines.z) == doctest::Approx(0.5));
    CHECK(bumpshadow_vertex_direction(vec3(0, 0, 1), 8.0f) == vec3(0, 0, 8));
    const vec3 d = bumpshadow_vertex_direction(vec3(3, -4, 10), 8.0f);
    CHECK(d.x == doctest::Approx(0.6));
    CHECK(d.y == doctest::Approx(-0.8));
    CHECK(d.z == doctest::Approx(2));
}

TEST_CASE("the wrap mode's own example") {
    const vec3 b = bumpshadow_unwrap_bearings(vec3(0.1f, 0.2f, 0.9f));
    CHECK(b.x == 0.1f);
    CHECK(b.y == 0.2f);
    CHECK(b.z == doctest::Approx(-0.1));
    const vec3 c = bumpshadow_unwrap_bearings(vec3(0.9f, 0.2f, 0.8f));
    CHECK(c.x == 0.9f);
    CHECK(c.y == doctest::Approx(1.2));
    CHECK(c.z == 0.8f);
    // Already within half a turn: nothing moves.
    const vec3 same = bumpshadow_unwrap_bearings(vec3(0.4f, 0.5f, 0.3f));
    CHECK(same == vec3(0.4f, 0.5f, 0.3f));
    // Outside [0, 1) as well, as the bearing functions return down to -1/8.
    CHECK(bumpshadow_unwrap_bearings(vec3(-0.1f, 0.85f, 7.0f)).y == doctest::Approx(-0.15));
    CHECK(bumpshadow_unwrap_bearings(vec3(-0.1f, 0.85f, 7.0f)).z == doctest::Approx(0.0));
}

TEST_CASE("unwrapped bearings are the same bearings, next to each other") {
    for (int i = 0; i < 64; ++i)
        for (const double spread : {0.01, 0.1, 0.2}) {
            const double first = i / 64.0, others[2] = {first + spread, first - spread};
            const vec3 wrapped(first, others[0] - std::floor(others[0]), others[1] - std::floor(others[1]));
            const vec3 b = bumpshadow_unwrap_bearings(wrapped);
            CHECK(double(b.y - b.x) == doctest::Approx(spread).epsilon(1e-4));
            CHECK(double(b.z - b.x) == doctest::Approx(-spread).epsilon(1e-4));
            CHECK_FALSE(bumpshadow_bearings_go_round(b));
        }
    // Nearly half a turn, either way.
    for (int i = 0; i < 64; ++i)
        for (const double spread : {0.49, -0.49}) {
            const double first = i / 64.0, other = first + spread;
            const vec3 b = bumpshadow_unwrap_bearings(vec3(first, other - std::floor(other), first));
            CHECK(double(b.y - b.x) == doctest::Approx(spread).epsilon(1e-4));
            const vec3 c = bumpshadow_unwrap_bearings(vec3(first, first, other - std::floor(other)));
            CHECK(double(c.z - c.x) == doctest::Approx(spread).epsilon(1e-4));
        }
    // A light above the triangle: a vertex every third of a turn.
    CHECK(bumpshadow_bearings_go_round(bumpshadow_unwrap_bearings(vec3(0.05f, 0.383f, 0.717f))));
    CHECK(bumpshadow_bearings_go_round(bumpshadow_unwrap_bearings(vec3(0.7f, 0.05f, 0.36f))));
}

TEST_CASE("a bearing interpolated twice needs no neighbors") {
    // Along an edge from one bearing to another, in steps of a pixel: whichever of the pair changes less is right.
    for (int i = 0; i < 48; ++i)
        for (const double step : {0.005, -0.02, 0.2, -0.45}) {
            const double from = i / 48.0 + 0.001, to = from + step;
            const vec2 a = bumpshadow_bearing_pair(float(from)),
                       b = bumpshadow_bearing_pair(float(to - std::floor(to)));
            CHECK(a.x >= 0.0f);
            CHECK(a.x < 1.0f);
            CHECK(a.y >= -0.5f);
            CHECK(a.y < 0.5f);
            const vec2 change(std::abs(b.x - a.x), std::abs(b.y - a.y));
            for (const float t : {0.0f, 0.25f, 0.5f, 1.0f}) {
                const float picked = bumpshadow_pick_bearing(mix(a, b, t), change);
                CHECK(apart(double(picked), from + double(t) * step) < 1e-5);
            }
        }
}
