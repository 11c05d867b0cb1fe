#include <bumpshadow/plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "plan/maps.hpp"

using namespace bumpshadow;
using namespace plans;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Whether a recipe has a slice for the bearing, or one on both sides of it.
bool is_inside(const recipe& r, double bearing) {
    const slice_set& slices = r.encoding.slices;
    const double way = to_bearing(slices.function, shapes::direction(bearing)) - slices.phase;
    return way - std::floor(way + 1e-9) <= slices.arc + 1e-9;
}

}  // namespace

// ---- What is left out ----

TEST_CASE("a flat map: no shadows") {
    const auto flat = shapes::sampled<float>({64, 64}, shapes::plane(3.0));
    const recipe r = planned(flat.view(), with_arc({0.0, 1.0, 0.0, 90.0}));
    CHECK(!r.shadows);
    CHECK(r.obstacle == plan_obstacle::none);
}

// Ramps of 1/2, 26.6 degrees.
TEST_CASE("light above the steepest rise: no shadows") {
    const auto roofs = shapes::sampled<float>(
        {64, 64}, [](double x, double) { return 0.5 * std::min(std::fmod(x, 32.0), 32.0 - std::fmod(x, 32.0)); });
    CHECK(!planned(roofs.view(), with_arc({0.0, 1.0, 27.0, 90.0})).shadows);
    CHECK(planned(roofs.view(), with_arc({0.0, 1.0, 10.0, 90.0})).shadows);
    // Along the ridges nothing is in the way, however low the light.
    const lights along = {light_at(0.25, 3.0), light_at(0.75, 8.0)};
    CHECK(!planned(roofs.view(), with_lights(along)).shadows);
    // The same in other units: 1/2 is 3 over 6.
    auto wide = roofs.view();
    wide.height_scale = 6.0;
    wide.texel_size = {6.0, 1.0};
    CHECK(!planned(wide, with_arc({0.0, 1.0, 27.0, 90.0})).shadows);
    wide.texel_size.x = 3.0;
    CHECK(planned(wide, with_arc({0.0, 1.0, 27.0, 90.0})).shadows);
}

// A wall of height 1 in 64 texels shadows 1/64 of the map at 45 degrees: less than the 3 % that may be wrong.
TEST_CASE("fewer shadows than may be wrong: none, unless elevations are asked for") {
    const auto wall = shapes::sampled<float>({64, 64}, [](double x, double) { return x == 20.0 ? 1.0 : 0.0; });
    const lights one = {light_at(0.0, 40.0)};
    scene s = with_lights(one);
    s.mismatch = 0.1;
    CHECK(!planned(wall.view(), s).shadows);
    s.degrees = 0.01;
    CHECK(planned(wall.view(), s).shadows);
    s.degrees = infinity;
    s.mismatch = 0.0;
    CHECK(planned(wall.view(), s).shadows);
}

TEST_CASE("one fixed light: one slice, a flat texture, no bearing") {
    const auto map = heap();
    for (const double bearing : {0.0, 0.39, 0.875}) {
        const lights one = {7.0 * light_at(bearing, 30.0)};
        const recipe r = planned(map.view(), with_lights(one));
        CHECK(r.shadows);
        CHECK(r.obstacle == plan_obstacle::none);
        CHECK(r.encoding.kind == texture_kind::flat);
        CHECK(r.encoding.slices.count == 1);
        CHECK(r.encoding.slices.arc == 0.0);
        CHECK(r.directions == 1);
        CHECK(r.predicted.fetches == 1);
        std::array<glm::dvec2, 1> baked;
        fill_directions(r, baked);
        CHECK(baked[0].x == doctest::Approx(shapes::direction(bearing).x));
        CHECK(baked[0].y == doctest::Approx(shapes::direction(bearing).y));
        // No horizon that is higher than the light need be told from another.
        CHECK(double(r.encoding.scale.max_slope) <= 1.06 * std::tan(30.0 * degree));
    }
    // A light straight up has no bearing, and no shadow.
    const lights two = {light_at(0.39, 30.0), {0.0, 0.0, 2.0}};
    scene s = with_lights(two);
    s.mismatch = 0.005;
    CHECK(planned(map.view(), s).encoding.kind == texture_kind::flat);
    CHECK(!planned(map.view(), with_lights({two[1]})).shadows);
}

