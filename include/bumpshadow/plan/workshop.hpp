#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/plan/looks.hpp>
#include <bumpshadow/plan/range.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/scene.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

// What recipes are tried on: the sample, and horizons of its patches at every size. Part of plan.hpp.
namespace bumpshadow::plan_detail {

inline constexpr int most_variants = 7;  // full size; 2, 4, 8 by heights and by horizons
inline constexpr int most_taps = 4;
// Directions whose horizons of the whole map are held at a time.
inline constexpr int directions_at_once = 4;
inline constexpr int most_directions = 33;

// Horizons of the patches, smaller by averaged heights or by averaged horizons, in all directions.
struct variant {
    int reduced_heights = 1, reduction = 1;
    horizon_map slopes = {};
    double seconds_per_sample = 0.0;  // of the bake

    [[nodiscard]] int shrunk() const { return reduced_heights * reduction; }
};

template <height_sample Sample>
struct workshop {
    const height_map<Sample>& heights;
    const scene& wanted;
    light_range range = {};
    std::pmr::memory_resource* memory = nullptr;

    patches sample = {};
    plan_detail::view view = {};
    std::span<look> looks = {};
    double reach = 0.0;     // how far what shadows is, at the most; 0: unknown
    double shadowed = 0.0;  // share of all answers that are shadow

    int divisions = 32;     // of the arc, by directions
    slice_set slices = {};  // as many as directions are baked
    horizon_scale scale = {};
    std::array<glm::dvec2, most_directions> all_directions = {};
    std::span<glm::dvec2> directions = {};
    float steepest = 0.0f;    // horizon of the map in these directions
    double free_tiles = 0.0;  // share of patches without shadow
    std::array<variant, most_variants> variants = {};
    int variant_count = 0;

    // Scratch.
    scratch_block block = {};
    float* horizons = nullptr;  // of all places of a look
    std::span<std::byte> texels = {};
    float* values = nullptr;           // of texels
    std::span<float> whole = {};       // slices of the whole map
    std::span<std::byte> baking = {};  // of the cascade
    float* averaged = nullptr;         // heights
    horizon_map full = {}, work = {};  // whole patches, in directions_at_once of them
    float* again = nullptr;            // a variant that is baked once more
    std::array<float, most_patches_of_one> steepest_of_patch = {};

    // Takes the memory, asks what is lit, and bakes what recipes are tried on.
    [[nodiscard]] status set_up(std::uint32_t seed) {
        choose_directions();
        const int most = directions.size() == 1 ? most_patches_of_one : most_patches;
        sample = choose_patches(heights.extent, heights.edge, most, seed);
        view = shape_view(wanted, sample);
        if (status s = allocate(); !s) return s;
        if (status s = ask(seed); !s) return s;
        return bake_variants();
    }

    // Bakes some variants of patches that differ in the reduction alone, in some directions.
    //   seconds: of the bake
    [[nodiscard]] status bake(std::span<variant> some, std::span<const glm::dvec2> in, const bake_options& options,
                              double& seconds) {
        const int by = some.front().reduced_heights;
        if (by == 1) return bake_patches(heights, some, in, options, seconds);
        return bake_patches(average_heights(heights, by, averaged), some, in, options, seconds);
    }

    // A variant's horizons in other directions: where bake() may put them.
    [[nodiscard]] variant other(const variant& v, int count) const {
        variant o = v;
        const glm::ivec2 extent = v.slopes.extent;
        o.slopes = {.values = {again, required_size(extent, count)}, .extent = extent, .bearings = count};
        return o;
    }

private:
    void choose_directions() {
        const bool is_part = range.arc > 0.0 && range.arc < 1.0;
        // Averages over pixels tell fewer bearings apart.
        const int around = wanted.texels_per_pixel < 2.0 ? 32 : 24;
        divisions = range.arc == 0.0 ? 1 : range.arc == 1.0 ? around : range.arc > 0.3 ? 24 : 12;
        slices.count = divisions + (is_part ? 1 : 0);
        slices.arc = range.arc;
        // The cheaper bearing from the start where the better one is beyond the budget.
        const texture_kind kind = wanted.volumes ? texture_kind::volume : texture_kind::array;
        if (gpu_cost_of({.slices = slices, .kind = kind}) > wanted.gpu_cost) slices.function = bearing_function::octant;
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
        // Light above it is never shadowed, and what is steeper than any light need not be told apart.
        scale = {quantity::slope, float((std::max)((std::min)(1.05 * range.highest_slope, 4.0), 1e-3))};
    }

    // Sizes that recipes are tried at. A pixel is not looked at in texels smaller than a quarter of it.
    [[nodiscard]] bool is_tried(int by) const { return sample.divides(by) && 4 * by >= sample.pixel; }

