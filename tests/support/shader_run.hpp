#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>

#include "support/gl.hpp"

// The same few lines of shader, run in every language.
namespace shader_run {

enum class language : unsigned char { glsl, hlsl };

struct backend {
    std::string_view name;
    language source;
    gl::api runs_on;
    std::string_view header;  // of the GLSL that runs
};

inline constexpr std::string_view es_precision =
    "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp sampler3D;\n"
    "precision highp sampler2DArray;\nprecision highp samplerCube;\n";

inline constexpr backend glsl_330{"GLSL 3.30", language::glsl, gl::api::desktop, "#version 330 core\n"};
inline constexpr backend glsl_450{"GLSL 4.50", language::glsl, gl::api::desktop, "#version 450 core\n"};
inline constexpr backend es_300{"GLSL ES 3.00", language::glsl, gl::api::es, "#version 300 es\n"};
inline constexpr backend es_310{"GLSL ES 3.10", language::glsl, gl::api::es, "#version 310 es\n"};
inline constexpr backend hlsl_450{"HLSL", language::hlsl, gl::api::desktop, "#version 450 core\n"};

inline constexpr backend all_backends[] = {glsl_330, glsl_450, es_300, es_310, hlsl_450};

struct job {
    // In the backend's own language.
    std::string functions;
    // Statements in the snippets' dialect, which is translated for HLSL. They set the vec4 `result` of the pixel (x,
    // y), an ivec2 called `at`, from the vec4s a, b, c, d of that pixel and from textures: for each there are
    // fetch_NAME(texel, level) and sample_NAME(coordinate, level). Texels are ivec3 for arrays (layer) and volumes (z),
    // else ivec2; a cube has no fetch. Coordinates are vec2 for flat textures, else vec3.
    std::string body;
    glm::ivec2 extent{0};
    // a, b, c, d, row by row; those that are empty are 0.
    std::vector<glm::vec4> inputs[4] = {};
    std::vector<gl::bound_texture> textures = {};
};

// Why a backend cannot run here; empty: it can.
[[nodiscard]] std::string missing(const backend& with);

// The context that the backend runs in, made when it is first needed.
[[nodiscard]] const gl::context& context_of(const backend& with);

// The whole fragment shader of a job, in the backend's language.
[[nodiscard]] std::string source_of(const job& what, const backend& with);

[[nodiscard]] gl::image run(const job& what, const backend& with);

}  // namespace shader_run
