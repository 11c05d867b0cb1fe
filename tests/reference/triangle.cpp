#include <bumpshadow/reference/triangle.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

constexpr interpolant all[] = {interpolant::raw_bearing, interpolant::bearing, interpolant::direction,
                               interpolant::light};
// Corners, middles of edges, and inside.
const glm::vec3 places[] = {{1, 0, 0},       {0, 1, 0},       {0, 0, 1},          {0.5f, 0.5f, 0},
                            {0.5f, 0, 0.5f}, {0, 0.5f, 0.5f}, {0.2f, 0.3f, 0.5f}, {0.6f, 0.1f, 0.3f}};

double apart(double a, double b) { return std::abs(a - b - std::floor(a - b + 0.5)); }

glm::vec3 at_bearing(double turns, double slope) {
    const double a = turns * 2 * std::numbers::pi;
    return glm::vec3(std::cos(a), std::sin(a), slope);
}

// Triangle whose middle has the bearing `turns`, under a point light one unit above the plane and `distance` away, with
// sides of about 2 size. Vectors to the light.
std::array<glm::vec3, 3> under_point_light(double turns, double distance, double size, double turned) {
    std::array<glm::vec3, 3> lights;
    for (int i = 0; i < 3; ++i) {
        const double a = turned + i * 2 * std::numbers::pi / 3;
        lights[std::size_t(i)] = float(distance) * at_bearing(turns, 0) -
                                 glm::vec3(size * std::cos(a), size * std::sin(a), 0) + glm::vec3(0, 0, 1);
    }
    return lights;
}

}  // namespace

TEST_CASE("what is interpolated is right at the vertices") {
    const std::array<glm::vec3, 3> lights = {at_bearing(0.1, 1), at_bearing(0.2, 2), at_bearing(0.9, 0.5)};
    const double bearings[3] = {0.1, 0.2, 0.9}, slopes[3] = {1, 2, 0.5};
    for (const interpolant what : all)
        for (int i = 0; i < 3; ++i) {
            const pixel_light p = interpolate_light(lights, places[i], what, bearing_function::exact, 8.0f);
            CHECK(apart(double(p.bearing), bearings[i]) < 1e-6);
            CHECK(double(p.slope) == doctest::Approx(slopes[i]));
        }
}

TEST_CASE("the seam: 0.1, 0.2, 0.9 is interpolated as 0.1, 0.2, -0.1") {
    const std::array<glm::vec3, 3> lights = {at_bearing(0.1, 1), at_bearing(0.2, 1), at_bearing(0.9, 1)};
    const auto bearing = [&](interpolant what, glm::vec3 weights) {
        return double(interpolate_light(lights, weights, what, bearing_function::exact, 8.0f).bearing);
    };
    // Half way from 0.1 to -0.1, and a point inside.
    CHECK(apart(bearing(interpolant::bearing, {0.5f, 0, 0.5f}), 0.0) < 1e-6);
    CHECK(apart(bearing(interpolant::bearing, {0.2f, 0.3f, 0.5f}), 0.02 + 0.06 - 0.05) < 1e-6);
    CHECK(apart(bearing(interpolant::direction, {0.5f, 0, 0.5f}), 0.0) < 1e-6);
    CHECK(apart(bearing(interpolant::light, {0.5f, 0, 0.5f}), 0.0) < 1e-6);
    // bearing_exact gives 0.9 or -0.1 for the same direction: either way the seam is somewhere, here at 7/8.
    const std::array<glm::vec3, 3> seam = {at_bearing(0.8, 1), at_bearing(0.85, 1), at_bearing(0.95, 1)};
    for (const interpolant what : all) {
        const double found =
            double(interpolate_light(seam, {0.5f, 0, 0.5f}, what, bearing_function::exact, 8.0f).bearing);
        if (what == interpolant::raw_bearing)
            CHECK(apart(found, 0.875) > 0.3);
        else
            CHECK(apart(found, 0.875) < 1e-6);
    }
}

TEST_CASE("with the fix a triangle is as right at the seam as anywhere else") {
    for (const bearing_function function : {bearing_function::exact, bearing_function::cubic})
        for (const interpolant what : {interpolant::bearing, interpolant::direction, interpolant::light}) {
            // The same triangle turned by quarters, under which all functions are alike.
            for (int turned = 0; turned < 7; ++turned)
                for (int step = 0; step < 16; ++step)
                    for (const glm::vec3 weights : places) {
                        const double turns = step / 64.0;
                        const auto here = interpolate_light(under_point_light(turns, 1.5, 0.3, turned), weights, what,
                                                            function, 8.0f);
                        for (int quarter = 1; quarter < 4; ++quarter) {
                            const auto there =
                                interpolate_light(under_point_light(turns + quarter / 4.0, 1.5, 0.3,
                                                                    turned + quarter * std::numbers::pi / 2),
                                                  weights, what, function, 8.0f);
                            CHECK(apart(double(there.bearing - here.bearing), quarter / 4.0) < 1e-5);
                            CHECK(double(there.slope) == doctest::Approx(double(here.slope)).epsilon(1e-5));
                        }
                    }
        }
}

