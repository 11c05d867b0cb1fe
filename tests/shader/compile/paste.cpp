// The paste files and what compose() writes, as a shader author uses them, through glslang.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/shaders.hpp"
#include "support/scan.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

using namespace shaders_under_test;

namespace {

struct named_shader {
    std::string name, text;
};

std::string glslang() {
    std::string compiler = tool::find("glslangValidator").string();
    if (compiler.empty()) skip::because("no glslangValidator on PATH");
    return compiler;
}

bool silent(const tool::outcome& result) { return result.good && result.output.find("WARNING") == std::string::npos; }

// Fragment shaders of one version. One call for all where nothing is linked, and Vulkan links.
void check_glsl(const std::string& compiler, const glsl_version& version, const std::vector<named_shader>& all) {
    const tool::folder folder;
    std::vector<std::string> words = {compiler};
    for (const named_shader& shader : all) {
        const std::string file = (folder / (std::to_string(&shader - all.data()) + ".frag")).string();
        tool::write(file, shader.text);
        if (!version.vulkan) {
            words.push_back(file);
            continue;
        }
        const tool::outcome result = tool::run({compiler, "-V", "-o", (folder / "shader.spv").string(), file});
        CHECK_MESSAGE(silent(result), version.name, ", ", shader.name, ": ", result.output);
    }
    if (version.vulkan) return;
    const tool::outcome result = tool::run(words);
    CHECK_MESSAGE(silent(result), version.name, ", shaders in the order of the test: ", result.output);
}

tool::outcome run_hlsl(const std::string& compiler, const std::string& text, const char* stage, const char* entry) {
    const tool::folder folder;
    const std::string file = (folder / "shader.hlsl").string();
    tool::write(file, text);
    return tool::run({compiler, "-D", "-V", "-S", stage, "-e", entry, "-o", (folder / "shader.spv").string(), file});
}

std::size_t count(std::string_view text, std::string_view what) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; at += what.size()) ++found;
    return found;
}

// Names that do not carry the prefix, and variables, which snippets do not have.
std::vector<std::string> leaks(std::string_view text) {
    std::vector<std::string> names;
    for (const scan::definition& d : scan::definitions_of(text)) {
        const bool macro = d.what == scan::kind::macro;
        if (!d.name.starts_with(macro ? "BUMPSHADOW_" : "bumpshadow_") || d.what == scan::kind::variable)
            names.push_back(d.name);
    }
    return names;
}

// The same for a whole shader, whose buffers and entry point have names: in GLSL those of blocks and of their members.
std::vector<std::string> leaks_of_shader(std::string_view text) {
    std::vector<std::string> names;
    for (const scan::definition& d : scan::definitions_of(text)) {
        const bool macro = d.what == scan::kind::macro;
        if (!d.name.starts_with(macro ? "BUMPSHADOW_" : "bumpshadow_") && d.name != "main") names.push_back(d.name);
    }
    return names;
}

}  // namespace

TEST_CASE("the paste file in every version of GLSL, with every value of every switch") {
    const std::string compiler = glslang();
    if (compiler.empty()) return;
    for (const glsl_version& version : versions) {
        std::vector<named_shader> all;
        // With the sampling functions there is all that there is without them: both in one version is enough.
        for (const variant& v : every_variant())
            if (v.samples || v.name == "no switch" || std::string_view(version.name) == "450")
                all.push_back({v.name, pasted_glsl(v, version)});
        check_glsl(compiler, version, all);
    }
}

TEST_CASE("the paste file in HLSL, with every value of every switch") {
    const std::string compiler = glslang();
    if (compiler.empty()) return;
    for (const variant& v : every_variant()) {
        // Pixels may sample, vertices not.
        const tool::outcome result =
            run_hlsl(compiler, pasted_hlsl(v), v.samples ? "frag" : "vert", v.samples ? "pixel" : "vertex");
        CHECK_MESSAGE(silent(result), v.name, ": ", result.output);
    }
}

TEST_CASE("these shaders call every short name and every sampling function") {
    for (const bool hlsl : {false, true}) {
        const std::vector<scan::definition> all = scan::definitions_of(paste_file(hlsl));
        const variant with_samples = {"", "", true};
        const std::string shader = hlsl ? pasted_hlsl(with_samples) : pasted_glsl(with_samples, versions[0]);
        const std::string calls = shader.substr(shader.find("sum = "));
        std::size_t sampling = 0;
        for (const scan::definition& d : all) {
            const bool sample = d.name.starts_with("bumpshadow_sample_");
            sampling += sample ? 1 : 0;
            if (sample || d.name == "bumpshadow_bearing" || d.name == "bumpshadow_level" ||
                d.name == "bumpshadow_shadow" || d.name == "bumpshadow_vertex_bearing")
                CHECK_MESSAGE(calls.find(d.name + '(') != std::string::npos, d.name);
        }
        CHECK(sampling >= 9);
    }
}

