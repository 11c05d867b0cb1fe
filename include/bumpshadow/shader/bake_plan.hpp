#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/shader/bake_tables.hpp>
#include <bumpshadow/status.hpp>

// What the compute kernel that bakes horizons (bumpshadow_bake.glsl, bumpshadow_bake.hlsl) needs from the CPU: once for
// a map's size and directions, not for its heights.

namespace bumpshadow {

static_assert(sizeof(glm::ivec4) == 16, "tables are uploaded as they are");

// Texels along an axis, at the most.
inline constexpr int most_bake_texels = 16384;

// The sizes are in elements, not bytes.
struct bake_plan {
    std::span<glm::ivec4> tables;         // caller's memory, to be uploaded
    std::span<bake_dispatch> dispatches;  // caller's memory, to be carried out in this order
    std::size_t table_count = 0;          // that `tables` needs
    std::size_t dispatch_count = 0;       // that `dispatches` needs
    std::size_t scratch_floats = 0;       // of a buffer that only the kernel uses
    std::size_t slope_count = 0;          // floats of the output
};

// Plans the kernel for all height fields of one size. To be called twice: without memory, which gives the sizes, and
// then with it.
//   heights: samples is not read and may be null, all else as for bake_cascade. The kernel takes samples of float, rows
//       row_stride apart; multiplies them by height_scale and subtracts the datum. What is below -1e20 is a hole, which
//       no_data, of any value, has to announce
//   relief: the most by which heights differ, in the unit of texel_size. Maps that repeat are looked at so far that
//       what is left out makes slopes of less than 1/1024; infinite, where it is not known, looks four maps far
//   options: steps and radius. Region, curvature and distances are not supported
// The output is tight, [direction][y][x]. Where memory is scarce make a plan for some of the directions at a time.
// Errors: those of check_bake; extents above most_bake_texels; tables and dispatches too small; scratch of the options;
// out_of_range where there are more than 2^31 floats of heights, scratch or slopes.
[[nodiscard]] inline status plan_bake(const height_map<float>& heights, std::span<const glm::dvec2> directions,
                                      bake_plan& plan, const bake_options& options = {},
                                      double relief = std::numeric_limits<double>::infinity()) {
    using namespace cascade_detail;
    plan.table_count = plan.dispatch_count = plan.scratch_floats = plan.slope_count = 0;
    height_map<float> checked = heights;
    constexpr float nothing = 0.0f;
    checked.samples = &nothing;
    if (status s = check_request(checked, directions, options); !s) return s;
    for (const int texels : {heights.extent.x, heights.extent.y})
        if (texels > most_bake_texels)
            return {error::out_of_range, "heights.extent", double(texels), double(most_bake_texels)};
    if (!options.region.empty()) return {error::not_supported, "region", double(options.region.extent.x)};
    if (options.curvature != glm::dvec2(0.0)) return {error::not_supported, "curvature", options.curvature.x};
    if (!options.distances.values.empty())
        return {error::not_supported, "distances", double(options.distances.values.size())};
    if (!(relief >= 0.0)) return {error::out_of_range, "relief", relief, 0.0};
    const std::size_t slopes = required_size(heights.extent, int(directions.size()));
    constexpr double most = double((std::numeric_limits<std::int32_t>::max)());
    if (const double floats = double(heights.row_stride) * heights.extent.y; floats > most)
        return {error::out_of_range, "heights.row_stride", floats, most};
    if (double(slopes) > most) return {error::out_of_range, "slopes", double(slopes), most};

    const frames both = shape_frames(heights, options.steps);
    scratch_layout layout;
    slot s;
    const auto count = std::size_t(most_looks(options.steps));
    layout.add<crossing>(count).add<crossing>(count).add<look<2>>(count).add<look<4>>(count).add<far_row>(most_rows);
    scratch_block block;
    if (status e = block.allocate(options, layout.bytes(), "a plan's scratch"); !e) return e;
    s.around.corners = block.carve<crossing>(count);
    s.around.crossings = block.carve<crossing>(count);
    s.around.columns = block.carve<look<2>>(count);
    s.around.insides = block.carve<look<4>>(count);
    s.beyond = block.carve<far_row>(most_rows);

    const horizon_map none;
    const float highest = float((std::min)(relief / both[0].unit, 1e30));
    const job j{both, {.lowest = 0.0f, .highest = highest}, options, none, {}};
    const bool holes = heights.no_data.has_value() || heights.edge == edge_mode::open;
    bake_planner planner(j, plan.tables, plan.dispatches);
    if (!planner(heights, directions, holes, s)) return {error::out_of_range, "the kernel's scratch", most, most};
    plan.table_count = planner.table_count();
    plan.dispatch_count = planner.dispatch_count();
    plan.scratch_floats = planner.scratch_floats();
    plan.slope_count = slopes;
    if (plan.tables.empty() && plan.dispatches.empty()) return {};
    if (plan.tables.size() < plan.table_count)
        return {error::too_small, "plan.tables", double(plan.tables.size()), double(plan.table_count)};
    if (plan.dispatches.size() < plan.dispatch_count)
        return {error::too_small, "plan.dispatches", double(plan.dispatches.size()), double(plan.dispatch_count)};
    return {};
}

}  // namespace bumpshadow
