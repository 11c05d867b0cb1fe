#pragma once

#include <cstdint>
#include <memory_resource>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/plan/range.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/refine.hpp>
#include <bumpshadow/plan/scene.hpp>
#include <bumpshadow/plan/search.hpp>
#include <bumpshadow/plan/tiles.hpp>
#include <bumpshadow/plan/workshop.hpp>
#include <bumpshadow/status.hpp>

// The cheapest set-up that a scene needs: what to bake, what to store and what to leave out.

namespace bumpshadow {

// What plan() takes besides map and scene.
struct plan_options {
    std::uint32_t seed = 1;                       // of the sample
    std::pmr::memory_resource* memory = nullptr;  // null: std::pmr::get_default_resource()
};

// Plans shadows for a height map and a scene: tries set-ups on patches of this very map, judged by exact horizons
// (pixels of many texels by the cascade's), and returns the one of fewest bytes, then of the least work to bake and to
// pack, then of the cheapest shader, whose error is within what the scene allows. So pixels of many texels are looked
// at in up to 16 places; scene::gpu_cost bounds what that may cost.
// Cost: up to 45 directions of the cascade, 32768 rays of exact, and the trials: at 1024 x 1024 texels as long as the
// bake of 16 bearings for one light, 3 to 5 times as long for light from many bearings.
// Memory: from the resource, about 40 bytes a texel and 55 MiB.
// Accuracy: what it predicts is a sample of 512 patches, of a single bearing 2048: within 20 % of what is measured or
// 0.1 percentage points in 37 of 37 rows of 7 maps (`plan --proof`); predicted.interval says how sure it is. Borders
// of maps that do not repeat are not in the sample.
// Errors: those of check() of heights and scene, not_finite heights, a map of nothing but holes (missing); memory. Then
// `result` is left as it was.
template <height_sample Sample>
[[nodiscard]] status plan(const height_map<Sample>& heights, const scene& wanted, recipe& result,
                          const plan_options& options = {}) {
    using namespace plan_detail;
    if (status s = check(heights); !s) return s;
    if (status s = check(wanted); !s) return s;
    if (status s = check_samples(heights); !s) return s;
    if (reference_texel(heights).x < 0) return {error::missing, "heights (nothing but no_data)"};

    recipe r;
    r.wants_normals = !wanted.has_normals;
    if (r.wants_normals) r.say("a normal map is missing: bake one (bake_normals)");
    r.wants_masks = wanted.has_lightmaps;
    if (r.wants_masks) r.say("lightmaps: masks (SSBump) shadow them without a direction of light, 3 bytes a texel");
    const light_range range = range_of(wanted);
    const double rise = steepest_rise(heights);
    if (range.lowest_slope >= rise) {
        r.shadows = false;
        r.say("no shadows at all: light is never below %.1f degrees, and no slope of the surface is above %.1f",
              degrees_of(range.lowest_slope), degrees_of(rise));
        result = r;
        return {};
    }
    workshop<Sample> w{heights, wanted, range, options.memory};
    if (status s = w.set_up(options.seed); !s) return s;
    // What is never shadowed needs no horizons; what hardly is does where their elevations are asked for.
    if (w.shadowed == 0.0 || (is_infinite(wanted.degrees) && w.shadowed <= 0.95 * wanted.mismatch)) {
        r.shadows = false;
        r.predicted.mismatch = w.shadowed;
        if (w.shadowed == 0.0 && double(w.steepest) < range.lowest_slope)
            r.say("no shadows at all: light is never below %.1f degrees, and no horizon is above %.1f",
                  degrees_of(range.lowest_slope), degrees_of(double(w.steepest)));
        else
            r.say("no shadows at all: %.2f %% of all answers would be shadow, %.2f %% may be wrong", 100.0 * w.shadowed,
                  100.0 * wanted.mismatch);
        result = r;
        return {};
    }
    // What the sample just allows may be too much for the whole map: then again, with some error in reserve.
    const recipe start = r;
    for (const double reserve : {1.0, 0.9, 0.75}) {
        r = start;
        if (status s = search(w, reserve, r); !s) return s;
        const bool is_found = r.obstacle == plan_obstacle::none;
        if (status s = settle(w, r); !s) return s;
        if (!is_found || r.obstacle == plan_obstacle::none) break;
    }
    if (status s = refine(w, r); !s) return s;
    result = r;
    return {};
}

}  // namespace bumpshadow
