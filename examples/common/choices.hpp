#pragma once

#include <string>
#include <utility>
#include <vector>

#include <bumpshadow/choices.hpp>

namespace examples {

// The words of the command line and of JSON.
inline const std::vector<std::pair<std::string, bumpshadow::bearing_function>> bearing_function_names{
    {"exact", bumpshadow::bearing_function::exact},
    {"quintic", bumpshadow::bearing_function::quintic},
    {"cubic", bumpshadow::bearing_function::cubic},
    {"octant", bumpshadow::bearing_function::octant},
    {"diamond", bumpshadow::bearing_function::diamond}};

inline const std::vector<std::pair<std::string, bumpshadow::quantity>> quantity_names{
    {"slope", bumpshadow::quantity::slope},
    {"sine", bumpshadow::quantity::sine},
    {"angle", bumpshadow::quantity::angle}};

template <class Value>
[[nodiscard]] const char* word_of(const std::vector<std::pair<std::string, Value>>& words, Value value) {
    for (const auto& [word, meaning] : words)
        if (meaning == value) return word.c_str();
    return "";
}

}  // namespace examples
