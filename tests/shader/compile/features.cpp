// A switch that turns a feature off removes all of its instructions: what the SPIR-V optimizer leaves of a shader with
// the whole paste file is, instruction by instruction, what it leaves of one in which the feature was never written.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <bumpshadow/shader/snippets.hpp>

#include "shader/compile/shaders.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

namespace {

using namespace bumpshadow::shader_text;

// ---- Instructions ----

std::string missing() {
    for (const char* name : {"glslangValidator", "spirv-opt", "spirv-dis"})
        if (tool::find(name).empty()) return std::string("instructions are not compared: no ") + name + " on PATH";
    return {};
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// The instructions of a disassembled module's functions. Types, constants and variables are replaced by what they are,
// so that neither ids nor the order in which they are declared matters; other ids are numbered as they come.
std::vector<std::string> instructions_of(const std::string& assembly) {
    std::map<std::string, std::string> meaning;
    std::map<std::string, std::string> locations;
    std::vector<std::string> found;
    std::istringstream stream(assembly);
    bool in_function = false;
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> words = words_of(line);
        if (words.empty()) continue;
        std::string result;
        if (words.size() > 2 && words[1] == "=") {
            result = words[0];
            words.erase(words.begin(), words.begin() + 2);
        }
        if (words[0] == "OpDecorate" && words.size() > 3) locations[words[1]].append(words[2]).append(words[3]) += ' ';
        if (words[0] == "OpFunction") in_function = true;
        std::string text;
        for (const std::string& word : words) {
            if (!word.starts_with('%')) {
                text.append(word) += ' ';
                continue;
            }
            // A branch may name a label before it comes.
            if (in_function) meaning.try_emplace(word, '#' + std::to_string(meaning.size()));
            text.append(meaning[word]) += ' ';
        }
        if (!in_function && !result.empty()) meaning[result] = '(' + text + locations[result] + ')';
        if (in_function && !result.empty()) {
            meaning.try_emplace(result, '#' + std::to_string(meaning.size()));
            text.insert(0, meaning[result] + " = ");
        }
        if (in_function) found.push_back(text);
    }
    // Numbers start after those of the module's own ids, of which there may be more here than there.
    std::map<std::string, std::string> numbers;
    for (std::string& text : found) {
        std::string renumbered;
        for (const std::string& word : words_of(text)) {
            const bool id = word.starts_with('#');
            if (id) numbers.try_emplace(word, '#' + std::to_string(numbers.size()));
            renumbered.append(id ? numbers[word] : word) += ' ';
        }
        text = renumbered;
    }
    return found;
}

// Compiled for Vulkan and optimized; each shader once.
const std::vector<std::string>& optimized(const std::string& shader) {
    static std::map<std::string, std::vector<std::string>> known;
    if (const auto at = known.find(shader); at != known.end()) return at->second;
    const tool::folder folder;
    const std::string source = (folder / "shader.frag").string(), binary = (folder / "shader.spv").string(),
                      small = (folder / "small.spv").string(), text = (folder / "small.txt").string();
    tool::write(source, shader);
    const tool::outcome compiled = tool::run({tool::find("glslangValidator").string(), "-V", "-o", binary, source});
    REQUIRE_MESSAGE(compiled.good, compiled.output, shader);
    const tool::outcome made =
        tool::run({tool::find("spirv-opt").string(), "--strip-debug", "-O", binary, "-o", small});
    REQUIRE_MESSAGE(made.good, made.output);
    const tool::outcome read =
        tool::run({tool::find("spirv-dis").string(), "--no-color", "--no-header", "--raw-id", small, "-o", text});
    REQUIRE_MESSAGE(read.good, read.output);
    return known[shader] = instructions_of(tool::read(text));
}

// ---- Shaders ----

std::string shader(const std::string& functions, const std::string& body) {
    return shaders_under_test::versions[4].header + functions +
           "layout(binding = 0) uniform sampler3D volume;\nIN vec4 value;\nlayout(location = 0) out vec4 color;\n"
           "void main() {\n    vec3 light = value.xyz;\n    float stored = texture(volume, value.zyx).r, k = value.w;\n"
           "    vec4 result = vec4(0.0);\n" +
           body + "    color = result;\n}\n";
}

std::string pasted(const std::string& defines, const std::string& body) {
    return shader(defines + shaders_under_test::paste_file(false), body);
}

// With the named functions alone, and what they call.
std::string written(const std::vector<std::string_view>& names, const std::string& body) {
    std::string functions;
    REQUIRE(compose(names, dialect::glsl, [&](std::string_view part) { functions += part; }));
    return shader(functions, body);
}

void check_same(const char* what, const std::string& with_switch, const std::string& never_written) {
    const std::vector<std::string>&a = optimized(with_switch), &b = optimized(never_written);
    std::printf("%-58s %3zu instructions, never written %3zu\n", what, a.size(), b.size());
    const std::size_t shorter = std::min(a.size(), b.size());
    std::size_t i = 0;
    while (i < shorter && a[i] == b[i]) ++i;
    CHECK_MESSAGE((i == a.size() && i == b.size()), what, ": differs from instruction ", i,
                  " on: ", (i < a.size() ? a[i] : "the end"), " is not ", (i < b.size() ? b[i] : "the end"));
}

constexpr const char* switched_shadow = "    result.x = bumpshadow_shadow(bumpshadow_level(light), stored, k);\n";

}  // namespace

