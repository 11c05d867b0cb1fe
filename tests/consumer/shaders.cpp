#include <fstream>
#include <string>
#include <string_view>

#include <bumpshadow/shader/snippets.hpp>

#ifdef GLM_VERSION
#error "the shaders bring GLM along"
#endif

// The shaders without the library: text put together for one choice, and the files to paste.
int main() {
    using namespace bumpshadow;
    std::string text;
    shader_text::compose({.decode = shader_text::decoder::overlapping, .bearing = bearing_function::octant},
                         shader_text::dialect::hlsl, [&](std::string_view part) { text += part; });
    const bool composed = text.find("float bumpshadow_overlapping_horizon(float4 values") != std::string::npos &&
                          text.find("bumpshadow_bearing_cubic") == std::string::npos;
    const bool files =
        std::ifstream(SHADER_DIR "/bumpshadow.glsl").good() && std::ifstream(SHADER_DIR "/bumpshadow.hlsl").good();
    return composed && files ? 0 : 1;
}
