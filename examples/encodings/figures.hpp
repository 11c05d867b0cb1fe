#pragma once

#include <string>
#include <vector>

namespace examples {

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

}  // namespace examples
