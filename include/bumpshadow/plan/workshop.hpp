#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/plan/looks.hpp>
#include <bumpshadow/plan/range.hpp>
#include <bumpshadow/plan/scene.hpp>
#include <bumpshadow/plan/trial.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

// What recipes are tried on: the sample, and horizons of its patches at every size. Part of plan.hpp.
namespace bumpshadow::plan_detail {

inline constexpr int most_variants = 7;  // full size; 2, 4, 8 by heights and by horizons

// Horizons of the patches, smaller by averaged heights or by averaged horizons, in all directions.
struct variant {
    int reduced_heights, reduction;
    horizon_map slopes;
    double seconds_per_sample;  // of the bake
};

// Cycles a wave on RDNA2, net of the empty shader, as shader_cost prints them with a hard edge. A soft one for lights
// above the surface takes 4 less.
[[nodiscard]] constexpr double cost_of(texture_kind kind, const slice_set& slices) {
    if (kind == texture_kind::flat) return 20.0;
    const bool arc = is_arc(slices);
    const double around = kind == texture_kind::array ? (arc ? 16.0 : 18.0) : (arc ? 4.0 : 0.0);
    switch (slices.function) {
        case bearing_function::exact: return 38.0 + around;
        case bearing_function::octant: return 26.0 + around;
        case bearing_function::cubic: return 30.0 + around;
        default: return 32.0 + around;
    }
}

template <height_sample Sample>
struct workshop {
    const height_map<Sample>& heights;
    const scene& wanted;
    light_range range = {};
    std::pmr::memory_resource* memory = nullptr;

    patches sample = {};
    plan_detail::view view = {};
    std::span<look> looks = {};
    double reach = 0.0;     // how far what shadows is, at the most
    double shadowed = 0.0;  // share of all answers that are shadow

    int divisions = 48;     // of the arc, by directions
    slice_set slices = {};  // as many as directions are baked
    std::array<glm::dvec2, most_directions> all_directions = {};
    std::span<glm::dvec2> directions = {};
    float steepest = 0.0f;    // horizon of the map in these directions
    double free_tiles = 0.0;  // share of patches without shadow
    std::array<variant, most_variants> variants = {};
    int variant_count = 0;

    // Scratch.
    scratch_block block = {};
    float* horizons = nullptr;  // one a look
    std::span<std::byte> texels = {};
    std::span<float> whole = {};       // slices of the whole map
    float* averaged = nullptr;         // heights
    horizon_map full = {}, work = {};  // of whole patches

    // Takes the memory, asks exact, and bakes what recipes are tried on.
    [[nodiscard]] status set_up(std::uint32_t seed) {
        sample = choose_patches(heights.extent, seed);
        view = shape_view(wanted, sample);
        choose_directions();
        if (status s = allocate(); !s) return s;
        ask_exact(seed);
        return bake_variants();
    }

    // Horizons of the patches for heights averaged over squares, or as they are.
    [[nodiscard]] status bake(int by, std::span<const glm::dvec2> in, const bake_options& options,
                              const horizon_map& out) {
        if (by == 1) return bake_patches(heights, sample, 1, in, options, whole, out, steepest);
        const glm::ivec2 extent = reduced_extent(heights.extent, by);
        average_heights(heights, by, extent, averaged);
        height_map<float> map = tight_height_map<float>(averaged, extent);
        map.texel_size = heights.texel_size * double(by);
        map.edge = heights.edge;
        if (heights.no_data) map.no_data = std::numeric_limits<float>::quiet_NaN();
        float steepest_of_averages = 0.0f;
        return bake_patches(map, sample, by, in, options, whole, out, steepest_of_averages);
    }

private:
    void choose_directions() {
        const bool is_part = range.arc > 0.0 && range.arc < 1.0;
        divisions = range.arc == 0.0 ? 1 : range.arc == 1.0 ? 48 : range.arc > 0.3 ? 24 : 12;
        slices.count = divisions + (is_part ? 1 : 0);
        slices.arc = range.arc;
        // The cheaper bearing from the start where the better one is beyond the budget.
        const texture_kind kind = wanted.volumes ? texture_kind::volume : texture_kind::array;
        if (cost_of(kind, slices) > wanted.gpu_cost) slices.function = bearing_function::octant;
        const auto bearing = [&](double turns) {
            return to_bearing(slices.function, exact_direction(turns - std::floor(turns)));
        };
        if (range.arc < 1.0) slices.phase = bearing(range.first);
        if (is_part) {
            const double way = bearing(range.first + range.arc) - slices.phase;
            slices.arc = way - std::floor(way);
        }
        directions = std::span(all_directions).first(std::size_t(slices.count));
        fill_directions(directions, slices);
    }

