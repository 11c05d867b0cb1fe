#pragma once

#include <string>
#include <string_view>
#include <vector>

// Shaders that call every snippet, with arguments that no compiler knows, so that none is dropped unseen.
namespace calls {

struct variable {
    std::string type, name;
};

struct function {
    std::string result, name;
    std::vector<std::string> parameters;  // types
};

struct structure {
    std::string name;
    std::vector<variable> members;
};

struct everything {
    std::string code;
    std::vector<function> functions;
    std::vector<structure> structures;
};

// The snippets as shader.hpp lists them.
[[nodiscard]] everything read();

// Statements with a vec4 `value` that call every function; they set the vec4 `sum`.
[[nodiscard]] std::string body_of(const everything& all);

// A whole shader; stage: frag, vert or comp. IN, a macro of the header, stands before the input of a fragment.
[[nodiscard]] std::string glsl_of(const everything& all, std::string_view header, std::string_view stage);

// Three entry points: pixel, vertex, compute.
[[nodiscard]] std::string hlsl_of(const everything& all);

}  // namespace calls