    [[nodiscard]] horizon_map room(glm::ivec2 extent, int count) {
        const std::size_t size = required_size(extent, count);
        return {.values = {block.carve<float>(size), size}, .extent = extent, .bearings = count};
    }

    [[nodiscard]] status allocate() {
        const std::size_t look_count = view.looks(sample.count), of_map = required_size(heights.extent, 1);
        const std::size_t places = sample.pixel == 1 ? 1 : std::size_t(most_taps) * most_taps;
        const int at_once = (std::min)(slices.count, directions_at_once);
        const std::size_t row = required_size(sample.row(), at_once);
        scratch_layout layout;
        layout.add<look>(look_count).add<float>(places * look_count);
        layout.add<float>(directions_at_once * of_map).add<float>(of_map).add<float>(row).add<float>(row);
        std::size_t most = 0;
        for (const int by : {1, 2, 4, 8}) {
            if (!is_tried(by)) continue;
            const std::size_t packed = required_size(sample.packed(by, sample.count), slices.count);
            layout.add<float>(packed);
            if (by > 1) layout.add<float>(packed);
            most = (std::max)(most, packed);
        }
        const std::size_t of_bake = cascade_scratch_size(heights);
        layout.add<float>(most).add<float>(most).add<std::byte>(2 * most + 4096).add<std::byte>(of_bake);
        if (status s = block.allocate({.memory = memory}, layout.bytes(), "a plan"); !s) return s;
        looks = {block.carve<look>(look_count), look_count};
        horizons = block.carve<float>(places * look_count);
        whole = {block.carve<float>(directions_at_once * of_map), directions_at_once * of_map};
        averaged = block.carve<float>(of_map);
        full = room(sample.row(), at_once);
        work = room(sample.row(), at_once);
        again = block.carve<float>(most);
        values = block.carve<float>(most);
        texels = {block.carve<std::byte>(2 * most + 4096), 2 * most + 4096};
        baking = {block.carve<std::byte>(of_bake), of_bake};
        return {};
    }

    // What of the looks is lit.
    [[nodiscard]] status ask(std::uint32_t seed) {
        const auto each = std::size_t(view.pixels * view.rays);
        for (int p = 0; p < sample.count; ++p)
            choose_looks(wanted, sample, view, heights.texel_size, p, seed, looks.data() + std::size_t(p) * each);
        if (is_baked(wanted, sample)) {
            if (status s = ask_cascade(); !s) return s;
        } else {
            // Before any bake: `whole` is free for the bounds.
            static_assert(sizeof(Sample) <= directions_at_once * sizeof(float) / 2);
            const std::size_t bound_count = height_bounds<Sample>::required_size(heights.extent);
            const height_bounds<Sample> bounds(heights, {reinterpret_cast<Sample*>(whole.data()), bound_count});
            for (look& l : looks) ask_exact(heights, bounds, sample, view, l);
        }
        for (const look& l : looks)
            for (int e = 0; e < view.lights; ++e) {
                shadowed += (1.0 - double(l.lit[e])) / (double(looks.size()) * view.lights);
                reach = (std::max)(reach, l.reach);
            }
        return {};
    }

    // Exact horizons of all texels of enough pixels would take too long.
    [[nodiscard]] status ask_cascade() {
        for (int first = 0; first < view.rays; first += directions_at_once) {
            const int count = (std::min)(view.rays - first, directions_at_once);
            std::array<glm::dvec2, directions_at_once> in;
            for (int i = 0; i < count; ++i) in[std::size_t(i)] = glm::dvec2(looks[std::size_t(first + i)].direction);
            const horizon_map baked{.values = whole, .extent = heights.extent, .bearings = count};
            const std::span<const glm::dvec2> some(in.data(), std::size_t(count));
            if (status s = bake_cascade(heights, some, baked, {.scratch = baking}); !s) return s;
            for (std::size_t i = 0; i < looks.size(); ++i) {
                const int ray = int(i % std::size_t(view.rays)) - first;
                if (ray < 0 || ray >= count) continue;
                const glm::ivec2 corner = corner_of(looks[i], sample);
                exposure e;
                for (int y = 0; y < sample.pixel; ++y)
                    for (int x = 0; x < sample.pixel; ++x)
                        e.add(view, looks[i], double(baked.row(ray, corner.y + y)[corner.x + x]));
                e.write(view, looks[i]);
            }
        }
        return {};
    }

    // Keeps what of the patches is packed, from `first` on among the directions of `to`.
    void crop(const horizon_map& from, int by, int first, const horizon_map& to) const {
        const rectangle part = sample.part(by);
        const int side = sample.extent.x / by;
        for (int b = 0; b < from.bearings; ++b)
            for (int y = 0; y < part.extent.y; ++y) {
                const float* row = from.row(b, part.origin.y + y) + part.origin.x;
                float* out = to.row(first + b, y);
                for (int p = 0; p < sample.count; ++p, row += side, out += part.extent.x)
                    std::copy_n(row, part.extent.x, out);
            }
    }

