#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/plan/looks.hpp>
#include <bumpshadow/plan/range.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/scene.hpp>
#include <bumpshadow/plan/trial.hpp>
#include <bumpshadow/plan/workshop.hpp>
#include <bumpshadow/status.hpp>

// The search for the cheapest recipe. Part of plan.hpp.
namespace bumpshadow::plan_detail {

// A candidate: how much smaller, in what way, at how many places of a pixel, and in how many intervals between slices.
// No interval: a single slice for all bearings alike, a flat texture.
struct candidate {
    int reduced_heights = 1, reduction = 1;
    texel_format format = texel_format::r8;
    int taps = 1;
    int intervals = 8;

    [[nodiscard]] int shrunk() const { return reduced_heights * reduction; }
};

// Intervals between slices.
template <height_sample Sample>
[[nodiscard]] std::span<const int> ladder_of(const workshop<Sample>& w) {
    static constexpr int of_32[] = {0, 4, 6, 8, 12, 16, 24, 32}, of_24[] = {0, 1, 2, 3, 4, 6, 8, 12, 24},
                         of_12[] = {0, 1, 2, 3, 4, 6, 12}, none[] = {0};
    if (w.divisions == 1 || !(w.wanted.volumes || w.wanted.arrays)) return none;
    if (w.range.arc == 1.0) return std::span<const int>(of_32).first(w.divisions == 32 ? 8 : 7);
    return w.divisions == 24 ? std::span<const int>(of_24) : std::span<const int>(of_12);
}

// An arc has a slice at both ends.
[[nodiscard]] inline int slices_of(int intervals, bool arc) { return intervals == 0 ? 1 : intervals + (arc ? 1 : 0); }
[[nodiscard]] inline candidate candidate_of(const recipe& r) {
    const int count = r.encoding.slices.count;
    return {r.reduced_heights, r.reduction, r.encoding.format, r.taps,
            count == 1 ? 0 : count - (is_arc(r.encoding.slices) ? 1 : 0)};
}

template <height_sample Sample>
[[nodiscard]] const variant& variant_of(const workshop<Sample>& w, const candidate& c) {
    return *std::find_if(w.variants.begin(), w.variants.begin() + w.variant_count, [&](const variant& v) {
        return v.reduced_heights == c.reduced_heights && v.reduction == c.reduction;
    });
}

// Of the bake, on one thread.
template <height_sample Sample>
[[nodiscard]] double seconds_of(const workshop<Sample>& w, const candidate& c, int directions) {
    const glm::ivec2 baked = reduced_extent(w.heights.extent, c.reduced_heights);
    return variant_of(w, c).seconds_per_sample * double(baked.x) * baked.y * directions;
}

// Fills in what a candidate is and what it costs, but for the time to pack it.
template <height_sample Sample>
void shape(const workshop<Sample>& w, const candidate& c, recipe& r) {
    r.reduced_heights = c.reduced_heights;
    r.reduction = c.reduction;
    r.taps = c.taps;
    r.encoding.format = c.format;
    r.encoding.slices = w.slices;
    const int count = slices_of(c.intervals, is_arc(w.slices));
    r.encoding.slices.count = count;
    r.encoding.kind = count == 1 ? texture_kind::flat : w.wanted.volumes ? texture_kind::volume : texture_kind::array;
    r.directions = int(w.directions.size());
    r.fit = r.directions == 1 ? slice_fit::point : slice_fit::least_squares;

    plan_figures& p = r.predicted;
    p.bytes = double(count) * (c.format == texel_format::bc4 ? 0.5 : 1.0) / (double(c.shrunk()) * c.shrunk());
    // At the least: what is baked beyond the slices' own directions is known later.
    p.bake_seconds = seconds_of(w, c, count);
    p.gpu_cost = gpu_cost_of(r.encoding, r.taps);
    p.fetches = fetches(r.encoding) * r.taps * r.taps;
}

// Looks at a packed part of the sample, `count` patches, by a shaped recipe, and fills in what it gets wrong.
template <height_sample Sample>
[[nodiscard]] status judge_with(const workshop<Sample>& w, const candidate& c, int count, horizon_map slopes,
                                std::span<const glm::dvec2> directions, recipe& r) {
    slopes.row_stride = slopes.row_step();
    slopes.slice_stride = slopes.slice_step();
    slopes.extent = w.sample.packed(c.shrunk(), count);
    verdict v;
    if (status s = try_recipe(slopes, directions, r, c.shrunk(), w.view, w.sample, w.looks.first(w.view.looks(count)),
                              w.texels, w.values, w.horizons, w.memory, v);
        !s)
        return s;
    const glm::ivec2 stored = reduced_extent(baked_extent(r, w.heights.extent), r.reduction);
    r.edge = v.edge;
    r.predicted.mismatch = v.mismatch;
    r.predicted.interval = v.interval;
    r.predicted.degrees = v.degrees;
    r.predicted.pack_seconds =
        v.pack_seconds * double(stored.x) * stored.y / (double(slopes.extent.x) * slopes.extent.y);
    return {};
}
template <height_sample Sample>
[[nodiscard]] status judge_with(const workshop<Sample>& w, const candidate& c, const horizon_map& slopes,
                                std::span<const glm::dvec2> directions, recipe& r) {
    return judge_with(w, c, w.sample.count, slopes, directions, r);
}

// A part of the sample is enough to choose by, and a small one where it is far from what is bearable.
template <height_sample Sample>
[[nodiscard]] status attempt(const workshop<Sample>& w, const candidate& c, recipe& r) {
    shape(w, c, r);
    for (const int share : {16, 4}) {
        const int count = (std::max)(w.sample.count / share, (std::min)(w.sample.count, 1024 / (share * share)));
        if (status s = judge_with(w, c, count, variant_of(w, c).slopes, w.directions, r); !s) return s;
        if (r.predicted.mismatch - 1.5 * r.predicted.interval > w.wanted.mismatch) break;
        if (r.predicted.mismatch + 1.5 * r.predicted.interval < 0.9 * w.wanted.mismatch) break;
    }
    return {};
}

// A little less than is bearable, since it is a sample.
[[nodiscard]] inline bool is_good(const scene& wanted, const recipe& r, double reserve = 1.0) {
    return r.predicted.mismatch <= reserve * 0.95 * wanted.mismatch &&
           r.predicted.degrees <= reserve * 0.95 * wanted.degrees;
}
// How far it is from what is bearable, as a factor of that.
[[nodiscard]] inline double excess(const scene& wanted, const recipe& r) {
    return (std::max)(r.predicted.mismatch / (std::max)(wanted.mismatch, 1e-5),
                      r.predicted.degrees / (std::max)(wanted.degrees, 1e-5));
}
[[nodiscard]] inline plan_obstacle over_budget(const scene& wanted, const recipe& r) {
    if (r.predicted.bytes > wanted.bytes) return plan_obstacle::bytes;
    if (r.predicted.bake_seconds + r.predicted.pack_seconds > wanted.bake_seconds) return plan_obstacle::bake_seconds;
    return r.predicted.gpu_cost > wanted.gpu_cost ? plan_obstacle::gpu_cost : plan_obstacle::none;
}
// What else stands in the way of a recipe that is not good.
template <height_sample Sample>
[[nodiscard]] plan_obstacle shortcoming(const workshop<Sample>& w, const recipe& r) {
    if (w.divisions > 1 && !w.wanted.volumes && !w.wanted.arrays) return plan_obstacle::textures;
    recipe exact = r;
    exact.predicted.degrees = 0.0;
    return excess(w.wanted, exact) == excess(w.wanted, r) ? plan_obstacle::mismatch : plan_obstacle::degrees;
}
// Bytes first, then the work: by what is counted and not by time, which is another every time.
struct price {
    double bytes, work, gpu_cost;
};
[[nodiscard]] inline price price_of(const recipe& r) {
    // Of the map's texels in one direction: packing a slice takes about a third of baking it, in BC4 as much.
    const double slices = double(r.encoding.slices.count), baked = double(r.reduced_heights) * r.reduced_heights;
    const double packing = r.encoding.format == texel_format::bc4 ? 1.0 : 0.3;
    return {r.predicted.bytes, slices / baked * (1.0 + packing / (double(r.reduction) * r.reduction)),
            r.predicted.gpu_cost};
}
[[nodiscard]] inline bool is_cheaper(const recipe& a, const recipe& b) {
    const price p = price_of(a), q = price_of(b);
    if (p.bytes != q.bytes) return p.bytes < q.bytes;
    return p.work != q.work ? p.work < q.work : p.gpu_cost < q.gpu_cost;
}

// The best of its kind so far.
struct finding {
    recipe best;
    bool known = false;

