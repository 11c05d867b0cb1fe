#pragma once

#include <span>
#include <vector>

#include "encodings/report.hpp"
#include "encodings/sample.hpp"

namespace examples {

// What SSBump maps hold, against light that is traced over exact horizons. The grids have a column for each map and one
// for their mean:
//   normals, degrees: recovered without occlusion, beside those of an 8-bit normal map; recovered with occlusion,
//   beside
//     the mean unblocked directions
//   light from three lightmaps: root mean square error over the mean of traced light, in percent
//   small formats: what they add to diffuse light, in percent, and to reflections, in degrees
struct ssbump_figures {
    std::vector<grid> grids;
    std::vector<check> checks;
};

// samples: of the maps, in the same order
[[nodiscard]] ssbump_figures measure_ssbump(std::span<const named_map> maps, std::span<const sample_map> samples);

}  // namespace examples
