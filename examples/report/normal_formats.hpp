#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <bumpshadow/normal_map.hpp>

namespace examples {

// A normal map as textures hold it.
struct stored_normals {
    std::string name, format;
    std::vector<float> planes;  // decoded, as bumpshadow::normal_map
    double bytes = 0.0;         // of all of the map, palette included
    int entries = 0;            // of a palette
};

// In bytes or in blocks; x and y and z, or x and y with z from them. Texels repeat beyond the border of a map whose
// sides are no multiples of a block's. Throw failure.
[[nodiscard]] stored_normals normals_as_rgb(const bumpshadow::normal_map& normals);
[[nodiscard]] stored_normals normals_as_xy(const bumpshadow::normal_map& normals);
[[nodiscard]] stored_normals normals_as_bc1(const bumpshadow::normal_map& normals);
[[nodiscard]] stored_normals normals_as_bc5(const bumpshadow::normal_map& normals);

// A byte a texel into a palette of 256 colors of four bytes: the colors that occur, cut at their medians (Heckbert
// 1982) and improved by k-means (Lloyd 1982) in `rounds` rounds. Distances are those of the normals in space.
[[nodiscard]] stored_normals normals_as_palette(const bumpshadow::normal_map& normals, int rounds);

}  // namespace examples
