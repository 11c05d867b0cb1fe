#pragma once

#include <span>
#include <string>
#include <vector>

#include "shader_cost/cases.hpp"
#include "shader_cost/cost.hpp"

namespace examples {

struct measured_case {
    shader_case which;
    std::vector<cost> costs;  // one a family; all but registers net of the empty shader
};

// A bar that the project sets itself, in inverse throughput on navi21.
struct cost_bar {
    std::string what, name;  // name of the case: "group, name"
    int limit = 0, value = 0;
    [[nodiscard]] bool held() const { return value <= limit; }
};

// navi21: index among the families.
[[nodiscard]] std::vector<cost_bar> bars_of(std::span<const measured_case> all, std::size_t navi21);

// A table in Markdown for one family.
[[nodiscard]] std::string table_of(std::span<const measured_case> all, std::size_t family_index);

// Everything as one JSON object.
[[nodiscard]] std::string json_of(std::span<const family> families, std::span<const cost> empty,
                                  std::span<const measured_case> all, std::span<const cost_bar> bars);

}  // namespace examples
