#include "shader/compile/shaders.hpp"

#include "source.hpp"
#include "support/tool.hpp"

namespace shaders_under_test {

namespace {

using bumpshadow::bearing_function;
using bumpshadow::quantity;
using bumpshadow::shader_text::choice;
using bumpshadow::shader_text::decoder;
using bumpshadow::shader_text::dialect;
using bumpshadow::shader_text::edge;

std::string define(const char* name, int value) {
    return std::string("#define BUMPSHADOW_") + name + ' ' + std::to_string(value) + '\n';
}

constexpr const char* short_names =
    "    vec3 light = vec3(value.x, value.y, value.z);\n"
    "    sum = vec4(bumpshadow_bearing(vec2(light.x, light.y)), bumpshadow_level(light),\n"
    "               bumpshadow_shadow(bumpshadow_level(light), value.w, 8.0f),\n"
    "               bumpshadow_vertex_bearing(light, value.w).y);\n";

constexpr const char* glsl_samplers =
    "UNIFORM(0) sampler3D volume;\nUNIFORM(1) sampler2DArray layers;\nUNIFORM(2) sampler2D first;\n"
    "UNIFORM(3) sampler2D second;\nUNIFORM(4) samplerCube cube;\n";
constexpr const char* glsl_samples =
    "    sum.x += bumpshadow_sample_volume(volume, value.xy, light, value.w);\n"
    "    sum.x += bumpshadow_sample_slices(layers, value.xy, light, value.w, 16.0f);\n"
    "    sum.x += bumpshadow_sample_arc(volume, value.xy, light, value.x, value.y, value.w);\n"
    "    sum.x += bumpshadow_sample_arc_slices(layers, value.xy, light, value.x, value.y, value.w, 5.0f);\n"
    "    sum.x += bumpshadow_sample_grouped(layers, value.xy, light, value.w, 16.0f);\n"
    "    sum.x += bumpshadow_sample_overlapping(layers, value.xy, light, value.w, 12.0f);\n"
    "    sum.x += bumpshadow_sample_sine_layers(layers, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_two_maps(first, second, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_with_cube(layers, cube, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_fourier_5(first, second, value.xy, light, value, value, value.xy);\n"
    "    sum.x += bumpshadow_sample_ssbump(first, value.xy, light);\n";

constexpr const char* hlsl_textures =
    "Texture3D volume : register(t0);\nTexture2DArray layers : register(t1);\nTexture2D first : register(t2);\n"
    "Texture2D second : register(t3);\nTextureCube cube : register(t4);\nSamplerState how : register(s0);\n";
constexpr const char* hlsl_samples =
    "    sum.x += bumpshadow_sample_volume(volume, how, value.xy, light, value.w);\n"
    "    sum.x += bumpshadow_sample_slices(layers, how, value.xy, light, value.w, 16.0f);\n"
    "    sum.x += bumpshadow_sample_arc(volume, how, value.xy, light, value.x, value.y, value.w);\n"
    "    sum.x += bumpshadow_sample_arc_slices(layers, how, value.xy, light, value.x, value.y, value.w, 5.0f);\n"
    "    sum.x += bumpshadow_sample_grouped(layers, how, value.xy, light, value.w, 16.0f);\n"
    "    sum.x += bumpshadow_sample_overlapping(layers, how, value.xy, light, value.w, 12.0f);\n"
    "    sum.x += bumpshadow_sample_sine_layers(layers, how, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_two_maps(first, second, how, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_with_cube(layers, cube, how, value.xy, light);\n"
    "    sum.x += bumpshadow_sample_fourier_5(first, second, how, value.xy, light, value, value, value.xy);\n"
    "    sum.x += bumpshadow_sample_ssbump(first, how, value.xy, light);\n";

// With the precisions that the paste file asks for in place of that of numbers alone.
std::string head(const glsl_version& version) {
    return decoders::replaced(version.header, "precision highp float;\n", es_precision());
}

std::string glsl_main(const std::string& body) {
    return "IN vec4 value;\nlayout(location = 0) out vec4 color;\nvoid main() {\n    vec4 sum;\n" + body +
           "    color = sum;\n}\n";
}

// Lines of the opening comment as code: those of a paragraph after the one that starts with `mark`, counted from 0.
std::string paragraph(const std::string& file, const char* mark, int number) {
    std::size_t at = file.find(std::string("// ") + mark);
    for (int i = 0; i <= number; ++i) at = file.find("\n//\n", at) + 4;
    std::string text;
    while (file.compare(at, 5, "//   ") == 0) {
        const std::size_t end = file.find('\n', at) + 1;
        text += file.substr(at + 2, end - at - 2);
        at = end;
    }
    return text;
}

// Functions and constants that the example takes from the shader that it stands for.
constexpr const char* surroundings =
    "float shadow_map_factor() { return 0.5; }\n"
    "const vec3 ambient = vec3(0.1, 0.1, 0.1);\nconst vec3 light_color = vec3(1.0, 0.9, 0.8);\n";

std::string examples(const std::string& file) {
    return paragraph(file, "Before:", 0) +
           "void vertex_part(VEC3 to_light, VEC3 tangent, VEC3 bitangent, VEC3 normal, float max_slope, out VEC2 "
           "pair,\n"
           "                 out float level) {\n" +
           paragraph(file, "A vertex at a time:", 0) +
           "}\nfloat pixel_part(VEC2 uv, VEC2 pair, float level, float max_slope) {\n    float shadow = 1.0;\n" +
           paragraph(file, "A vertex at a time:", 1) + "    return shadow;\n}\n";
}

// Declared below what was composed, which is to need nothing from above.
constexpr const char* three = "vec3 three(vec4 v) { return vec3(v.x, v.y, v.z); }\n";

}  // namespace

std::vector<variant> every_variant() {
    std::vector<variant> all = {{"no switch", "", false}};
    for (const setting& s : settings)
        for (int value = 0; value < s.count; ++value)
            for (const bool samples : {false, true}) {
                const bool is_sample = std::string_view(s.name) == "SAMPLE";
                if (is_sample && samples) continue;
                const std::string name = std::string(s.name) + ' ' + std::to_string(value);
                all.push_back({name + (samples ? ", SAMPLE 1" : ""),
                               define(s.name, value) + (is_sample ? "" : define("SAMPLE", samples ? 1 : 0)),
                               samples || (is_sample && value == 1)});
            }
    return all;
}

std::vector<variant> wrong_variants() {
    std::vector<variant> all;
    for (const setting& s : settings)
        for (const int value : {-1, s.count})
            all.push_back({std::string("BUMPSHADOW_") + s.name, define(s.name, value), false});
    return all;
}

std::string paste_file(bool hlsl) {
    return tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/bumpshadow.") + (hlsl ? "hlsl" : "glsl"));
}

std::string es_precision() {
    const std::string file = paste_file(false), opening = file.substr(0, file.find("// Switches"));
    std::string lines;
    for (std::size_t at = 0; (at = opening.find("precision ", at)) != std::string::npos;) {
        const std::size_t end = opening.find(';', at) + 1;
        lines += opening.substr(at, end - at) + '\n';
        at = end;
    }
    return lines;
}

std::string pasted_glsl(const variant& v, const glsl_version& version) {
    const std::string body = std::string(short_names) + (v.samples ? glsl_samples : "");
    return head(version) + v.defines + paste_file(false) + (v.samples ? glsl_samplers : "") + glsl_main(body);
}

std::string pasted_hlsl(const variant& v) {
    const std::string body = shaders::hlsl(short_names);
    const auto entry = [&](const char* head, const std::string& statements) {
        return std::string(head) + " {\n    float4 sum;\n" + statements + "    return sum;\n}\n";
    };
    return v.defines + paste_file(true) + (v.samples ? hlsl_textures : "") +
           entry("float4 pixel(float4 value : TEXCOORD0) : SV_Target0", body + (v.samples ? hlsl_samples : "")) +
           entry("float4 vertex(float4 value : POSITION) : SV_Position", body);
}

std::string example_glsl(const glsl_version& version) {
    const std::string file = paste_file(false);
    return head(version) + file + surroundings + decoders::replaced(examples(file), "VEC", "vec");
}

std::string example_hlsl() {
    const std::string file = paste_file(true);
    return file + decoders::replaced(shaders::hlsl(surroundings), "const", "static const") +
           decoders::replaced(examples(file), "VEC", "float");
}

std::vector<chosen> every_choice() {
    std::vector<chosen> all;
    for (const decoders::use& u : decoders::all()) {
        const auto add = [&](const std::string& name, const choice& c) { all.push_back({u.name + name, &u, c}); };
        add("", {.decode = u.decode});
        if (decoders::is_fourier(u.decode)) add(", roots", {.decode = u.decode, .square_root = true});
        if (u.bearing) add(", vertex", {.decode = u.decode, .vertex = true});
        if (u.decode != decoder::volume) continue;
        for (int i = 0; i < 5; ++i) {
            add(", bearing " + std::to_string(i), {.bearing = bearing_function(i)});
            add(", edge " + std::to_string(i), {.shadow = edge(i)});
        }
        for (int i = 0; i < 3; ++i) add(", quantity " + std::to_string(i), {.stored = quantity(i)});
    }
    return all;
}

std::string composed(const chosen& what, bool hlsl) {
    std::string text;
    bumpshadow::shader_text::compose(what.choice, hlsl ? dialect::hlsl : dialect::glsl,
                                     [&](std::string_view part) { text += part; });
    return text;
}

std::string composed_body(const chosen& what) {
    return "    vec3 light = vec3(value.x, value.y, value.z);\n    float result;\n" +
           decoders::body_of(*what.use, what.choice) + "    sum = vec4(result, result, result, result);\n";
}

std::string composed_glsl(const chosen& what, const glsl_version& version) {
    return version.header + composed(what, false) + three + glsl_main(composed_body(what));
}

std::string composed_hlsl(const chosen& what) {
    return composed(what, true) + shaders::hlsl(three) +
           "float4 pixel(float4 value : TEXCOORD0) : SV_Target0 {\n    float4 sum;\n" +
           shaders::hlsl(composed_body(what)) + "    return sum;\n}\n";
}

}  // namespace shaders_under_test
