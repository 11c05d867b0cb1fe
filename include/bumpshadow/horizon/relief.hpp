#pragma once

#include <algorithm>
#include <limits>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/status.hpp>

// What relief horizons can be found of. Nothing here is public.
//
// Heights as the methods that work in float take them: above the reference, in lengths of the smaller texel side, so
// that neither units nor offsets cost digits, and no slope is much larger than the heights.
namespace bumpshadow::relief_detail {

inline constexpr float most_relief = 1e35f;        // slopes are less than ten times that
inline constexpr double most_exact_relief = 1e38;  // slopes of more may not fit into the floats of the output

[[nodiscard]] inline double smaller_side(glm::dvec2 texel_size) { return (std::min)(texel_size.x, texel_size.y); }

// Factor from a sample to such a height.
template <height_sample Sample>
[[nodiscard]] double height_in_texels(const height_map<Sample>& heights) {
    return unit_height(heights) / smaller_side(heights.texel_size);
}

// Of such heights, holes left out.
struct height_range {
    float lowest = (std::numeric_limits<float>::max)();
    float highest = std::numeric_limits<float>::lowest();
};

// Copies a row and widens the range by it. hole: what is written for one. True where the row has any.
template <height_sample Sample>
[[nodiscard]] bool copy_row(const height_map<Sample>& heights, int y, double reference, double scale, float hole,
                            float* to, height_range& range) {
    const Sample* const from = heights.samples + y * heights.row_stride;
    bool holes = false;
    float lowest = range.lowest, highest = range.highest;
    for (int x = 0; x < heights.extent.x; ++x) {
        const float h = float((double(from[x]) - reference) * scale);
        to[x] = h;
        lowest = h < lowest ? h : lowest;
        highest = h > highest ? h : highest;
    }
    if (heights.no_data) {
        lowest = range.lowest, highest = range.highest;
        for (int x = 0; x < heights.extent.x; ++x) {
            if (is_no_data(heights, from[x])) {
                to[x] = hole;
                holes = true;
            } else {
                lowest = (std::min)(lowest, to[x]);
                highest = (std::max)(highest, to[x]);
            }
        }
    }
    range.lowest = lowest;
    range.highest = highest;
    return holes;
}

// Beyond it slopes may overflow.
[[nodiscard]] inline status check(const height_range& range, float lowest = -most_relief) {
    if (range.lowest < lowest)
        return {error::out_of_range, "lowest height above reference_texel(), in texels", double(range.lowest),
                double(lowest)};
    if (range.highest > most_relief)
        return {error::out_of_range, "highest height above reference_texel(), in texels", double(range.highest),
                double(most_relief)};
    return {};
}

// The same for what works in double and stores floats.
template <height_sample Sample>
[[nodiscard]] status check(const height_map<Sample>& heights, const height_bounds<Sample>& bounds) {
    // On a map of nothing but holes the highest sample is below the lowest.
    const double relief = (double(bounds.highest()) - double(bounds.lowest())) * height_in_texels(heights);
    if (relief > most_exact_relief)
        return {error::out_of_range, "range of heights, in texels", relief, most_exact_relief};
    return {};
}

}  // namespace bumpshadow::relief_detail