TEST_CASE("several fixed lights: slices over the arc that holds them") {
    const auto map = heap();
    struct group {
        std::vector<double> bearings;
        double first, last;
    };
    for (const group& g : {group{{0.1, 0.3, 0.2}, 0.1, 0.3}, {{0.05, 0.9, 0.97}, 0.9, 1.05}, {{0.0, 0.5}, 0.0, 0.5}}) {
        lights some;
        for (const double b : g.bearings) some.push_back(light_at(b, 25.0));
        const recipe r = planned(map.view(), with_lights(some));
        CHECK(r.obstacle == plan_obstacle::none);
        CHECK(is_arc(r.encoding.slices));
        CHECK(std::abs(r.encoding.slices.arc - (g.last - g.first)) < 2.0 * octant_max_error / 360.0);
        for (const double b : g.bearings) CHECK(is_inside(r, b));
        // A light straight up adds no bearing.
        some.push_back({0.0, 0.0, 1.0});
        const recipe again = planned(map.view(), with_lights(some));
        CHECK(std::abs(again.encoding.slices.arc - (g.last - g.first)) < 2.0 * octant_max_error / 360.0);
        for (const double b : g.bearings) CHECK(is_inside(again, b));
    }
    // All around there is no end to save.
    lights around;
    for (int i = 0; i < 12; ++i) around.push_back(light_at(i / 12.0, 25.0));
    CHECK(!is_arc(planned(map.view(), with_lights(around)).encoding.slices));
    // Lights that differ by less than a shader sees are one.
    const lights close = {light_at(0.3, 25.0), light_at(0.300002, 25.0)};
    CHECK(planned(map.view(), with_lights(close)).encoding.slices.arc == 0.0);
    // A few degrees are one slice where the map does not tell them apart.
    const lights near = {light_at(0.30, 25.0), light_at(0.301, 25.0)};
    scene s = with_lights(near);
    s.mismatch = 0.03;
    CHECK(planned(map.view(), s).encoding.kind == texture_kind::flat);
}

TEST_CASE("an arc: slices from end to end and no wrap") {
    const auto map = heap();
    const recipe all = planned(map.view(), with_arc({0.0, 1.0, 10.0, 60.0}, 0.03));
    CHECK(!is_arc(all.encoding.slices));
    CHECK(all.encoding.slices.count > 1);
    struct path {
        double first, last;
    };
    for (const path& p : {path{0.25, 0.75}, {0.9, 1.1}, {-0.1, 0.1}, {2.0, 2.25}}) {
        const recipe r = planned(map.view(), with_arc({p.first, p.last, 10.0, 60.0}, 0.03));
        CHECK(r.obstacle == plan_obstacle::none);
        CHECK(is_arc(r.encoding.slices));
        CHECK(std::abs(r.encoding.slices.arc - (p.last - p.first)) < 2.0 * octant_max_error / 360.0);
        for (int i = 0; i <= 20; ++i) CHECK(is_inside(r, p.first + (p.last - p.first) * i / 20.0));
        CHECK(!is_inside(r, p.last + 0.01));
        CHECK(!is_inside(r, p.first - 0.01));
        CHECK(r.predicted.bytes < all.predicted.bytes);
        CHECK(r.directions < all.directions);
    }
}

TEST_CASE("a smooth map: fewer texels") {
    const recipe r = planned(hills(128).view(), with_arc({0.0, 1.0, 5.0, 90.0}, 0.03));
    CHECK(r.obstacle == plan_obstacle::none);
    CHECK(r.reduced_heights * r.reduction > 1);
    CHECK(r.predicted.bytes < 8.0);
    CHECK(reduced_extent({128, 128}, r.reduced_heights) == baked_extent(r, {128, 128}));
}

