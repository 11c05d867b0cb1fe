// The compute kernel that bakes horizons, run as C++ against the cascade.

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/shader/bake_plan.hpp>

#include "support/bake_kernel.hpp"
#include "support/shapes.hpp"

using namespace bumpshadow;
using namespace bake_kernel;

namespace {

constexpr const char* names[] = {"repeat", "clamp", "mirror", "open"};

agreement check_as_cpp(const trial& t) {
    owned_plan how;
    plan(t, how);
    return bake_kernel::check(t, run_as_cpp(t, how));
}

std::string title(glm::ivec2 extent, int edge, int steps) {
    return std::to_string(extent.x) + " x " + std::to_string(extent.y) + " " + names[edge] + ", " +
           std::to_string(steps) + " steps";
}

}  // namespace

TEST_CASE("the kernel's slopes are those of the cascade") {
    const glm::ivec2 extents[] = {{64, 64}, {100, 67}, {41, 130}, {96, 20}, {24, 24}, {9, 5}, {1, 40}, {1, 1}};
    for (int edge = 0; edge < 4; ++edge) {
        agreement all;
        for (const glm::ivec2 extent : extents)
            for (const int steps : {3, 12, 48}) {
                const std::string name = title(extent, edge, steps);
                const auto directions = shapes::directions(8, 0.013);
                all.include(check_as_cpp({name + ", stones", stones(extent, 7), edge_mode(edge), directions, steps}));
                all.include(check_as_cpp({name + ", bricks", bricks(extent, 9), edge_mode(edge), directions, steps}));
                all.include(check_as_cpp({name + ", towers", towers(extent, 8), edge_mode(edge), directions, steps}));
            }
        print(all, names[edge]);
    }
}

TEST_CASE("along the axes and diagonals") {
    for (int edge = 0; edge < 4; ++edge)
        for (const int steps : {12, 48})
            (void)check_as_cpp(
                {title({70, 64}, edge, steps), towers({70, 64}, 3), edge_mode(edge), shapes::directions(8), steps});
}

TEST_CASE("texel sizes, scales, radii, holes and rows that lie apart") {
    for (int edge = 0; edge < 4; ++edge)
        for (const trial& t : unusual(edge_mode(edge))) {
            CAPTURE(names[edge]);
            (void)check_as_cpp(t);
        }
}

// What the towers are for: without the higher levels most slopes would be others.
TEST_CASE("a level left out is noticed") {
    const trial t("towers", towers({128, 128}, 2), edge_mode::repeat, shapes::directions(4, 0.1));
    owned_plan how;
    plan(t, how);
    const std::vector<float> expected = run_cascade(t);
    int levels = 0;
    for (bumpshadow::bake_dispatch& d : how.dispatches) {
        if (d.constants[0] != 3) continue;
        const glm::ivec3 groups = d.groups;
        d.groups = glm::ivec3(0);
        CHECK(compare(run_as_cpp(t, how), expected).apart > 0.05);
        d.groups = groups;
        ++levels;
    }
    CHECK(levels >= 3);
}

TEST_CASE("the kernel's constants are the cascade's") {
    kernel k{};
    CHECK(k.bumpshadow_bake_hole() == cascade_detail::hole);
    CHECK(k.bumpshadow_bake_is_hole(cascade_detail::hole_limit * 1.01f));
    CHECK_FALSE(k.bumpshadow_bake_is_hole(cascade_detail::hole_limit * 0.99f));
    CHECK(k.bumpshadow_bake_no_horizon() == no_horizon);
    CHECK(k.bumpshadow_bake_inverse_of_zero() == cascade_detail::inverse_of_zero);
    CHECK(k.bumpshadow_bake_edge_clamp() == int(edge_mode::clamp));
    CHECK(k.bumpshadow_bake_edge_mirror() == int(edge_mode::mirror));
    CHECK(k.bumpshadow_bake_edge_open() == int(edge_mode::open));
    for (int i = -9; i < 12; ++i)
        for (const int edge : {0, 1, 2, 3})
            CHECK(k.bumpshadow_bake_resolve(i, 3, edge) == resolve_edge(i, 3, edge_mode(edge)));
}

TEST_CASE("plans that cannot be made say why") {
    height_map<float> map{.samples = nullptr, .extent = {64, 64}, .row_stride = 64};
    const std::vector<glm::dvec2> directions = shapes::directions(4);
    bake_plan plan;
    REQUIRE(bool(plan_bake(map, directions, plan)));
    CHECK(plan.slope_count == 4 * 64 * 64);

    std::vector<glm::ivec4> tables(plan.table_count);
    std::vector<bake_dispatch> dispatches(plan.dispatch_count);
    bake_plan small{.tables = std::span(tables).first(tables.size() - 1), .dispatches = dispatches};
    CHECK(plan_bake(map, directions, small).code() == error::too_small);
    small = {.tables = tables, .dispatches = std::span(dispatches).first(dispatches.size() - 1)};
    CHECK(plan_bake(map, directions, small).code() == error::too_small);
    small = {.tables = tables, .dispatches = dispatches};
    CHECK(bool(plan_bake(map, directions, small)));

    CHECK(plan_bake(map, {}, plan).code() == error::not_positive);
    CHECK(plan_bake(map, directions, plan, {.steps = 0}).code() == error::not_positive);
    CHECK(plan_bake(map, directions, plan, {.curvature = {0.1, 0.0}}).code() == error::not_supported);
    CHECK(plan_bake(map, directions, plan, {.region = {{0, 0}, {8, 8}}}).code() == error::not_supported);
    CHECK(plan_bake(map, directions, plan, {}, -1.0).code() == error::out_of_range);
    CHECK(plan_bake(map, directions, plan, {}, std::numeric_limits<double>::quiet_NaN()).code() == error::out_of_range);
    std::byte few[64];
    CHECK(plan_bake(map, directions, plan, {.scratch = few}).code() == error::too_small);
    map.extent = {most_bake_texels + 1, 1};
    map.row_stride = map.extent.x;
    CHECK(plan_bake(map, directions, plan).code() == error::out_of_range);
    map.extent = glm::ivec2(most_bake_texels);
    map.row_stride = map.extent.x;
    CHECK(plan_bake(map, shapes::directions(16), plan).code() == error::out_of_range);
}
