#pragma once

#include <span>

#include <bumpshadow/horizon_map.hpp>

#include "common/image.hpp"

namespace examples {

// One slice as gray: elevation of the horizon from 0 degrees (black) to 90 (white). Elevations show all of a steep map,
// where slopes would leave everything but the steepest texels black.
[[nodiscard]] image8 picture_of_slice(const bumpshadow::horizon_map& horizons, int bearing);

// Pictures of one size and kind in rows of `columns`, `gap` black pixels between them.
[[nodiscard]] image8 sheet(std::span<const image8> pictures, int columns, int gap = 0);

// Averages blocks of pixels so that the longer side has `longest` pixels at most; smaller pictures stay as they are.
[[nodiscard]] image8 shrink(const image8& picture, int longest);

}  // namespace examples
