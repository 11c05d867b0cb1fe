#pragma once

#include "encodings/report.hpp"
#include "encodings/sample.hpp"

namespace examples {

// Points of a triangle that are lit or shadowed wrongly where the light is interpolated from its vertices, in percent:
// 16 slices in R8, hard edge, equilateral triangles of several sizes and turns under a point light.
[[nodiscard]] grid measure_triangles(const sample_map& map);

}  // namespace examples