    [[nodiscard]] horizon_map room(glm::ivec2 extent) {
        const std::size_t size = required_size(extent, slices.count);
        return {.values = {block.carve<float>(size), size}, .extent = extent, .bearings = slices.count};
    }

    [[nodiscard]] status allocate() {
        const std::size_t look_count = view.looks(sample.count), of_map = required_size(heights.extent, 1);
        const std::size_t stack = required_size(sample.stack(), slices.count);
        scratch_layout layout;
        layout.add<look>(look_count).add<float>(look_count).add<float>(directions_at_once * of_map).add<float>(of_map);
        layout.add<float>(stack).add<float>(stack);
        std::size_t most = 0;
        for (const int by : {1, 2, 4, 8}) {
            const std::size_t packed = required_size(sample.packed(by), slices.count);
            layout.add<float>(packed).add<float>(packed);
            most = (std::max)(most, 2 * packed + 4096);
        }
        layout.add<std::byte>(most);
        if (status s = block.allocate({.memory = memory}, layout.bytes(), "a plan"); !s) return s;
        looks = {block.carve<look>(look_count), look_count};
        horizons = block.carve<float>(look_count);
        whole = {block.carve<float>(directions_at_once * of_map), directions_at_once * of_map};
        averaged = block.carve<float>(of_map);
        texels = {block.carve<std::byte>(most), most};
        full = room(sample.stack());
        work = room(sample.stack());
        return {};
    }

    void ask_exact(std::uint32_t seed) {
        // Before any bake: `whole` is free for the bounds.
        static_assert(sizeof(Sample) <= directions_at_once * sizeof(float) / 2);
        const std::size_t bound_count = height_bounds<Sample>::required_size(heights.extent);
        const std::span<Sample> storage(reinterpret_cast<Sample*>(whole.data()), bound_count);
        const height_bounds<Sample> bounds(heights, storage);
        const auto each = std::size_t(view.pixels * view.rays);
        for (int p = 0; p < sample.count; ++p)
            look_at_patch(heights, bounds, wanted, sample, view, p, seed, looks.data() + std::size_t(p) * each);
        for (const look& l : looks)
            for (int e = 0; e < view.lights; ++e) {
                shadowed += (1.0 - double(l.lit[e])) / (double(looks.size()) * view.lights);
                reach = (std::max)(reach, double(l.reach));
            }
    }

    void add(int reduced_heights, int reduction, const horizon_map& slopes, double seconds_per_sample) {
        const int by = reduced_heights * reduction;
        const variant v{reduced_heights, reduction, room(sample.packed(by)), seconds_per_sample};
        crop_patches(slopes, sample, by, v.slopes);
        variants[std::size_t(variant_count++)] = v;
    }

    [[nodiscard]] status bake_variants() {
        const auto smaller = [&](int by) {
            horizon_map m = work;
            m.extent = sample.stack() / by;
            return m;
        };
        for (const int by : {1, 2, 4, 8}) {
            // What averaged squares leave over at a map's end would shift the texture against the map.
            const bool covers = heights.extent.x % by == 0 && heights.extent.y % by == 0;
            if (!sample.divides(by) || !covers) continue;
            const horizon_map slopes = by == 1 ? full : smaller(by);
            const auto start = std::chrono::steady_clock::now();
            if (status s = bake(by, directions, {.memory = memory}, slopes); !s) return s;
            const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
            const glm::ivec2 extent = reduced_extent(heights.extent, by);
            add(by, 1, slopes, time.count() / (double(extent.x) * extent.y * double(directions.size())));
        }
        for (int p = 0; p < sample.count; ++p) {
            horizon_map patch = full;
            patch.slice_stride = full.slice_step();
            patch.values = full.values.subspan(std::size_t(p) * required_size(sample.extent, 1));
            patch.extent = sample.extent;
            if (double(steepest_slope(patch)) < range.lowest_slope) free_tiles += 1.0 / sample.count;
        }
        const horizon_scale scale{quantity::slope, (std::max)((std::min)(steepest, 4.0f), 1e-3f)};
        for (const int by : {2, 4, 8}) {
            if (!sample.divides(by)) continue;
            const horizon_map slopes = smaller(by);
            if (status s = reduce(full, scale, slopes, serial{}, memory); !s) return s;
            add(1, by, slopes, variants[0].seconds_per_sample);
        }
        return {};
    }
};

}  // namespace bumpshadow::plan_detail
