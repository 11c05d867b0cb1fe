#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>

#include <bumpshadow/shader/shader.hpp>

#include "support/shader_run.hpp"

// Expressions in the snippets' dialect that a shader and C++ both compute, for the same inputs.
namespace expressions {

using glm::vec2;
using glm::vec3;
using glm::vec4;

// Whatever an expression gives, as four numbers.
[[nodiscard]] inline vec4 wide(bool v) { return {v ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f}; }
[[nodiscard]] inline vec4 wide(float v) { return {v, 0.0f, 0.0f, 0.0f}; }
[[nodiscard]] inline vec4 wide(vec2 v) { return {v.x, v.y, 0.0f, 0.0f}; }
[[nodiscard]] inline vec4 wide(vec3 v) { return {v.x, v.y, v.z, 0.0f}; }
[[nodiscard]] inline vec4 wide(vec4 v) { return v; }

struct expression {
    const char* text;
    float bound;  // what a shader may differ from C++, in units of max(1, |value|)
    vec4 (*evaluate)(const vec4 inputs[4]);
};

// One line a snippet: an expression of the vec4s a, b, c, d in the snippets' dialect.
//   EXPRESSION(1e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)))
// A structure is compared member by member: EXPRESSION(1e-6f, bumpshadow_factors(vec2(a.x, a.y)).layer0)
#define EXPRESSION(bound, ...)                                                                       \
    expressions::expression {                                                                        \
#__VA_ARGS__, bound, [](const glm::vec4 inputs[4]) {                                               \
            using namespace bumpshadow::shader;                                                            \
            [[maybe_unused]] const glm::vec4 a = inputs[0], b = inputs[1], c = inputs[2], d = inputs[3];   \
            return expressions::wide(__VA_ARGS__);                                                         \
        } \
    }

// Inputs of one evaluation.
struct inputs {
    vec4 values[4] = {};
};

// Every finite light of a set that has all hard cases, as (x, y, z, 0): all around at several elevations, along axes
// and diagonals, to the edges and corners of a cube, grazing, straight up and down, zero, below the surface, lengths
// from 1e-10 to 1e10, denormal components.
[[nodiscard]] std::vector<vec4> lights();

struct difference {
    float worst = 0.0f;  // infinite: one side is not finite
    inputs at;           // where
    vec4 expected{0.0f}, found{0.0f};
    float least = 0.0f, most = 0.0f;  // that the shader gave, of the first component
};

struct outcome {
    std::string error;
    std::vector<difference> differences;  // one for each expression
};

// Every snippet, in the language of a backend.
[[nodiscard]] std::string snippets(const shader_run::backend& with);

// Every expression at every input, of which there are at most 16384. A GPU may take denormal numbers for 0, so there
// either result will do.
[[nodiscard]] outcome compare(std::span<const expression> table, std::span<const inputs> at, std::string functions,
                              const shader_run::backend& with);

// The test: compares on every backend that runs here, prints what was found and checks it against the bounds. Returns
// an outcome for each of these backends.
std::vector<outcome> check(std::span<const expression> table, std::span<const inputs> at);

}  // namespace expressions