TEST_CASE("what a switch turns off leaves no instruction") {
    if (const std::string why = missing(); !why.empty()) return skip::because(why);

    const std::string empty = shader("", "");
    check_same("pasted, nothing called", pasted("", ""), empty);
    check_same("SAMPLE 1, nothing called", pasted("#define BUMPSHADOW_SAMPLE 1\n", ""), empty);

    // Edges, by hand: with the light's slope, which no switch touches here.
    const auto edge = [](const char* factor) {
        return written({"bumpshadow_slope"},
                       std::string("    float level = bumpshadow_slope(light);\n    result.x = ") + factor + ";\n");
    };
    const auto defined = [](const char* defines) { return pasted(defines, switched_shadow); };
    check_same("EDGE 0: no penumbra", defined("#define BUMPSHADOW_EDGE 0\n"),
               edge("level >= max(0.0, stored) ? 1.0 : 0.0"));
    check_same("EDGE 1, BELOW 0: no test for lights below",
               defined("#define BUMPSHADOW_EDGE 1\n#define BUMPSHADOW_BELOW 0\n"),
               edge("min(max(0.0, min(k, 1e30) * (level - stored) + 1.0), 1.0)"));
    check_same("EDGE 2, BELOW 0: the same, centered",
               defined("#define BUMPSHADOW_EDGE 2\n#define BUMPSHADOW_BELOW 0\n"),
               edge("min(max(0.0, min(k, 1e30) * (level - stored) + 0.5), 1.0)"));
    check_same("EDGE 1, BELOW 1", defined(""),
               edge("level >= 0.0 ? min(max(0.0, min(k, 1e30) * (level - stored) + 1.0), 1.0) : 0.0"));
    check_same("EDGE 0, BELOW 0", defined("#define BUMPSHADOW_EDGE 0\n#define BUMPSHADOW_BELOW 0\n"),
               edge("level >= max(0.0, stored) ? 1.0 : 0.0"));
    check_same("SAMPLE 1, shadow alone", defined("#define BUMPSHADOW_SAMPLE 1\n"), defined(""));

    constexpr const char* bearings[] = {"bumpshadow_bearing_exact", "bumpshadow_bearing_quintic",
                                        "bumpshadow_bearing_cubic", "bumpshadow_bearing_octant",
                                        "bumpshadow_bearing_diamond"};
    for (int i = 0; i < 5; ++i)
        check_same(("BEARING " + std::to_string(i) + ": no other function").c_str(),
                   pasted("#define BUMPSHADOW_BEARING " + std::to_string(i) + '\n',
                          "    result.x = bumpshadow_bearing(light.xy);\n"),
                   written({bearings[i]}, std::string("    result.x = ") + bearings[i] + "(light.xy);\n"));
    for (int i = 0; i < 5; ++i) {
        const std::string name = std::string(bearings[i]).replace(11, 0, "vertex_");
        check_same(("BEARING " + std::to_string(i) + ", a vertex at a time").c_str(),
                   pasted("#define BUMPSHADOW_BEARING " + std::to_string(i) + '\n',
                          "    result.xy = bumpshadow_vertex_bearing(light, 4.0);\n"),
                   written({name}, "    result.xy = " + name + "(light, 4.0);\n"));
    }
    constexpr const char* levels[] = {"bumpshadow_slope", "bumpshadow_sine", "bumpshadow_angle"};
    for (int i = 0; i < 3; ++i)
        check_same(("QUANTITY " + std::to_string(i) + ": no other quantity").c_str(),
                   pasted("#define BUMPSHADOW_QUANTITY " + std::to_string(i) + '\n',
                          "    result.x = bumpshadow_level(light);\n"),
                   written({levels[i]}, std::string("    result.x = ") + levels[i] + "(light);\n"));
}

