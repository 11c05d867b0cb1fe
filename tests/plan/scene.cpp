#include <bumpshadow/plan/scene.hpp>

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/plan.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// By check() and by plan(), which leaves the recipe as it was.
void refused(const scene& s, error code, std::string_view argument) {
    const status found = check(s);
    CHECK_MESSAGE(found.code() == code, argument);
    CHECK(std::string_view(found.argument()) == argument);

    const auto hill = shapes::sampled<float>({16, 16}, shapes::cone({8, 8}, 6.0, 1.0));
    recipe r;
    r.directions = -7;
    CHECK(plan(hill.view(), s, r).code() == code);
    CHECK(r.directions == -7);
    CHECK(r.lines == 0);
}

scene with_arc(const light_arc& arc) {
    scene s;
    s.arc = arc;
    return s;
}

}  // namespace

TEST_CASE("scenes that make sense") {
    CHECK(check(scene{}));
    CHECK(check(with_arc({0.9, 1.1, 0.0, 0.0})));
    CHECK(check(with_arc({-3.0, -2.0, 90.0, 90.0})));
    const std::vector<glm::dvec3> lights = {{0.0, 0.0, 1.0}, {1e-3, 0.0, 0.0}, {-5.0, 2.0, 3.0}};
    scene s;
    s.lights = lights;
    CHECK(check(s));
    s = {};
    s.positions = std::span(lights).last(1);
    CHECK(check(s));
    s = {};
    s.mismatch = 0.0;
    s.light_radius = 45.0;
    CHECK(check(s));
}

TEST_CASE("arcs that hold no light, or more than all bearings") {
    refused(with_arc({0.5, 0.5, 5.0, 60.0}), error::out_of_range, "scene.arc.last_bearing (an empty arc)");
    refused(with_arc({0.5, 0.25, 5.0, 60.0}), error::out_of_range, "scene.arc.last_bearing (an empty arc)");
    refused(with_arc({0.5, 1.6, 5.0, 60.0}), error::out_of_range, "scene.arc.last_bearing (more than a turn)");
    refused(with_arc({0.0, 1.0, 5.0, 90.5}), error::out_of_range, "scene.arc.highest");
    refused(with_arc({0.0, 1.0, -0.5, 60.0}), error::out_of_range, "scene.arc.lowest");
    refused(with_arc({0.0, 1.0, 60.0, 59.0}), error::out_of_range, "scene.arc.highest (below the lowest)");
    for (const double bad : {not_a_number, infinity, -infinity}) {
        refused(with_arc({bad, 1.0, 5.0, 60.0}), error::not_finite, "scene.arc.first_bearing");
        refused(with_arc({0.0, bad, 5.0, 60.0}), error::not_finite, "scene.arc.last_bearing");
    }
    refused(with_arc({0.0, 1.0, not_a_number, 60.0}), error::out_of_range, "scene.arc.lowest");
    refused(with_arc({0.0, 1.0, 5.0, not_a_number}), error::out_of_range, "scene.arc.highest");
}

TEST_CASE("lights that shine from nowhere") {
    const auto with = [](const std::vector<glm::dvec3>& lights) {
        scene s;
        s.lights = lights;
        return s;
    };
    const std::vector<glm::dvec3> below = {{1.0, 0.0, 1.0}, {1.0, 0.0, -1e-9}}, zero = {glm::dvec3(0.0)};
    refused(with(below), error::out_of_range, "scene.lights z (below the surface)");
    refused(with(zero), error::not_positive, "length of one of scene.lights");
    for (const double bad : {not_a_number, infinity})
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<glm::dvec3> lights = {{1.0, 0.0, 1.0}};
            lights[0][axis] = bad;
            refused(with(lights), error::not_finite, "scene.lights");
            scene s;
            s.positions = lights;
            refused(s, error::not_finite, "scene.positions");
        }
    // The square of the length is more than a double holds, but all components are finite.
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<glm::dvec3> lights = {{1.0, 0.0, 1.0}};
        lights[0][axis] = 1.7e308;
        refused(with(lights), error::out_of_range, "scene.lights");
        CHECK(check(with(lights)).value() == 1.7e308);
        scene s;
        s.positions = lights;
        refused(s, error::out_of_range, "scene.positions");
        lights[0] = {1.0, 1.0, 1.0};
        CHECK(bool(check(with(lights = {lights[0] * largest_light}))));
    }
    for (const double height : {0.0, -2.0}) {
        const std::vector<glm::dvec3> places = {{4.0, 4.0, height}};
        scene s;
        s.positions = places;
        refused(s, error::not_positive, "scene.positions z");
    }
}

TEST_CASE("errors and budgets that no recipe can have") {
    const auto each = [](double scene::*number, const std::vector<double>& wrong, error code, const char* argument) {
        for (const double value : wrong) {
            scene s;
            s.*number = value;
            refused(s, code, argument);
        }
    };
    each(&scene::light_radius, {-0.1, 45.1, not_a_number, infinity}, error::out_of_range, "scene.light_radius");
    each(&scene::mismatch, {-0.01, not_a_number}, error::out_of_range, "scene.mismatch");
    each(&scene::degrees, {0.0, -1.0, not_a_number}, error::not_positive, "scene.degrees");
    each(&scene::bytes, {0.0, -1.0, not_a_number}, error::not_positive, "scene.bytes");
    each(&scene::bake_seconds, {0.0, -1.0, not_a_number}, error::not_positive, "scene.bake_seconds");
    each(&scene::gpu_cost, {0.0, -1.0, not_a_number}, error::not_positive, "scene.gpu_cost");
    each(&scene::texels_per_pixel, {0.0, 0.99, -4.0, not_a_number, infinity}, error::out_of_range,
         "scene.texels_per_pixel");
}

TEST_CASE("heights that cannot be planned for") {
    auto map = shapes::sampled<float>({8, 6}, shapes::plane(2.0));
    recipe r;
    r.directions = -7;
    const auto refused_map = [&](const height_map<float>& heights, error code, std::string_view argument) {
        const status s = plan(heights, scene{}, r);
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        CHECK(r.directions == -7);
    };
    refused_map({}, error::missing, "heights.samples");
    auto holes = map.view();
    holes.no_data = 2.0f;
    refused_map(holes, error::missing, "heights (nothing but no_data)");
    auto squashed = map.view();
    squashed.texel_size.y = 0.0;
    refused_map(squashed, error::not_positive, "texel_size.y");
    squashed.texel_size.y = 1e300;
    refused_map(squashed, error::out_of_range, "texel_size.y");
    map.at(5, 3) = 1e36f;
    refused_map(map.view(), error::out_of_range, "highest height above reference_texel(), in texels");
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        map.at(5, 3) = bad;
        refused_map(map.view(), error::not_finite, "height");
        CHECK(plan(map.view(), scene{}, r).texel() == glm::ivec2(5, 3));
    }
    // A hole is none of these.
    map.at(5, 3) = std::numeric_limits<float>::quiet_NaN();
    holes = map.view();
    holes.no_data = map.at(5, 3);
    CHECK(plan(holes, scene{}, r));
    CHECK(!r.shadows);
}
