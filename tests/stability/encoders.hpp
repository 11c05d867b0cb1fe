#pragma once

#include "stability/cases.hpp"

namespace stability {

// Normals of a case, and its horizons packed and decoded again: how far they are from what they should be. Prints a
// line for each and returns how many are farther away than promised, or no number.
[[nodiscard]] int check_encoders(const stiff_case& one);

}  // namespace stability