    void add(const recipe& r, bool is_better) {
        if (!known || is_better) best = r, known = true;
    }
};

// Tries every size, format and number of places with as few slices as do.
//   reserve: share of the bearable error that may be used up
template <height_sample Sample>
[[nodiscard]] status search(const workshop<Sample>& w, double reserve, recipe& best) {
    const scene& wanted = w.wanted;
    best.encoding.slices = w.slices;
    best.encoding.scale = w.scale;

    const recipe start = best;
    finding good[2], nearest[2];  // beyond the budgets, within them
    const auto look_at = [&](const candidate& c, recipe& r) {
        r = start;
        if (status s = attempt(w, c, r); !s) return s;
        const bool within = over_budget(wanted, r) == plan_obstacle::none;
        nearest[within].add(r, excess(wanted, r) < excess(wanted, nearest[within].best));
        if (is_good(wanted, r, reserve)) good[within].add(r, is_cheaper(r, good[within].best));
        return status{};
    };
    const std::span<const int> ladder = ladder_of(w);
    const auto for_each_size = [&](const auto& look) {
        for (const int factor : {8, 4, 2, 1})
            for (const variant& v : std::span(w.variants).first(std::size_t(w.variant_count)))
                for (const int taps : {1, 2, 4})
                    for (const texel_format format : {texel_format::r8, texel_format::bc4}) {
                        const candidate c{v.reduced_heights, v.reduction, format, taps, 0};
                        if (c.shrunk() != factor || taps > w.sample.pixel || taps * factor > 2 * w.sample.pixel)
                            continue;
                        if (format == texel_format::bc4 && !wanted.bc4) continue;
                        bool fails = false;
                        if (status s = look(c, fails); !s) return s;
                        // BC4 gets more wrong.
                        if (fails) break;
                    }
        return status{};
    };
    // More slices are never worse but by noise. Most of these end with the first look, at the most slices that would be
    // cheaper than what is known.
    const auto find_fewest = [&](candidate c, bool& fails) {
        const auto would_be_cheaper = [&](int intervals) {
            recipe r = start;
            c.intervals = intervals;
            shape(w, c, r);
            return !good[1].known || is_cheaper(r, good[1].best);
        };
        std::size_t low = 0, high = ladder.size();
        while (high > 0 && !would_be_cheaper(ladder[high - 1])) --high;
        const bool all = high == ladder.size();
        for (std::size_t next = high - 1; low < high; next = (low + high) / 2) {
            c.intervals = ladder[next];
            recipe r;
            if (status s = look_at(c, r); !s) return s;
            const bool is_enough = is_good(wanted, r, reserve);
            fails = fails || (all && next + 1 == ladder.size() && !is_enough);
            (is_enough ? high : low) = is_enough ? next : next + 1;
        }
        return status{};
    };
    if (status s = for_each_size(find_fewest); !s) return s;
    if (good[1].known) {
        best = good[1].best;
        return {};
    }
    // The most slices that the budgets allow.
    const auto find_most = [&](candidate c, bool&) {
        for (std::size_t i = ladder.size(); i-- > 0;) {
            c.intervals = ladder[i];
            recipe r = start;
            shape(w, c, r);
            if (over_budget(wanted, r) == plan_obstacle::none) return look_at(c, r);
        }
        return status{};
    };
    if (status s = for_each_size(find_most); !s) return s;
    // The best there is within the budgets; without any such, what the budgets have to be raised to.
    best = nearest[1].known ? nearest[1].best : good[0].known ? good[0].best : nearest[0].best;
    best.obstacle = over_budget(wanted, good[0].known ? good[0].best : best);
    if (best.obstacle == plan_obstacle::none) best.obstacle = shortcoming(w, best);
    return {};
}

}  // namespace bumpshadow::plan_detail
