#pragma once

#include <optional>
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

// A bar that the project sets itself, in inverse throughput on navi21; without a limit only shown beside the others.
struct cost_bar {
    std::string what, name;  // name of the case: "group, name"
    std::optional<int> limit;
    int least = 0;
    int value = 0, instructions = 0;
    [[nodiscard]] bool held() const { return !limit || (value >= least && value <= *limit); }
};

// navi21: index among the families.
[[nodiscard]] std::vector<cost_bar> bars_of(std::span<const measured_case> all, std::size_t navi21);

// A table in Markdown for one family.
[[nodiscard]] std::string table_of(std::span<const measured_case> all, std::size_t family_index);

// A line that says whether it held.
[[nodiscard]] std::string text_of(const cost_bar& bar);

// Everything as one JSON object. left_out: functions that no case calls.
[[nodiscard]] std::string json_of(std::span<const family> families, std::span<const cost> empty,
                                  std::span<const measured_case> all, std::span<const cost_bar> bars,
                                  std::span<const std::string> left_out);

}  // namespace examples
