#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encodings/figures.hpp"
#include "encodings/sample.hpp"

namespace examples {

// Points of triangles that are lit or shadowed wrongly where the light is interpolated from the vertices.
struct triangle_figure {
    std::string form;   // what is interpolated
    std::string place;  // of the light, one unit above the plane: "45 degrees", or over a "vertex" or the "middle"
    double edge = 0.0;  // length of the triangles' edges
    double percent = 0.0;
    double interval = 0.0;  // half width of the 95 % confidence interval, in percent; triangles count as one each
    double points = 0.0;
};

// Against the same light at the point itself: 16 slices in R8, hard edge, equilateral triangles of several sizes and
// turns under a point light. By place and edge, then by form.
//   triangles: of each size, around the light. between: called triangle_pauses times on the way
[[nodiscard]] std::vector<triangle_figure> measure_triangles(const sample_map& map, int triangles = 480,
                                                             const std::function<void()>& between = {});
inline constexpr int triangle_pauses = 4;

[[nodiscard]] grid grid_of(const std::vector<triangle_figure>& figures);

}  // namespace examples
