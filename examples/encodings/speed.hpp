#pragma once

#include <string>
#include <vector>

#include "common/heights.hpp"

namespace examples {

// Something that was timed.
struct figure {
    std::string what;  // with its unit
    double value = 0.0;
};

struct speeds {
    // Of packing 8 slices in R8 in the bake of the 32 directions that they are fitted to, by the slowest fit.
    double pack_share = 0.0;
    double shade_rate = 0.0;      // million texels a second: one light, a tangent volume in R8
    std::vector<figure> figures;  // all, those two included
};

// Bakes (the default cascade), packs and shades a whole map on one thread; medians of `repeats`. Throws failure.
[[nodiscard]] speeds measure_speed(const height_samples& heights, const height_source& source, double height_scale,
                                   int repeats);

}  // namespace examples
