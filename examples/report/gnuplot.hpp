#pragma once

#include <filesystem>
#include <string>

#include "report/plots.hpp"

namespace examples {

// A script for gnuplot 5 that reads NAME.dat and draws NAME.svg, from the folder they lie in.
[[nodiscard]] std::string script_of(const plot& p);

// Its data: a block for each series, one for each series' members of the front, and one for the front.
[[nodiscard]] std::string data_of(const plot& p);

// Draws NAME.svg in the folder that holds the script. False where gnuplot fails; then there is no NAME.svg.
[[nodiscard]] bool draw(const std::string& gnuplot, const std::filesystem::path& folder, const plot& p);

}  // namespace examples
