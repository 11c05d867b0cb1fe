#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/image.hpp"
#include "shade/render.hpp"

namespace examples {

// Pictures side by side, as the papers have them.
enum class sheet_kind {
    bearings,  // 4, 8, 16 and 32 slices and the traced truth (Forsyth, figures 1 to 4)
    turning,   // nine lights from -60 to 60 degrees around the given azimuth, 15 apart (Lengyel, figure 5.3)
    cube,      // the factor cube, unfolded: as RGB, and alpha beside it (Lengyel, figure 5.5)
    edges,     // a hard and a soft edge, k = 8 (Lengyel, figure 5.6)
    emboss,    // height, inverse, relief, base, product (DirectX 6, figures 1A to 1E)
};

[[nodiscard]] const std::vector<std::pair<std::string, sheet_kind>>& sheet_names();

[[nodiscard]] image8 draw_sheet(sheet_kind kind, const scene& scene, const encoding_settings& settings, double azimuth,
                                double elevation, bool factor);

}  // namespace examples
