#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/plan/range.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/search.hpp>
#include <bumpshadow/plan/trial.hpp>
#include <bumpshadow/plan/workshop.hpp>
#include <bumpshadow/status.hpp>

// What a recipe that was found can do without, and the reasons for what is left. Part of plan.hpp.
namespace bumpshadow::plan_detail {

// The same slices by another function.
[[nodiscard]] inline slice_set slices_by(bearing_function function, const light_range& range, slice_set s) {
    s.function = function;
    if (range.arc == 1.0) return s;
    const auto bearing = [&](double turns) { return to_bearing(function, exact_direction(turns - std::floor(turns))); };
    s.phase = bearing(range.first);
    const double way = bearing(range.first + range.arc) - s.phase;
    s.arc = range.arc > 0.0 ? way - std::floor(way) : 0.0;
    return s;
}

// Bakes what a recipe says for real.
template <height_sample Sample>
[[nodiscard]] status bake_and_judge(workshop<Sample>& w, const candidate& c, recipe& r) {
    std::array<glm::dvec2, most_directions> storage;
    const std::span<glm::dvec2> directions = std::span(storage).first(std::size_t(r.directions));
    fill_directions(r, directions);
    variant baked = w.other(variant_of(w, c), r.directions);
    double seconds = 0.0;
    if (status s = w.bake({&baked, 1}, directions, {.radius = r.radius}, seconds); !s) return s;
    if (status s = judge_with(w, c, baked.slopes, directions, r); !s) return s;
    r.predicted.bake_seconds = seconds;
    return {};
}

// One line for each choice.
template <height_sample Sample>
void explain(const workshop<Sample>& w, recipe& r) {
    const plan_figures& p = r.predicted;
    const slice_set& slices = r.encoding.slices;
    r.say(w.sample.pixel == 1 ? "error: %.2f +- %.2f %% of all answers are wrong, %.2f %% are allowed"
                              : "error: %.2f +- %.2f %% on average of what a pixel gets of light, %.2f %% are allowed",
          100.0 * p.mismatch, 100.0 * p.interval, 100.0 * w.wanted.mismatch);
    if (r.obstacle != plan_obstacle::none) r.say("not met: %s stands in the way", name_of(r.obstacle));
    if (slices.arc == 0.0)
        r.say("one slice: light comes from one bearing, which the shader need not look at");
    else if (slices.count == 1)
        r.say("one slice for all bearings over %.3g degrees: they are not told apart", 360.0 * slices.arc);
    else if (is_arc(slices))
        r.say("%d slices over an arc of %.0f degrees: no light comes from elsewhere", slices.count, 360.0 * slices.arc);
    else
        r.say("%d slices around the turn", slices.count);
    if (r.fit == slice_fit::point)
        r.say("%d directions baked, those of the slices: a fit to more is not needed", r.directions);
    else
        r.say("%d directions baked and fitted: with fewer, more is wrong", r.directions);
    if (r.reduced_heights > 1)
        r.say("heights averaged over %d x %d texels before the bake", r.reduced_heights, r.reduced_heights);
    if (r.reduction > 1) r.say("horizons averaged over %d x %d texels", r.reduction, r.reduction);
    if (r.encoding.format == texel_format::bc4) r.say("BC4, %.4g bytes a texel: 8 bits take twice that", p.bytes);
    r.say("%.3g stands for 1: the steepest horizon is %.3g%s", double(r.encoding.scale.max_slope), double(w.steepest),
          w.range.highest_slope < 4.0 ? ", and light comes from no higher" : "");
    if (r.taps > 1)
        r.say("%d x %d places of each pixel, their factors averaged: fewer tell too little of its texels", r.taps,
              r.taps);
    if (w.reach > 0.0 && is_infinite(r.radius))
        r.say("no radius: what shadows is up to %.4g away", w.reach);
    else if (w.reach > 0.0)
        r.say("radius %.4g: what shadows is up to %.4g away", r.radius, w.reach);
    if (r.encoding.kind != texture_kind::flat)
        r.say(slices.function == bearing_function::octant ? "octant bearing, %.0f cycles: no better one is needed"
                                                          : "cubic bearing, %.0f cycles",
              p.gpu_cost);
    if (!is_infinite(r.edge.k) && w.sample.pixel == 1)
        r.say("edge of k = %.3g for a light of radius %.3g degrees, which is on average %.0f degrees high",
              double(r.edge.k), w.wanted.light_radius, middle_elevation(w.range));
    else if (!is_infinite(r.edge.k))
        r.say("edge of k = %.3g, centered: as wide as horizons differ within a pixel", double(r.edge.k));
    else
        r.say("hard edge: the light is a point");
    r.free_tiles = w.free_tiles;
    if (w.free_tiles >= 0.05)
        r.say("%.0f %% of tiles of 32 x 32 texels are never in shadow: skip them (tile_horizons)",
              100.0 * w.free_tiles);
}

// Judges a recipe that was found by all of the sample, and adds slices where they are too few.
template <height_sample Sample>
[[nodiscard]] status settle(const workshop<Sample>& w, recipe& r) {
    candidate c = candidate_of(r);
    const variant& v = variant_of(w, c);
    if (status s = judge_with(w, c, v.slopes, w.directions, r); !s) return s;
    if (is_good(w.wanted, r) && over_budget(w.wanted, r) == plan_obstacle::none) r.obstacle = plan_obstacle::none;
    if (r.obstacle != plan_obstacle::none) return {};
    recipe finer = r;
    for (const int more : ladder_of(w)) {
        if (is_good(w.wanted, r)) return {};
        if (more <= c.intervals) continue;
        c.intervals = more;
        shape(w, c, finer);
        if (status s = judge_with(w, c, v.slopes, w.directions, finer); !s) return s;
        if (over_budget(w.wanted, finer) == plan_obstacle::none) r = finer;
        if (!is_good(w.wanted, finer)) continue;
        r.obstacle = over_budget(w.wanted, finer);
        return {};
    }
    if (!is_good(w.wanted, r)) r.obstacle = shortcoming(w, r);
    return {};
}

// Leaves out of a recipe what it does not need, and says why.
template <height_sample Sample>
[[nodiscard]] status refine(workshop<Sample>& w, recipe& r) {
    const candidate c = candidate_of(r);
    const variant& v = variant_of(w, c);
    const auto as_good = [&](const recipe& other) {
        return is_good(w.wanted, r) ? is_good(w.wanted, other)
                                    : other.predicted.mismatch <= 1.02 * r.predicted.mismatch;
    };

    // Fewer directions, the slices' own alone first.
    r.predicted.bake_seconds = seconds_of(w, c, r.directions);
    const int intervals = (std::max)(c.intervals, 1);
    finding affordable;
    for (int step = w.divisions; step > 1; --step) {
        if (w.divisions % step != 0 || w.divisions / step < intervals) continue;
        horizon_map some = v.slopes;
        some.slice_stride = v.slopes.slice_step() * std::size_t(step);
        some.bearings = (int(w.directions.size()) - 1) / step + 1;
        std::array<glm::dvec2, most_directions> own;
        for (int i = 0; i < some.bearings; ++i) own[std::size_t(i)] = w.directions[std::size_t(i * step)];
        recipe fewer = r;
        fewer.fit = w.divisions / step == intervals && c.intervals > 0 ? slice_fit::point : slice_fit::least_squares;
        fewer.directions = some.bearings;
        fewer.predicted.bake_seconds = seconds_of(w, c, some.bearings);
        if (status s = judge_with(w, c, some, std::span(own).first(std::size_t(some.bearings)), fewer); !s) return s;
        if (over_budget(w.wanted, fewer) == plan_obstacle::none)
            affordable.add(fewer, fewer.predicted.mismatch < affordable.best.predicted.mismatch);
        if (!as_good(fewer)) continue;
        r = fewer;
        break;
    }
    if (r.obstacle == plan_obstacle::none) {
        r.obstacle = over_budget(w.wanted, r);
        if (r.obstacle != plan_obstacle::none && affordable.known) {
            affordable.best.obstacle = r.obstacle;
            r = affordable.best;
        }
    }

    // What takes a bake of its own to know: a radius, and the cheapest bearing.
    const double side =
        (std::min)(w.heights.extent.x * w.heights.texel_size.x, w.heights.extent.y * w.heights.texel_size.y);
    if (r.directions <= 8 * r.reduced_heights * r.reduced_heights) {
        recipe lean = r;
        if (w.reach > 0.0 && w.reach < 0.25 * side) lean.radius = 1.25 * w.reach;
        if (lean.encoding.kind != texture_kind::flat)
            lean.encoding.slices = slices_by(bearing_function::octant, w.range, r.encoding.slices);
        if (status s = bake_and_judge(w, c, lean); !s) return s;
        if (!as_good(lean) && lean.radius < r.radius) {
            lean.encoding.slices = r.encoding.slices;
            if (status s = bake_and_judge(w, c, lean); !s) return s;
        }
        if (as_good(lean)) r = lean;
    }
    if (w.sample.pixel == 1) r.edge = edge_for(w.wanted.light_radius, r.encoding.scale, middle_elevation(w.range));
    explain(w, r);
    return {};
}

}  // namespace bumpshadow::plan_detail
