#pragma once

#include <span>
#include <string>
#include <vector>

#include "encodings/figures.hpp"
#include "encodings/speed.hpp"

namespace examples {

// A line of the table.
struct row {
    std::string name;
    double bytes = 0.0;
    int fetches = 0;
    std::vector<double> mismatch;  // of each map, in percent; empty: skipped
    double mean = 0.0;
    double ratio = 0.0;   // to the mean of Lengyel's layout
    std::string skipped;  // why
};

struct table {
    std::string title;
    std::vector<row> rows;
};

[[nodiscard]] std::string text_of(const table& t, std::span<const std::string> maps);

[[nodiscard]] std::string text_of(const grid& g);

[[nodiscard]] std::string json_of(std::span<const std::string> maps, int texels, std::span<const table> tables,
                                  std::span<const grid> grids, const speeds& speed, std::span<const check> checks);

}  // namespace examples