TEST_CASE("what is composed costs what is pasted") {
    if (const std::string why = missing(); !why.empty()) return skip::because(why);
    const char* const body =
        "    float horizon = textureLod(volume, vec3(light.xy, bumpshadow_volume_coordinate("
        "bumpshadow_bearing(light.xy), 0.03125)), 0.0).r;\n"
        "    result.x = bumpshadow_shadow(bumpshadow_level(light), horizon, k);\n";
    std::string functions;
    compose(choice{}, dialect::glsl, [&](std::string_view part) { functions += part; });
    check_same("tangent volume, composed", pasted("", body), shader(functions, body));
    check_same("tangent volume, sampling function",
               pasted("#define BUMPSHADOW_SAMPLE 1\n",
                      "    float horizon = bumpshadow_sample_volume(volume, light.xy, light, 0.03125);\n"
                      "    result.x = bumpshadow_shadow(bumpshadow_level(light), horizon, k);\n"),
               pasted("", body));
    functions.clear();
    compose(choice{.decode = decoder::flat}, dialect::glsl, [&](std::string_view part) { functions += part; });
    check_same(
        "one slice, composed: no bearing", shader(functions, switched_shadow),
        written({"bumpshadow_slope"},
                "    float level = bumpshadow_slope(light);\n"
                "    result.x = level >= 0.0 ? min(max(0.0, min(k, 1e30) * (level - stored) + 1.0), 1.0) : 0.0;\n"));
    functions.clear();
    compose(choice{.decode = decoder::arc}, dialect::glsl, [&](std::string_view part) { functions += part; });
    check_same("arc, sampling function",
               pasted("#define BUMPSHADOW_SAMPLE 1\n",
                      "    result.x = bumpshadow_sample_arc(volume, light.xy, light, 0.2, 1.6, -0.3);\n"),
               shader(functions,
                      "    float w = 1.6 * fract(bumpshadow_bearing(light.xy) - 0.2) - 0.3;\n"
                      "    result.x = textureLod(volume, vec3(light.xy, w), 0.0).r;\n"));
    functions.clear();
    compose(choice{.decode = decoder::fourier_3, .square_root = false}, dialect::glsl,
            [&](std::string_view part) { functions += part; });
    const char* const fourier =
        "    vec4 texel = bumpshadow_fourier_texel(value, vec4(2.0), vec4(-1.0));\n"
        "    result.x = bumpshadow_fourier_3(texel.xyz, bumpshadow_fourier_direction(light.xy));\n";
    check_same("Fourier, no roots", shader(functions, fourier),
               written({"bumpshadow_fourier_direction"},
                       "    vec4 texel = value * vec4(2.0) + vec4(-1.0);\n"
                       "    vec2 direction = bumpshadow_fourier_direction(light.xy);\n"
                       "    result.x = texel.z + texel.x * direction.x + texel.y * direction.y;\n"));
}

// Counting that could not tell would be worth nothing.
TEST_CASE("what a switch turns on has instructions") {
    if (const std::string why = missing(); !why.empty()) return skip::because(why);
    const auto count = [](const char* defines) { return optimized(pasted(defines, switched_shadow)).size(); };
    CHECK(count("") > count("#define BUMPSHADOW_BELOW 0\n"));
    CHECK(count("#define BUMPSHADOW_BELOW 0\n") > count("#define BUMPSHADOW_EDGE 0\n"));
    CHECK(count("#define BUMPSHADOW_QUANTITY 1\n") > count(""));
    CHECK(optimized(pasted("#define BUMPSHADOW_EDGE 1\n", switched_shadow)) !=
          optimized(pasted("#define BUMPSHADOW_EDGE 2\n", switched_shadow)));
}
