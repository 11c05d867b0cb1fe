#pragma once

#include <span>
#include <string>
#include <vector>

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

// Numbers under headings; not-a-number where a line has none.
struct grid {
    struct line {
        std::string name;
        std::vector<double> values;
    };
    std::string title;
    std::vector<std::string> columns;
    std::vector<line> lines;
};

// A claim, and whether it held.
struct check {
    std::string what;
    double value = 0.0;
    bool held = false;
};

[[nodiscard]] std::string text_of(const table& t, std::span<const std::string> maps);

[[nodiscard]] std::string text_of(const grid& g);

[[nodiscard]] std::string json_of(std::span<const std::string> maps, int texels, std::span<const table> tables,
                                  std::span<const grid> grids, const speeds& speed, std::span<const check> checks);

}  // namespace examples
