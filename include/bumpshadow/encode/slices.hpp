#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slice_bands.hpp>
#include <bumpshadow/encode/slice_fit.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Horizons in many directions to the few slices that a texture stores, from which a shader interpolates.

namespace bumpshadow {

// Slope that a stored value stands for, at most max_slope and finite.
[[nodiscard]] inline float slope_of_stored(const horizon_scale& scale, float value) {
    if (value >= 1.0f) return (std::min)(scale.max_slope, (std::numeric_limits<float>::max)());
    return slope_of_quantity(scale.stored, value / stored_scale(scale));
}

// Checks horizons that are read.
[[nodiscard]] inline status check_horizons(const horizon_map& slopes) {
    if (slopes.extent.x <= 0) return {error::not_positive, "horizon map extent.x", double(slopes.extent.x)};
    if (slopes.extent.y <= 0) return {error::not_positive, "horizon map extent.y", double(slopes.extent.y)};
    if (slopes.bearings <= 0) return {error::not_positive, "horizon map bearings", double(slopes.bearings)};
    if (slopes.row_step() < std::size_t(slopes.extent.x))
        return {error::too_small, "horizon map row_stride", double(slopes.row_step()), double(slopes.extent.x)};
    if (slopes.values.size() < slopes.required_size())
        return {error::too_small, "horizon map size", double(slopes.values.size()), double(slopes.required_size())};
    return {};
}

// The same, and that there is one direction a bearing.
[[nodiscard]] inline status check_horizons(const horizon_map& slopes, std::span<const glm::dvec2> directions) {
    if (status s = check_horizons(slopes); !s) return s;
    if (directions.size() != std::size_t(slopes.bearings))
        return {error::mismatch, "directions", double(directions.size()), double(slopes.bearings)};
    for (const glm::dvec2& d : directions) {
        if (!is_finite(d.x) || !is_finite(d.y)) return {error::not_finite, "direction", is_finite(d.x) ? d.y : d.x};
        if (d.x == 0.0 && d.y == 0.0) return {error::not_positive, "length of a direction", 0.0};
    }
    return {};
}

// Extent of level 0 of the texture that levels (one or more) are packed into: a single one may be a band of its rows.
[[nodiscard]] inline glm::ivec2 packed_extent(std::span<const horizon_map> levels, const texture_layout& out) {
    return {levels[0].extent.x, levels.size() == 1 ? out.extent.y : levels[0].extent.y};
}

// Checks that a map and its mips, as many as the layout has, are of the layout's extents; or that a single one is a
// band of the rows of level 0, from first_row on.
[[nodiscard]] inline status check_levels(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                         const texture_layout& layout, int first_row = 0) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (status s = check_horizons(levels[i], directions); !s) return s;
        const glm::ivec2 extent = layout.level_extent(int(i)), given = levels[i].extent;
        if (given.x != extent.x) return {error::mismatch, "extent.x of a level", double(given.x), double(extent.x)};
        if (levels.size() > 1 ? given.y != extent.y : given.y > extent.y)
            return {error::mismatch, "extent.y of a level", double(given.y), double(extent.y)};
    }
    const int rows = levels[0].extent.y, most = levels.size() > 1 ? 0 : layout.extent.y - rows;
    if (first_row < 0 || first_row > most)
        return {error::out_of_range, "options.first_row", double(first_row), double(most)};
    if (layout.format != texel_format::bc4) return {};
    if (first_row % 4 != 0) return {error::not_a_multiple, "options.first_row", double(first_row), 4.0};
    if (first_row < most && rows % 4 != 0) return {error::not_a_multiple, "rows of a band", double(rows), 4.0};
    return {};
}

