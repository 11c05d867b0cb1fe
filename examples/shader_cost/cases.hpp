#pragma once

#include <span>
#include <string>
#include <vector>

#include "source.hpp"

namespace examples {

// A shader whose cost is asked for.
struct shader_case {
    std::string group, name;
    std::string textures;  // declarations, at bindings 0 to 6
    std::string result;    // type of what is stored: float, vec2, vec3 or mat3
    std::string body;      // from vec2 uv and vec3 light, per thread, and the constants of the harness
};

// What is subtracted: the harness around nothing. One for each type of result.
[[nodiscard]] shader_case empty_case(const std::string& result);

// From the papers. They do not call the project's snippets.
[[nodiscard]] std::vector<shader_case> yardsticks();

[[nodiscard]] std::vector<shader_case> snippet_cases();

// A shader of a recipe, and the cycles that plan() takes it for on navi21.
struct planned_case {
    shader_case which;
    double planned = 0.0;
};

// Recipes of every kind of texture with the bearing functions that plan() picks from.
[[nodiscard]] std::vector<planned_case> planned_cases();

// The whole compute shader, with the snippets that the case calls and no others. Throws std::runtime_error where one
// does not exist.
[[nodiscard]] std::string compose(const shader_case& one, const shaders::source& snippets);

// Functions of the snippets that no case contains, neither called by it nor by what it calls. Throws as compose() does.
[[nodiscard]] std::vector<std::string> left_out(std::span<const shader_case> cases, const shaders::source& snippets);

}  // namespace examples
