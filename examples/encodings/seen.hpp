#pragma once

#include <array>
#include <vector>

#include <bumpshadow/encode/quantity.hpp>

#include "encodings/sample.hpp"

namespace examples {

// Elevations of the light in one bearing, in the unit of a texture.
using light_values = std::array<float, light_elevations.size()>;

// What a shader reads of a map: the horizons in the unit of the texture, which 1 stands for.
struct seen {
    std::vector<float> horizons;       // [bearing][y][x]
    std::vector<light_values> lights;  // [bearing]
};

// Everything but the horizons, which are 0; lights over what stands for 1.
[[nodiscard]] seen unseen(const sample_map& map, const bumpshadow::horizon_scale& scale);

// Share of wrong answers, lit or in shadow, in percent, over texels at least `margin` from the border of their patch.
// only: index of the one elevation that counts; -1: all of them
[[nodiscard]] double mismatch(const sample_map& map, const seen& found, int margin = 0, int only = -1);

}  // namespace examples