TEST_CASE("a value that a switch does not have is refused") {
    const std::string compiler = glslang();
    if (compiler.empty()) return;
    const std::vector<variant> wrong = wrong_variants();
    const tool::folder folder;
    for (const glsl_version& version : versions) {
        if (version.vulkan) continue;
        std::vector<std::string> words = {compiler};
        for (const variant& v : wrong) {
            words.push_back((folder / (std::to_string(&v - wrong.data()) + ".frag")).string());
            tool::write(words.back(), pasted_glsl(v, version));
        }
        const tool::outcome result = tool::run(words);
        CHECK_FALSE(result.good);
        // Two wrong values of each, and the compiler says which switch it is.
        for (const setting& of : settings)
            CHECK_MESSAGE(count(result.output, std::string("BUMPSHADOW_") + of.name + " is 0") == 2, version.name, ", ",
                          result.output);
        CHECK(count(result.output, "No code generated") == wrong.size());
    }
    for (const variant& v : wrong) {
        if (v.defines.find('-') != std::string::npos) continue;  // the same test
        const tool::outcome result = run_hlsl(compiler, pasted_hlsl(v), "frag", "pixel");
        CHECK_FALSE(result.good);
        CHECK_MESSAGE(result.output.find(v.name + " is 0") != std::string::npos, "HLSL, ", v.defines, result.output);
    }
}

TEST_CASE("the precisions that the paste file asks for are those of floats and of all samplers that it takes") {
    const std::string lines = es_precision();
    CHECK(count(lines, "precision highp ") == count(lines, ";\n"));
    for (const char* type : {"float", "sampler2D", "sampler3D", "sampler2DArray", "samplerCube"}) {
        CHECK(count(lines, std::string("highp ") + type + ';') == 1);
    }
}

TEST_CASE("the examples of the opening comment compile") {
    const std::string compiler = glslang();
    if (compiler.empty()) return;
    CHECK(example_glsl(versions[0]).find("void main() {") != std::string::npos);
    CHECK(example_glsl(versions[0]).find("bumpshadow_pick_bearing(pair") != std::string::npos);
    for (const glsl_version& version : versions)
        if (!version.vulkan) check_glsl(compiler, version, {{"example", example_glsl(version)}});
    const tool::outcome result = run_hlsl(compiler, example_hlsl(), "frag", "main");
    CHECK_MESSAGE(silent(result), result.output);
}

TEST_CASE("what is composed for every choice compiles in every version") {
    const std::string compiler = glslang();
    if (compiler.empty()) return;
    for (const glsl_version& version : versions) {
        std::vector<named_shader> all;
        for (const chosen& c : every_choice()) all.push_back({c.name, composed_glsl(c, version)});
        check_glsl(compiler, version, all);
    }
    for (const chosen& c : every_choice()) {
        const tool::outcome result = run_hlsl(compiler, composed_hlsl(c), "frag", "pixel");
        CHECK_MESSAGE(silent(result), "HLSL, ", c.name, ": ", result.output);
    }
}

TEST_CASE("no name without the prefix leaks") {
    for (const bool hlsl : {false, true}) {
        const std::vector<std::string> pasted = leaks(paste_file(hlsl));
        CHECK_MESSAGE(pasted.empty(), (pasted.empty() ? "" : pasted[0]));
        for (const chosen& c : every_choice()) {
            const std::string text = composed(c, hlsl);
            const std::vector<std::string> names = leaks(text);
            CHECK_MESSAGE(names.empty(), c.name, ": ", (names.empty() ? "" : names[0]));
            CHECK(text.find('#') == std::string::npos);
        }
    }
    for (const char* name : {"bumpshadow_bake.glsl", "bumpshadow_bake.hlsl"}) {
        const std::string text = tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/") + name);
        const std::vector<std::string> names = leaks_of_shader(text);
        CHECK_MESSAGE(names.empty(), name, ": ", (names.empty() ? "" : names[0]));
        std::size_t blocks = 0;
        for (const scan::definition& d : scan::definitions_of(text)) blocks += d.name.ends_with("_block") ? 1 : 0;
        CHECK(blocks == (text.find("cbuffer") == std::string::npos ? 5 : 1));
    }
    // What would be found.
    CHECK(leaks_of_shader("precision highp float;\nlayout(local_size_x = 16, local_size_y = 4) in;\n"
                          "layout(std430, binding = 0) readonly buffer Heights { float heights[]; };\n"
                          "layout(std140, binding = 4) uniform Block { ivec4 bumpshadow_a, b; };\n") ==
          std::vector<std::string>{"Heights", "heights", "Block", "b"});
    CHECK(leaks_of_shader("StructuredBuffer<float> heights : register(t0);\n"
                          "cbuffer Block : register(b4) { int4 dispatch; };\n"
                          "[numthreads(16, 4, 1)]\nvoid kernel(uint3 id : SV_DispatchThreadID) { }\n") ==
          std::vector<std::string>{"heights", "Block", "dispatch", "kernel"});
    const char* const bad =
        "#define WIDTH 2\nfloat helper(float v) { return v; }\nstruct pair { float a, b; };\n"
        "const float bumpshadow_pi = 3.0f;\nfloat bumpshadow_fine() { float local = 1.0f; return local; }\n";
    CHECK(leaks(bad) == std::vector<std::string>{"WIDTH", "helper", "pair", "bumpshadow_pi"});
}
