#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bumpshadow/shader/snippets.hpp>

#include "support/decoders.hpp"

// Whole shaders around the paste files and around what compose() writes, for the tests that compile them.
namespace shaders_under_test {

struct glsl_version {
    const char* name;
    // IN stands before the input of a fragment, UNIFORM(n) before the n-th sampler.
    const char* header;
    bool compute, vulkan;
};

// Where samplers are used, the lines that the head of the paste file names are added to the headers of ES.
inline constexpr glsl_version versions[] = {
    {"330", "#version 330 core\n#define IN in\n#define UNIFORM(n) uniform\n", false, false},
    {"450", "#version 450 core\n#define IN in\n#define UNIFORM(n) uniform\n", true, false},
    {"300 es", "#version 300 es\nprecision highp float;\n#define IN in\n#define UNIFORM(n) uniform\n", false, false},
    {"310 es", "#version 310 es\nprecision highp float;\n#define IN in\n#define UNIFORM(n) uniform\n", true, false},
    {"Vulkan",
     "#version 450\n#define IN layout(location = 0) in\n#define UNIFORM(n) layout(set = 0, binding = n) uniform\n",
     true, true},
};

// ---- Paste files ----

struct setting {
    const char* name;  // of a switch, without BUMPSHADOW_
    int count;         // its values are 0 to count - 1
};
inline constexpr setting settings[] = {{"BEARING", 5}, {"QUANTITY", 3}, {"EDGE", 3}, {"BELOW", 2}, {"SAMPLE", 2}};

struct variant {
    std::string name;
    std::string defines;
    bool samples;
};

// Every value of every switch, one at a time, without the sampling functions and with them; nothing defined at all.
[[nodiscard]] std::vector<variant> every_variant();
// Values that switches do not have: one too small and one too large for each.
[[nodiscard]] std::vector<variant> wrong_variants();

[[nodiscard]] std::string paste_file(bool hlsl);
// Statements of precision that the head of the paste file asks for in GLSL ES.
[[nodiscard]] std::string es_precision();

// A fragment shader that calls every short name and, where `samples`, every sampling function.
[[nodiscard]] std::string pasted_glsl(const variant& v, const glsl_version& version);
// Two entry points: pixel and vertex, the second of which calls no sampling function.
[[nodiscard]] std::string pasted_hlsl(const variant& v);

// The paste file with both examples of its opening comment, completed.
[[nodiscard]] std::string example_glsl(const glsl_version& version);
[[nodiscard]] std::string example_hlsl();

// ---- compose() ----

struct chosen {
    std::string name;
    const decoders::use* use;
    bumpshadow::shader_text::choice choice;
};

// Every decoder, and every bearing, quantity, edge and form of storage, one at a time.
[[nodiscard]] std::vector<chosen> every_choice();

[[nodiscard]] std::string composed(const chosen& what, bool hlsl);
// Statements that use it: they set the vec4 `sum` from the vec4 `value`, with a function `three` of it.
[[nodiscard]] std::string composed_body(const chosen& what);
[[nodiscard]] std::string composed_glsl(const chosen& what, const glsl_version& version);
// One entry point: pixel.
[[nodiscard]] std::string composed_hlsl(const chosen& what);

}  // namespace shaders_under_test
