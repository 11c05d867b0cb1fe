#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "common/heights.hpp"

namespace examples {

// Bearings of the traced light, and of the exact horizons: a multiple of 8, 12, 16, 24, 32 and 48.
inline constexpr int light_bearings = 96;
// Slices of a bearing function that horizons are baked for: a multiple of 4, 8 and 16.
inline constexpr int function_slices = 32;
// Elevations of the traced light, in degrees.
inline constexpr std::array<double, 6> light_elevations{5.0, 10.0, 20.0, 30.0, 45.0, 60.0};
// Side of a patch: whole blocks of 4, 5 and 6 texels.
inline constexpr int patch_side = 60;

// A height map under the name that the tables have for it.
struct named_map {
    std::string name;
    height_source source;
    height_samples heights;
    double scale = 1.0;
};

// Patches of one height map, side by side, with their exact horizons.
struct sample_map {
    std::string name;
    glm::ivec2 extent{0};                // patches * side, side
    int side = patch_side;               // texels along a patch
    std::vector<glm::ivec2> origins;     // first texel of each patch in the height map
    std::vector<glm::dvec2> directions;  // of light_bearings, true angles from +x
    std::vector<float> slopes;           // [bearing][y][x], exact
    float steepest = 0.0f;
    // Exact slopes in the directions of function_slices slices of each bearing function, [function][slice][y][x]; empty
    // where add_slices has not baked them.
    std::array<std::vector<float>, 5> sliced;

    // The horizons at `count` evenly spaced bearings, which has to divide light_bearings.
    [[nodiscard]] bumpshadow::horizon_map every(int count) const;
    [[nodiscard]] std::vector<glm::dvec2> directions_of(int count) const;
    // The horizons in the directions of the slices of a function; `count` has to divide function_slices.
    [[nodiscard]] bumpshadow::horizon_map slices_of(bumpshadow::bearing_function function, int count) const;
    [[nodiscard]] std::size_t texels() const { return std::size_t(extent.x) * std::size_t(extent.y); }
};

// Bakes patches that are spread over a map: one in each cell of a grid, its place in there drawn by a fixed generator.
// texels: how many at least. between: called after each patch. Throws failure where the map has no room for them.
[[nodiscard]] sample_map take_sample(const named_map& from, int texels, std::uint32_t seed,
                                     const std::function<void()>& between = {});

// Patches that the texels of a sample make.
[[nodiscard]] int patches_of(int texels);

// Bakes the directions of a function's slices, all but those that have been baked for the light.
void add_slices(sample_map& map, const named_map& from, bumpshadow::bearing_function function,
                const std::function<void()>& between = {});

// The same, less what is beyond `side` texels of every patch.
[[nodiscard]] sample_map crop(const sample_map& map, int side);

}  // namespace examples