// Checks that a texture has this layout, and bytes enough for it.
[[nodiscard]] inline status check_layout(const const_texture& t, const texture_layout& wanted) {
    const auto different = [](const char* what, auto is, auto has_to_be) {
        return status(error::mismatch, what, double(is), double(has_to_be));
    };
    const texture_layout& l = t.layout;
    if (l.format != wanted.format) return different("texture format", l.format, wanted.format);
    if (l.kind != wanted.kind) return different("texture kind", l.kind, wanted.kind);
    if (l.extent.x != wanted.extent.x) return different("texture extent.x", l.extent.x, wanted.extent.x);
    if (l.extent.y != wanted.extent.y) return different("texture extent.y", l.extent.y, wanted.extent.y);
    if (l.depth != wanted.depth) return different("texture depth", l.depth, wanted.depth);
    if (l.layers != wanted.layers) return different("texture layers", l.layers, wanted.layers);
    if (l.mips != wanted.mips) return different("texture mips", l.mips, wanted.mips);
    return check(t);
}

// Bytes of scratch that a pack of slices takes, at the most, on an executor of that concurrency: O(width * slices) and
// 600 a direction for each thread.
[[nodiscard]] inline std::size_t slice_scratch_size(glm::ivec2 extent, std::size_t directions, int slices,
                                                    int concurrency = 1) {
    const auto items = std::size_t(part_count(extent.y, slice_detail::rows_of_item));
    return slice_detail::scratch_bytes(extent.x, directions, slices, 4, slot_pool::slots(concurrency, items));
}

namespace slice_detail {

// pack(slopes, level, options) for each level, with a report of all. slices, rows: those of level 0.
template <class Pack>
[[nodiscard]] status for_levels(std::span<const horizon_map> levels, const slice_set& slices, int rows, int concurrency,
                                const pack_options& options, const Pack& pack) {
    pack_report sum, one;
    pack_options each = options;
    each.report = &one;
    scratch_block block;
    const request largest{levels[0].extent, std::size_t(levels[0].bearings), slices, rows};
    if (status s = take_scratch(largest, concurrency, block, each); !s) return s;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        if (status s = pack(levels[level], int(level), each); !s) return s;
        sum.clamped += one.clamped;
        sum.steepest = (std::max)(sum.steepest, one.steepest);
    }
    if (options.report != nullptr) *options.report = sum;
    return {};
}

}  // namespace slice_detail

// Turns horizons, as slopes in `directions` (any, of any length; evenly spaced ones judge all bearings alike), into
// slices of stored values, and hands them over in bands: sink(const slice_rows&), for different bands at the same time.
//   rows: of a band, 1, 2 or 4; the last one may have fewer
// Slopes are brought to the stored quantity and clamped to [0, 1], fitted or picked, and what was fitted clamped again.
// Holes and NaN count as 0.
// Errors: sizes; point: mismatch where a slice's own direction is missing (1e-6); the fits: too_small for fewer
// directions than slices, out_of_range where they leave a slice undetermined; scratch. Then no sink is called.
template <executor Executor, class Sink>
[[nodiscard]] status for_slice_bands(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                     const slice_set& slices, const horizon_scale& scale, const pack_options& options,
                                     int rows, Executor&& execute, const Sink& sink) {
    if (status s = check(slices); !s) return s;
    if (status s = check(scale); !s) return s;
    if (status s = check_horizons(slopes, directions); !s) return s;
    if (rows != 1 && rows != 2 && rows != 4) return {error::out_of_range, "rows of a band", double(rows), 4.0};
    const std::size_t count = std::size_t(slices.count);
    if (options.fit != slice_fit::point && directions.size() < count)
        return {error::too_small, "directions", double(directions.size()), double(count)};

    const auto make_plan = [&](slice_detail::plan& p, std::span<glm::dvec2> own, double* work) {
        if (options.fit == slice_fit::point) return slice_detail::plan_point(p, directions, own);
        p.reweighted = options.fit == slice_fit::least_angle;
        p.stored = scale.stored;
        p.unit = 1.0f / stored_scale(scale);
        return slice_detail::plan_fit(
            p, directions.size(), [&](std::size_t i) { return to_bearing(slices.function, directions[i]); }, work);
    };
    const auto source = [&](int bearing, int x, int y, int texels, float* to, slice_detail::lanes_seen& seen) {
        // Rows come from far apart, in no order that the machine would foresee.
        const int soon = bearing + slice_detail::fetch_distance;
        if (soon < slopes.bearings)
            slice_detail::fetch(slopes.row(soon, y) + x, texels);
        else if (x + 2 * texels <= slopes.extent.x)
            slice_detail::fetch(slopes.row(soon % slopes.bearings, y) + x + texels, texels);
        slice_detail::convert(scale, slopes.row(bearing, y) + x, texels, to, seen);
    };
    return slice_detail::run({slopes.extent, directions.size(), slices, rows}, options, make_plan, source, execute,
                             sink);
}