TEST_CASE("the light itself, interpolated, is exact under a point light") {
    for (const double size : {0.1, 1.0, 3.0})
        for (const glm::vec3 weights : places) {
            const auto lights = under_point_light(0.37, 1.0, size, 0.4);
            const glm::vec3 truth = weights.x * lights[0] + weights.y * lights[1] + weights.z * lights[2];
            const pixel_light p = interpolate_light(lights, weights, interpolant::light, bearing_function::exact, 8.0f);
            CHECK(apart(double(p.bearing), std::atan2(double(truth.y), double(truth.x)) / (2 * std::numbers::pi)) <
                  1e-6);
            CHECK(double(p.slope) == doctest::Approx(1 / std::hypot(double(truth.x), double(truth.y))));
        }
}

TEST_CASE("errors of bearing and slope fall with the square of the triangle's size") {
    double worst[2][2];  // [interpolant][size]: turns
    const double sizes[2] = {0.2, 0.1};
    for (int form = 0; form < 2; ++form)
        for (int k = 0; k < 2; ++k) {
            worst[form][k] = 0.0;
            for (int i = 0; i < 24; ++i)
                for (const glm::vec3 weights : places) {
                    const auto lights = under_point_light(i / 24.0, 1.0, sizes[k], 0.3 * i);
                    const glm::vec3 truth = weights.x * lights[0] + weights.y * lights[1] + weights.z * lights[2];
                    const pixel_light p =
                        interpolate_light(lights, weights, form == 0 ? interpolant::bearing : interpolant::direction,
                                          bearing_function::exact, 8.0f);
                    worst[form][k] = std::fmax(
                        worst[form][k], apart(double(p.bearing),
                                              std::atan2(double(truth.y), double(truth.x)) / (2 * std::numbers::pi)));
                }
            CHECK(worst[form][k] < 0.5 * sizes[k] * sizes[k]);
        }
    for (const auto& w : worst) CHECK(w[1] < 0.35 * w[0]);
}

TEST_CASE("a light straight above a vertex, or above the triangle, gives finite numbers, and light near there") {
    const auto above_vertex = under_point_light(0.0, 0.5, 0.5, 0.0);
    CHECK(std::hypot(double(above_vertex[0].x), double(above_vertex[0].y)) < 1e-6);
    const auto above_middle = under_point_light(0.0, 0.0, 0.5, 0.0);
    for (const auto& lights : {above_vertex, above_middle})
        for (const interpolant what : all)
            for (const glm::vec3 weights : places) {
                const pixel_light p = interpolate_light(lights, weights, what, bearing_function::cubic, 8.0f);
                CHECK(std::isfinite(p.bearing));
                CHECK(std::isfinite(p.slope));
                CHECK(p.slope >= 1.0f);
            }
    CHECK(interpolate_light(above_vertex, {1, 0, 0}, interpolant::direction, bearing_function::exact, 8.0f).slope ==
          8.0f);
    // A vertex without a bearing leaves it to the others.
    const auto edge =
        interpolate_light(above_vertex, {0.5f, 0, 0.5f}, interpolant::direction, bearing_function::exact, 8);
    const double truth = std::atan2(double(above_vertex[2].y), double(above_vertex[2].x)) / (2 * std::numbers::pi);
    CHECK(apart(double(edge.bearing), truth) < 1e-5);
}

TEST_CASE("factors over a triangle across the seam") {
    // Slices of 30 degrees towards bearing 0, and 80 to the other side: only the seam's own side is lit at 45.
    tangent_volume e;
    e.slices = {4, 0.0, bearing_function::exact};
    std::vector<std::byte> bytes = {std::byte{37}, std::byte{255}, std::byte{255}, std::byte{255}};
    const const_texture t{bytes, layout_of(e, {1, 1})};
    const std::array<glm::vec3, 3> lights = {at_bearing(0.01, 1.2), at_bearing(0.02, 1.2), at_bearing(0.98, 1.2)};
    for (const interpolant what : all) {
        const pixel_light p = interpolate_light(lights, {0.3f, 0.2f, 0.5f}, what, e.slices.function, 8.0f);
        CHECK(shadow_factor(e, t, {}, {0.5f, 0.5f}, p, {}) == 1.0f);
    }
    const std::array<glm::vec3, 3> wide = {at_bearing(0.83, 1.2), at_bearing(0.86, 1.2), at_bearing(1.15, 1.2)};
    const auto factor = [&](interpolant what) {
        return shadow_factor(e, t, {}, {0.5f, 0.5f},
                             interpolate_light(wide, {0.5f, 0, 0.5f}, what, e.slices.function, 8.0f), {});
    };
    CHECK(factor(interpolant::raw_bearing) == 0.0f);  // goes round the other way
    CHECK(factor(interpolant::bearing) == 1.0f);
    CHECK(factor(interpolant::direction) == 1.0f);
    CHECK(factor(interpolant::light) == 1.0f);
}
