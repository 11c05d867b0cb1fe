#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// The single source of the shaders, include/bumpshadow/shader/*.h, taken apart.
namespace shaders {

// A function, or a structure that functions return, with the comment above it.
struct snippet {
    std::string name;
    std::string comment;     // lines, each with its end; may be empty
    std::string code;        // in GLSL, without BUMPSHADOW_FUNCTION
    std::vector<int> needs;  // indices of the snippets that it uses itself, ascending
};

struct section {
    std::string name;          // of the file, without extension
    std::string comment;       // at its top
    int first = 0, count = 0;  // its snippets
};

struct source {
    std::vector<section> sections;
    std::vector<snippet> snippets;  // each after those that it needs
};

// Reads the files that shader.hpp includes, in its order. Throws std::runtime_error that names file and line.
[[nodiscard]] source read_source(const std::filesystem::path& folder);

// Numbers without the f that C++ wants, which not every shading language takes after an exponent.
[[nodiscard]] std::string plain_numbers(std::string_view glsl);

// GLSL to HLSL: other names for types and functions.
[[nodiscard]] std::string hlsl(std::string_view glsl);

}  // namespace shaders
