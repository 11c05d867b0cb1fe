#include "support/shader_run.hpp"

#include <cstddef>
#include <span>

#include "source.hpp"
#include "support/hlsl.hpp"

namespace shader_run {

namespace {

using bumpshadow::texture_kind;

constexpr const char* input_names[4] = {"a", "b", "c", "d"};

struct type_names {
    const char *sampler, *hlsl_texture, *coordinate, *texel;
};

type_names types_of(texture_kind kind) {
    switch (kind) {
        case texture_kind::flat: return {"sampler2D", "Texture2D", "vec2", "ivec2"};
        case texture_kind::array: return {"sampler2DArray", "Texture2DArray", "vec3", "ivec3"};
        case texture_kind::cube: return {"samplerCube", "TextureCube", "vec3", nullptr};
        case texture_kind::volume: return {"sampler3D", "Texture3D", "vec3", "ivec3"};
    }
    return {};
}

std::string glsl_texture(const std::string& name, texture_kind kind) {
    const type_names types = types_of(kind);
    std::string text = std::string("uniform ") + types.sampler + ' ' + name + ";\nvec4 sample_" + name + '(' +
                       types.coordinate + " at, float level) { return textureLod(" + name + ", at, level); }\n";
    if (types.texel != nullptr)
        text += "vec4 fetch_" + name + '(' + types.texel + " at, int level) { return texelFetch(" + name +
                ", at, level); }\n";
    return text;
}

std::string hlsl_texture(const std::string& name, texture_kind kind, int slot) {
    const type_names types = types_of(kind);
    const std::string sampler = name + "_sampler", number = std::to_string(slot);
    const auto translated = [](const char* type) { return shaders::hlsl(type); };
    std::string text = std::string(types.hlsl_texture) + ' ' + name + " : register(t" + number + ");\nSamplerState " +
                       sampler + " : register(s" + number + ");\nfloat4 sample_" + name + '(' +
                       translated(types.coordinate) + " at, float level) { return " + name + ".SampleLevel(" + sampler +
                       ", at, level); }\n";
    if (types.texel != nullptr)
        text += "float4 fetch_" + name + '(' + translated(types.texel) + " at, int level) { return " + name + ".Load(" +
                (kind == texture_kind::flat ? "int3" : "int4") + "(at, level)); }\n";
    return text;
}

// Declarations up to and including the beginning of main, in GLSL.
std::string glsl_opening(const job& what, const backend& with) {
    std::string text(with.header);
    if (with.runs_on == gl::api::es) text += es_precision;
    text += what.functions;
    for (const auto& [name, texture, how] : what.textures) text += glsl_texture(name, texture.layout.kind);
    for (int i = 0; i < 4; ++i)
        if (!what.inputs[i].empty()) text += std::string("uniform sampler2D input_") + input_names[i] + ";\n";
    text += "out uvec4 result_bits;\nvoid main() {\n    ivec2 at = ivec2(gl_FragCoord.xy);\n";
    for (int i = 0; i < 4; ++i) {
        const std::string name = input_names[i];
        text += "    vec4 " + name + " = " +
                (what.inputs[i].empty() ? "vec4(0.0f)" : "texelFetch(input_" + name + ", at, 0)") + ";\n";
    }
    return text + "    vec4 result = vec4(0.0f);\n";
}

std::string hlsl_opening(const job& what) {
    std::string text = what.functions;
    int slot = 4;
    for (const auto& [name, texture, how] : what.textures) text += hlsl_texture(name, texture.layout.kind, slot++);
    for (int i = 0; i < 4; ++i)
        if (!what.inputs[i].empty())
            text += std::string("Texture2D input_") + input_names[i] + " : register(t" + std::to_string(i) + ");\n";
    text += "uint4 main(float4 position : SV_Position) : SV_Target0 {\n    int2 at = int2(position.xy);\n";
    for (int i = 0; i < 4; ++i) {
        const std::string name = input_names[i];
        text += "    float4 " + name + " = " +
                (what.inputs[i].empty() ? "float4(0.0f, 0.0f, 0.0f, 0.0f)" : "input_" + name + ".Load(int3(at, 0))") +
                ";\n";
    }
    return text + "    float4 result = float4(0.0f, 0.0f, 0.0f, 0.0f);\n";
}

}  // namespace

const gl::context& context_of(const backend& with) {
    if (with.runs_on == gl::api::es) {
        static const gl::context es(gl::api::es);
        return es;
    }
    static const gl::context desktop(gl::api::desktop);
    return desktop;
}

std::string missing(const backend& with) {
    if (with.source == language::hlsl && !hlsl::missing().empty()) return hlsl::missing();
    const std::string& error = context_of(with).error();
    return error.empty() ? error : std::string(with.name) + " does not run: " + error;
}

std::string source_of(const job& what, const backend& with) {
    if (with.source == language::hlsl)
        return hlsl_opening(what) + shaders::hlsl(what.body) + "\n    return asuint(result);\n}\n";
    return glsl_opening(what, with) + what.body + "\n    result_bits = floatBitsToUint(result);\n}\n";
}

gl::image run(const job& what, const backend& with) {
    std::string text = source_of(what, with);
    if (with.source == language::hlsl) {
        auto [error, glsl] = hlsl::to_glsl(text, "frag");
        if (!error.empty()) return {error + text, {}};
        text = std::move(glsl);
    }
    std::vector<gl::bound_texture> textures = what.textures;
    for (int i = 0; i < 4; ++i) {
        if (what.inputs[i].empty()) continue;
        bumpshadow::texture_layout layout;
        layout.format = bumpshadow::texel_format::rgba32f;
        layout.extent = what.extent;
        bumpshadow::sampler how;
        how.texels = bumpshadow::filter_mode::point;
        textures.push_back(
            {std::string("input_") + input_names[i], {std::as_bytes(std::span(what.inputs[i])), layout}, how});
    }
    return gl::run_fragment(context_of(with), text, what.extent, textures);
}

}  // namespace shader_run
