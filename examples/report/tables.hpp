#pragma once

#include <string>
#include <vector>

#include "report/findings.hpp"

namespace examples {

// What a section found on one map. Columns that no record has are left out.
struct table {
    std::string map;
    std::string throughout;                      // set-up that all rows share, as a sentence; may be empty
    std::vector<std::vector<std::string>> rows;  // the first is the heading
    std::vector<std::string> skipped;            // set-ups and why
};

// The mean first, if there is one.
[[nodiscard]] std::vector<table> tables_of(const findings& all, const std::string& section);

// Heading of a table: the map, or what "mean" stands for.
[[nodiscard]] std::string title_of(const findings& all, const std::string& map);

}  // namespace examples
