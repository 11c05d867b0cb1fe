#pragma once

#include <string>
#include <string_view>

// HLSL that runs where OpenGL does: glslang compiles it to SPIR-V, spirv-cross makes GLSL 4.50 of that.
namespace hlsl {

// Which of the two programs is missing on this machine, as a sentence; empty: none.
[[nodiscard]] std::string missing();

struct translation {
    std::string error;  // what the programs printed; empty: it worked
    std::string glsl;
};

// stage: "frag" or "comp"; the entry point is main. Registers become bindings; a texture NAME becomes a sampler whose
// name gl::run_fragment and gl::run_compute know, if its sampler is called NAME_sampler.
[[nodiscard]] translation to_glsl(std::string_view text, std::string_view stage);

}  // namespace hlsl
