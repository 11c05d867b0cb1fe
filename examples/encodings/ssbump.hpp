#pragma once

#include <functional>
#include <span>
#include <vector>

#include "encodings/figures.hpp"
#include "encodings/sample.hpp"

namespace examples {

// What an SSBump map holds, against light that is traced over exact horizons; each list has an entry for each name.
struct ssbump_measured {
    std::vector<double> normals;  // degrees, but for one share; not-a-number where no texel is so steep
    std::vector<double> light;    // from three lightmaps: root mean square error over the mean of traced light, percent
    std::vector<double> formats;  // what small formats add to diffuse light, percent, and to reflections, degrees
    double worst_light = 0.0;     // largest ratio of the errors with directional occlusion and without
};
[[nodiscard]] std::span<const char* const> ssbump_normal_names();
[[nodiscard]] std::span<const char* const> ssbump_light_names();
[[nodiscard]] std::span<const char* const> ssbump_format_names();

// sample: of the map. between: called twice, between the three parts
[[nodiscard]] ssbump_measured measure_ssbump(const named_map& map, const sample_map& sample,
                                             const std::function<void()>& between = {});

// The same of several maps, with a column for each and one for their mean, and what has to hold.
struct ssbump_figures {
    std::vector<grid> grids;
    std::vector<check> checks;
};

// samples: of the maps, in the same order
[[nodiscard]] ssbump_figures measure_ssbump(std::span<const named_map> maps, std::span<const sample_map> samples);

}  // namespace examples
