#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmark/measure.hpp"

namespace examples {

// A claim about speed, error or memory, and whether it held on a map.
struct check {
    std::string map;
    std::string what;  // for example "default: mean error <= 0.15 degrees"
    double value = 0.0;
    bool held = false;
};

[[nodiscard]] std::vector<check> checks_of(const measurement& m);

// A table in Markdown.
[[nodiscard]] std::string table_of(const measurement& m);

// Everything as one JSON object.
[[nodiscard]] std::string json_of(std::span<const measurement> all, std::span<const check> checks);

}  // namespace examples
