#pragma once

#include <optional>
#include <string>
#include <vector>

namespace examples {

// The first program of this name in PATH.
[[nodiscard]] std::optional<std::string> find_tool(const std::string& name);

// Runs a program, without showing what it says. False where it does not end with 0. Words may hold blanks.
[[nodiscard]] bool run_tool(const std::string& program, const std::vector<std::string>& words);

}  // namespace examples