// The same row by row and slice by slice: sink(slice, y, const float* values).
template <executor Executor, class Sink>
[[nodiscard]] status for_slice_rows(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                    const slice_set& slices, const horizon_scale& scale, const pack_options& options,
                                    Executor&& execute, const Sink& sink) {
    return for_slice_bands(slopes, directions, slices, scale, options, 1, execute, [&](const slice_rows& band) {
        for (int i = 0; i < slices.count; ++i) sink(i, band.y, band.row(i, 0));
    });
}

// The slices as a horizon map of their own, for mips (encode/reduce.hpp) or for looking at what a texture will hold.
//   out: slopes of the stored values, so within [0, max_slope]; extent as `slopes`, bearings as slices.count
// Packed again with fit::point in the directions of the slices, they give the same texture.
template <executor Executor = serial>
[[nodiscard]] status fit_slices(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                const slice_set& slices, const horizon_scale& scale, const pack_options& options,
                                const horizon_map& out, Executor&& execute = {}) {
    if (status s = check(slices); !s) return s;
    if (status s = check(scale); !s) return s;
    if (status s = check_horizons(slopes, directions); !s) return s;
    if (status s = check_output(out, slopes.extent, std::size_t(slices.count)); !s) return s;
    return for_slice_rows(slopes, directions, slices, scale, options, execute,
                          [&](int slice, int y, const float* values) {
                              float* const to = out.row(slice, y);
                              for (int x = 0; x < slopes.extent.x; ++x) to[x] = slope_of_stored(scale, values[x]);
                          });
}

// Steepest horizon of a map; 0 where none is above 0.
[[nodiscard]] inline float steepest_slope(const horizon_map& slopes) {
    using namespace simd;
    pack most = splat(0.0f);
    float rest = 0.0f;
    for (int bearing = 0; bearing < slopes.bearings; ++bearing)
        for (int y = 0; y < slopes.extent.y; ++y) {
            const float* const row = slopes.row(bearing, y);
            int x = 0;
            for (; x + width <= slopes.extent.x; x += width) {
                const pack here = load(row + x);
                most = select_greater(here, most, here, most);  // never a NaN
            }
            for (; x < slopes.extent.x; ++x) rest = row[x] > rest ? row[x] : rest;
        }
    float lanes[width];
    store(lanes, most);
    return (std::max)(rest, *std::max_element(lanes, lanes + width));
}

// max_slope for a map: its steepest horizon, but at most `most`, since light above that is hardly ever shadowed and the
// rest gains precision. A map without horizons to speak of gets `most`.
//   most: smallest_max_slope to largest_max_slope; beyond counts as the nearer of the two, NaN as the larger
// Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, section 4.1.
[[nodiscard]] inline float suggest_max_slope(const horizon_map& slopes, float most = 4.0f) {
    const float limit = most < largest_max_slope ? (std::max)(most, smallest_max_slope) : largest_max_slope;
    const float steepest = steepest_slope(slopes);
    return steepest >= smallest_max_slope && steepest < limit ? steepest : limit;
}

}  // namespace bumpshadow
