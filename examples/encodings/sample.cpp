#include "encodings/sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/exact.hpp>

#include "common/progress.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

// Numerical Recipes' generator: the same patches with every standard library.
class generator {
public:
    explicit generator(std::uint32_t seed) : state_(seed) {}
    // 0 to count - 1.
    int below(int count) {
        state_ = state_ * 1664525u + 1013904223u;
        return int((std::uint64_t(state_) * std::uint64_t(count)) >> 32);
    }

private:
    std::uint32_t state_;
};

float steepest_of(const sample_map& map) { return *std::max_element(map.slopes.begin(), map.slopes.end()); }

// A view that is only read; the library has one type for both.
bs::horizon_map view_of(const sample_map& map, const std::vector<float>& slopes, int count, int step) {
    return {.values = {const_cast<float*>(slopes.data()), slopes.size()},
            .extent = map.extent,
            .bearings = count,
            .row_stride = 0,
            .slice_stride = map.texels() * std::size_t(step)};
}

// Exact horizons of one patch.
void bake_patch(const named_map& from, const sample_map& map, std::size_t patch, std::span<const glm::dvec2> directions,
                std::vector<float>& slopes, const progress& execute) {
    bs::bake_options options;
    options.region = {map.origins[patch], glm::ivec2(patch_side)};
    const bs::horizon_map out{.values = std::span(slopes).subspan(patch * patch_side),
                              .extent = options.region.extent,
                              .bearings = int(directions.size()),
                              .row_stride = std::size_t(map.extent.x),
                              .slice_stride = map.texels()};
    with_height_map(from.heights, from.source, from.scale, [&](const auto& view) {
        if (const bs::status s = bs::bake_exact(view, directions, out, options, execute); !s)
            throw failure("cannot use " + from.name + ": " + s.message().c_str());
    });
}

// Bearing of the light in which a function's slice is found; -1: none.
int light_bearing_of(int slice) {
    constexpr int eighth = function_slices / 8;  // where all functions agree
    return slice % eighth == 0 ? slice / eighth * (light_bearings / 8) : -1;
}

}  // namespace

bs::horizon_map sample_map::every(int count) const { return view_of(*this, slopes, count, light_bearings / count); }

bs::horizon_map sample_map::slices_of(bs::bearing_function function, int count) const {
    if (function == bs::bearing_function::exact) return every(count);
    return view_of(*this, sliced[std::size_t(function)], count, function_slices / count);
}

std::vector<glm::dvec2> sample_map::directions_of(int count) const {
    std::vector<glm::dvec2> some;
    for (int i = 0; i < count; ++i) some.push_back(directions[std::size_t(i * light_bearings / count)]);
    return some;
}

int patches_of(int texels) { return std::max(1, (texels + patch_side * patch_side - 1) / (patch_side * patch_side)); }

sample_map take_sample(const named_map& from, int texels, std::uint32_t seed, const std::function<void()>& between) {
    const std::string& name = from.name;
    const int patches = patches_of(texels);
    const int grid = int(std::ceil(std::sqrt(double(patches)) - 1e-9));
    const glm::ivec2 cell = from.heights.extent / grid;
    if (cell.x < patch_side || cell.y < patch_side)
        throw failure("cannot use " + name + ": its " + std::to_string(from.heights.extent.x) + " x " +
                      std::to_string(from.heights.extent.y) + " texels have no room for " + std::to_string(patches) +
                      " patches of " + std::to_string(patch_side) + " x " + std::to_string(patch_side));
    sample_map map{.name = name,
                   .extent = {patches * patch_side, patch_side},
                   .origins = {},
                   .directions = {},
                   .slopes = {},
                   .sliced = {}};
    map.directions.resize(light_bearings);
    bs::fill_directions(map.directions);
    map.slopes.resize(map.texels() * light_bearings);

    generator random(seed);
    const progress execute(bs::threads(), name.c_str(), !between && stderr_is_terminal());
    for (int i = 0; i < patches; ++i) {
        const glm::ivec2 first = glm::ivec2(i % grid, i / grid) * cell;
        map.origins.push_back(
            {first.x + random.below(cell.x - patch_side + 1), first.y + random.below(cell.y - patch_side + 1)});
        bake_patch(from, map, std::size_t(i), map.directions, map.slopes, execute);
        if (between) between();
    }
    map.steepest = steepest_of(map);
    return map;
}

void add_slices(sample_map& map, const named_map& from, bs::bearing_function function,
                const std::function<void()>& between) {
    std::vector<glm::dvec2> all(function_slices), missing;
    bs::fill_directions(all, 0.0, function);
    for (int i = 0; i < function_slices; ++i)
        if (light_bearing_of(i) < 0) missing.push_back(all[std::size_t(i)]);
    std::vector<float> baked(map.texels() * missing.size());
    const progress execute(bs::threads(), map.name.c_str(), !between && stderr_is_terminal());
    for (std::size_t i = 0; i < map.origins.size(); ++i) {
        bake_patch(from, map, i, missing, baked, execute);
        if (between) between();
    }
    std::vector<float>& to = map.sliced[std::size_t(function)];
    to.reserve(map.texels() * function_slices);
    for (auto [slice, next] = std::pair(0, baked.cbegin()); slice < function_slices; ++slice) {
        const int known = light_bearing_of(slice);
        const auto from_plane =
            known < 0 ? next : map.slopes.cbegin() + std::ptrdiff_t(std::size_t(known) * map.texels());
        to.insert(to.end(), from_plane, from_plane + std::ptrdiff_t(map.texels()));
        if (known < 0) next += std::ptrdiff_t(map.texels());
    }
}

sample_map crop(const sample_map& map, int side) {
    const int patches = map.extent.x / map.side;
    sample_map small{.name = map.name,
                     .extent = {patches * side, side},
                     .side = side,
                     .origins = map.origins,
                     .directions = map.directions,
                     .slopes = {},
                     .sliced = {}};
    const auto cut = [&](const std::vector<float>& from, std::vector<float>& to) {
        const std::size_t step = std::size_t(map.side), rows = from.size() / std::size_t(map.extent.x);
        to.reserve(rows / step * std::size_t(side) * std::size_t(small.extent.x));
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t i = 0; i < std::size_t(patches) && row % step < std::size_t(side); ++i) {
                const float* const first = from.data() + (row * std::size_t(patches) + i) * step;
                to.insert(to.end(), first, first + side);
            }
    };
    cut(map.slopes, small.slopes);
    for (std::size_t f = 0; f < map.sliced.size(); ++f) cut(map.sliced[f], small.sliced[f]);
    small.steepest = steepest_of(small);
    return small;
}

}  // namespace examples