TEST_CASE("low occluders: a radius") {
    const auto map = studs();
    const double elevation = 20.0, reach = 2.0 / std::tan(elevation * degree);
    const lights one = {light_at(0.1, elevation)};
    const recipe r = planned(map.view(), with_lights(one));
    CHECK(r.obstacle == plan_obstacle::none);
    CHECK(r.radius <= 1.25 * reach);
    CHECK(r.radius > 1.0);
    // In the map's unit.
    auto metres = map.view();
    metres.texel_size = {10.0, 10.0};
    metres.height_scale = 10.0;
    CHECK(planned(metres, with_lights(one)).radius == doctest::Approx(10.0 * r.radius));
}

TEST_CASE("tiles that are never in shadow") {
    // Studs in the lower half alone.
    auto map = studs(256);
    std::fill_n(map.samples.begin(), 256 * 128, 0.0f);
    const recipe half = planned(map.view(), with_arc({0.0, 1.0, 20.0, 60.0}, 0.005));
    CHECK(half.free_tiles > 0.25);
    CHECK(half.free_tiles < 0.75);
    CHECK(planned(studs().view(), with_arc({0.0, 1.0, 20.0, 60.0}, 0.005)).free_tiles == 0.0);
}

// ---- What a platform and a view ask for ----

TEST_CASE("textures that the platform has") {
    const auto map = heap();
    scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.03);
    CHECK(planned(map.view(), s).encoding.kind == texture_kind::volume);
    CHECK(planned(map.view(), s).predicted.fetches == 1);
    s.bc4 = false;
    CHECK(planned(map.view(), s).encoding.format == texel_format::r8);
    s.volumes = false;
    recipe r = planned(map.view(), s);
    CHECK(r.encoding.kind == texture_kind::array);
    CHECK(r.predicted.fetches == 2);
    CHECK(r.obstacle == plan_obstacle::none);
    // One texture for all bearings alike is all that is left, and not enough.
    s.arrays = false;
    for (const double last : {0.5, 1.0}) {
        s.arc.last_bearing = last;
        r = planned(map.view(), s);
        CHECK(r.obstacle == plan_obstacle::textures);
        CHECK(r.encoding.kind == texture_kind::flat);
        CHECK(r.encoding.slices.count == 1);
        CHECK(r.predicted.mismatch > s.mismatch);
        CHECK(check(r.encoding));
    }
    const lights one = {light_at(0.1, 30.0)};
    s.lights = one;
    r = planned(map.view(), s);
    CHECK(r.obstacle == plan_obstacle::none);
    CHECK(r.encoding.kind == texture_kind::flat);
}

TEST_CASE("the edge is the light's") {
    const auto map = heap();
    scene s = with_arc({0.0, 0.5, 10.0, 40.0}, 0.03);
    CHECK(std::isinf(planned(map.view(), s).edge.k));
    s.light_radius = 2.0;
    const recipe r = planned(map.view(), s);
    const shadow_edge wanted = edge_for(2.0, r.encoding.scale, 25.0);
    CHECK(double(r.edge.k) == doctest::Approx(double(wanted.k)).epsilon(1e-4));
    CHECK(r.edge.c == 0.5f);
}

TEST_CASE("a distant view: no more texels than its places tell apart") {
    const auto map = heap();
    scene s = with_arc({0.0, 1.0, 5.0, 90.0}, 0.05);
    for (const double pixel : {2.0, 4.0, 8.0, 100.0}) {
        s.texels_per_pixel = pixel;
        const recipe r = planned(map.view(), s);
        const int covered = int(std::min(pixel, 8.0));
        CHECK(4 * r.reduced_heights * r.reduction >= covered);
        CHECK(r.taps <= covered);
        CHECK(r.edge.c == 0.5f);
        CHECK(!std::isinf(r.edge.k));
    }
}

