#pragma once

namespace stability {

// Heights that are not finite, or marked as missing: refused with the place of the first, or holes, and never spread.
// Prints a line for each question and returns how many were answered wrongly.
[[nodiscard]] int check_missing_heights();

}  // namespace stability
