#pragma once

#include <span>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/texture.hpp>

#include "encodings/sample.hpp"
#include "encodings/score.hpp"

// The way of a slice from a fit to a judgment in steps, so that setups which begin alike can share the beginning:
// fit, store, enlarge, judge.

namespace examples {

// Stored values in [0, 1] of slices, or of the channels of layers.
struct planes {
    glm::ivec2 extent{0};
    std::vector<std::vector<float>> values;  // [plane][y][x]
};

// Horizons that own their memory.
struct horizons {
    std::vector<float> values;
    bumpshadow::horizon_map view;
};

// At 1 / factor of the extent, averaged in the stored quantity.
[[nodiscard]] horizons reduced(const bumpshadow::horizon_map& slopes, const bumpshadow::horizon_scale& scale,
                               int factor);

[[nodiscard]] planes fit_planes(const bumpshadow::horizon_map& slopes, std::span<const glm::dvec2> directions,
                                const bumpshadow::slice_set& slices, const bumpshadow::horizon_scale& scale,
                                bumpshadow::slice_fit fit);

// What is left of the values in a format: r8, r16, r16f or bc4.
void pass_through(planes& p, bumpshadow::texel_format format);
// In BC4 blocks of stb_dxt.
void pass_through_stb(planes& p);

// What bilinear filtering, repeating, gives at the centers of the texels of a map of that extent.
[[nodiscard]] planes enlarged(const planes& small, glm::ivec2 extent);

// Slices, two of which are interpolated.
[[nodiscard]] score judge_slices(const sample_map& map, const planes& slices, const bumpshadow::slice_set& set,
                                 const bumpshadow::horizon_scale& scale, int margin = 0);

// Channels of layers, four planes each.
[[nodiscard]] score judge_layers(const sample_map& map, const planes& channels,
                                 const bumpshadow::slice_layers& encoding, int margin = 0);

}  // namespace examples
