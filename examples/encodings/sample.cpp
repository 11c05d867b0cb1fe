#include "encodings/sample.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

bs::horizon_map sample_map::every(int count) const {
    const std::size_t step = texels() * std::size_t(light_bearings / count);
    // A view that is only read; the library has one type for both.
    return {.values = {const_cast<float*>(slopes.data()), slopes.size()},
            .extent = extent,
            .bearings = count,
            .row_stride = 0,
            .slice_stride = step};
}

std::vector<glm::dvec2> sample_map::directions_of(int count) const {
    std::vector<glm::dvec2> some;
    for (int i = 0; i < count; ++i) some.push_back(directions[std::size_t(i * light_bearings / count)]);
    return some;
}

sample_map take_sample(const named_map& from, int texels, std::uint32_t seed) {
    const std::string& name = from.name;
    const int patches = std::max(1, (texels + patch_side * patch_side - 1) / (patch_side * patch_side));
    const int grid = int(std::ceil(std::sqrt(double(patches)) - 1e-9));
    const glm::ivec2 cell = from.heights.extent / grid;
    if (cell.x < patch_side || cell.y < patch_side)
        throw failure("cannot use " + name + ": its " + std::to_string(from.heights.extent.x) + " x " +
                      std::to_string(from.heights.extent.y) + " texels have no room for " + std::to_string(patches) +
                      " patches of " + std::to_string(patch_side) + " x " + std::to_string(patch_side));
    sample_map map{
        .name = name, .extent = {patches * patch_side, patch_side}, .origins = {}, .directions = {}, .slopes = {}};
    map.directions.resize(light_bearings);
    bs::fill_directions(map.directions);
    map.slopes.resize(map.texels() * light_bearings);

    generator random(seed);
    const progress execute(bs::threads(), name.c_str());
    with_height_map(from.heights, from.source, from.scale, [&](const auto& view) {
        for (int i = 0; i < patches; ++i) {
            const glm::ivec2 first = glm::ivec2(i % grid, i / grid) * cell;
            bs::bake_options options;
            options.region.origin = {first.x + random.below(cell.x - patch_side + 1),
                                     first.y + random.below(cell.y - patch_side + 1)};
            options.region.extent = glm::ivec2(patch_side);
            map.origins.push_back(options.region.origin);
            const std::size_t begin = std::size_t(i) * patch_side;
            const bs::horizon_map out{.values = std::span(map.slopes).subspan(begin),
                                      .extent = options.region.extent,
                                      .bearings = light_bearings,
                                      .row_stride = std::size_t(map.extent.x),
                                      .slice_stride = map.texels()};
            if (const bs::status s = bs::bake_exact(view, map.directions, out, options, execute); !s)
                throw failure("cannot use " + name + ": " + s.message().c_str());
        }
    });
    map.steepest = steepest_of(map);
    return map;
}

sample_map crop(const sample_map& map, int side) {
    const int patches = map.extent.x / map.side;
    sample_map small{.name = map.name,
                     .extent = {patches * side, side},
                     .side = side,
                     .origins = map.origins,
                     .directions = map.directions,
                     .slopes = {}};
    small.slopes.reserve(small.texels() * light_bearings);
    for (int b = 0; b < light_bearings; ++b)
        for (int y = 0; y < side; ++y)
            for (int i = 0; i < patches; ++i) {
                const float* from =
                    map.slopes.data() +
                    (std::size_t(b) * std::size_t(map.extent.y) + std::size_t(y)) * std::size_t(map.extent.x) +
                    std::size_t(i) * std::size_t(map.side);
                small.slopes.insert(small.slopes.end(), from, from + side);
            }
    small.steepest = steepest_of(small);
    return small;
}

}  // namespace examples