TEST_CASE("what else is missing") {
    scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.05);
    s.has_normals = false;
    s.has_lightmaps = true;
    const recipe r = planned(studs(32).view(), s);
    CHECK(r.wants_normals);
    CHECK(r.wants_masks);
    const recipe none = planned(shapes::sampled<float>({8, 8}, shapes::plane(0.0)).view(), s);
    CHECK(!none.shadows);
    CHECK(none.wants_normals);
}

// ---- What stands in the way ----

TEST_CASE("budgets that are too small are named, and kept") {
    const auto map = heap();
    const scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.02);
    const recipe free = planned(map.view(), s);
    REQUIRE(free.obstacle == plan_obstacle::none);
    double last = free.predicted.mismatch;
    for (const double share : {0.7, 0.1}) {
        scene poor = s;
        poor.bytes = share * free.predicted.bytes;
        const recipe less = planned(map.view(), poor);
        CHECK(less.obstacle == plan_obstacle::bytes);
        CHECK(less.predicted.bytes <= poor.bytes);
        // The less there is to spend, the worse.
        CHECK(less.predicted.mismatch > s.mismatch * 0.95);
        CHECK(less.predicted.mismatch >= last);
        last = less.predicted.mismatch;
    }
    scene poor = s;
    poor.bake_seconds = 1e-9;
    CHECK(planned(map.view(), poor).obstacle == plan_obstacle::bake_seconds);
    // The bearing by octants costs 26, an array 18 more; one slice for all bearings 20, and nothing below that.
    poor = s;
    poor.gpu_cost = 27.0;
    recipe r = planned(map.view(), poor);
    CHECK(r.obstacle == plan_obstacle::none);
    CHECK(r.encoding.slices.function == bearing_function::octant);
    poor.gpu_cost = 25.0;
    r = planned(map.view(), poor);
    CHECK(r.obstacle == plan_obstacle::gpu_cost);
    CHECK(r.encoding.kind == texture_kind::flat);
    CHECK(r.predicted.gpu_cost <= 25.0);
    poor.gpu_cost = 5.0;
    CHECK(planned(map.view(), poor).obstacle == plan_obstacle::gpu_cost);
    poor.gpu_cost = 43.0;
    poor.volumes = false;
    CHECK(planned(map.view(), poor).obstacle == plan_obstacle::gpu_cost);
    // What is enough is no obstacle.
    poor = s;
    poor.bytes = free.predicted.bytes;
    poor.gpu_cost = free.predicted.gpu_cost;
    poor.bake_seconds = 100.0;
    CHECK(planned(map.view(), poor).obstacle == plan_obstacle::none);
}

TEST_CASE("within a budget, the most is made of it") {
    // A byte or two for a map that takes many: fewer texels, or fewer slices, whichever is better. Eight slices of BC4
    // at half the extent are one byte; four of 8 bits at full extent are four.
    const auto map = heap();
    scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.0);
    s.bytes = 4.0;
    const recipe r = planned(map.view(), s);
    CHECK(r.obstacle != plan_obstacle::none);
    CHECK(r.predicted.bytes <= 4.0);
    s.bytes = infinity;
    const recipe best = planned(map.view(), s);
    CHECK(best.obstacle == plan_obstacle::mismatch);
    CHECK(best.predicted.mismatch < r.predicted.mismatch);
    CHECK(best.predicted.bytes > 4.0);
}

TEST_CASE("an error that cannot be had") {
    const auto map = heap(64);
    CHECK(planned(map.view(), with_arc({0.0, 1.0, 5.0, 60.0}, 0.0)).obstacle == plan_obstacle::mismatch);
    scene s = with_arc({0.0, 1.0, 5.0, 60.0}, 1.0);
    s.degrees = 1e-3;
    CHECK(planned(map.view(), s).obstacle == plan_obstacle::degrees);
    s.degrees = 4.0;
    const recipe r = planned(map.view(), s);
    CHECK(r.obstacle == plan_obstacle::none);
    CHECK(r.predicted.degrees <= 4.0);
}