    template <height_sample Any>
    [[nodiscard]] status bake_patches(const height_map<Any>& map, std::span<variant> some,
                                      std::span<const glm::dvec2> in, bake_options options, double& seconds) {
        const int by = some.front().reduced_heights;
        options.memory = memory;
        if (cascade_scratch_size(map, options) <= baking.size()) options.scratch = baking;
        const glm::ivec2 side = sample.extent / by;
        const auto sized = [&](const horizon_map& room, int smaller, std::size_t count) {
            const glm::ivec2 extent(sample.row() / (by * smaller));
            return horizon_map{.values = room.values, .extent = extent, .bearings = int(count)};
        };
        seconds = 0.0;
        for (std::size_t first = 0; first < in.size(); first += directions_at_once) {
            const std::size_t count = (std::min)(in.size() - first, std::size_t(directions_at_once));
            const horizon_map baked{.values = whole, .extent = map.extent, .bearings = int(count)};
            const auto start = std::chrono::steady_clock::now();
            if (status s = bake_cascade(map, in.subspan(first, count), baked, options); !s) return s;
            seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            const horizon_map slopes = sized(full, 1, count);
            for (std::size_t i = 0; i < count; ++i)
                for (int p = 0; p < sample.count; ++p) {
                    const glm::ivec2 origin = sample.origins[std::size_t(p)] / by;
                    for (int y = 0; y < side.y; ++y)
                        std::copy_n(baked.row(int(i), origin.y + y) + origin.x, side.x,
                                    slopes.row(int(i), y) + p * side.x);
                }
            if (by == 1) look_for_steepest(baked, slopes);
            // Each size from the one before: means of means.
            horizon_map from = slopes, to = work, spare = full;
            int reached = 1;
            for (const variant& v : some) {
                while (reached < v.reduction) {
                    const horizon_map smaller = sized(to, reached *= 2, count);
                    if (status s = reduce(from, scale, smaller, serial{}, memory); !s) return s;
                    from = smaller;
                    std::swap(to, spare);
                }
                crop(from, v.shrunk(), int(first), v.slopes);
            }
        }
        return {};
    }

    // Of the map, and of each patch.
    void look_for_steepest(const horizon_map& baked, const horizon_map& slopes) {
        steepest = (std::max)(steepest, steepest_slope(baked));
        const auto side = std::size_t(sample.extent.x);
        for (int p = 0; p < sample.count; ++p) {
            float most[patch_side] = {};
            for (int b = 0; b < slopes.bearings; ++b)
                for (int y = 0; y < slopes.extent.y; ++y) {
                    const float* const row = slopes.row(b, y) + std::size_t(p) * side;
                    for (std::size_t x = 0; x < side; ++x) most[x] = row[x] > most[x] ? row[x] : most[x];
                }
            float& of_patch = steepest_of_patch[std::size_t(p)];
            for (const float slope : most) of_patch = (std::max)(of_patch, slope);
        }
    }

    [[nodiscard]] status bake_variants() {
        const auto add = [&](int reduced_heights, int reduction) {
            const int by = reduced_heights * reduction;
            variants[std::size_t(variant_count++)] = {reduced_heights, reduction,
                                                      room(sample.packed(by, sample.count), slices.count)};
        };
        const auto bake_last = [&](int count) {
            const auto some = std::span(variants).subspan(std::size_t(variant_count - count), std::size_t(count));
            double seconds = 0.0;
            if (status s = bake(some, directions, {}, seconds); !s) return s;
            const glm::ivec2 extent = reduced_extent(heights.extent, some.front().reduced_heights);
            for (variant& v : some)
                v.seconds_per_sample = seconds / (double(extent.x) * extent.y * double(directions.size()));
            return status{};
        };
        int count = 0;
        for (const int by : {1, 2, 4, 8})
            if (is_tried(by)) add(1, by), ++count;
        if (status s = bake_last(count); !s) return s;
        for (int p = 0; p < sample.count; ++p)
            if (double(steepest_of_patch[std::size_t(p)]) < range.lowest_slope) free_tiles += 1.0 / sample.count;
        for (const int by : {2, 4, 8}) {
            // What averaged squares leave over at a map's end would shift the texture against the map.
            const bool covers = heights.extent.x % by == 0 && heights.extent.y % by == 0;
            if (!is_tried(by) || !covers) continue;
            add(by, 1);
            if (status s = bake_last(1); !s) return s;
        }
        scale.max_slope = (std::max)((std::min)(scale.max_slope, steepest), 1e-3f);
        return {};
    }
};

}  // namespace bumpshadow::plan_detail
