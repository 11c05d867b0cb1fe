// Every snippet through glslang, as GLSL of every version and as HLSL. That they compile as C++, with GCC and Clang, is
// what the headers-alone test shows.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/calls.hpp"
#include "shader/compile/shaders.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

using shaders_under_test::glsl_version;
using shaders_under_test::versions;

namespace {

bool silent(const tool::outcome& result) { return result.good && result.output.find("WARNING") == std::string::npos; }

}  // namespace

TEST_CASE("the calls cover every function") {
    const calls::everything all = calls::read();
    const std::string body = calls::body_of(all);
    CHECK(all.functions.size() > 15);
    for (const calls::function& f : all.functions)
        CHECK_MESSAGE(body.find(' ' + f.name + '(') != std::string::npos, f.name);
}

TEST_CASE("GLSL of every version") {
    const std::string compiler = tool::find("glslangValidator").string();
    if (compiler.empty()) return skip::because("no glslangValidator on PATH");
    const calls::everything all = calls::read();
    const tool::folder folder;
    for (const glsl_version& version : versions) {
        for (const std::string stage : {"frag", "vert", "comp"}) {
            if (stage == "comp" && !version.compute) continue;
            const std::string file = (folder / ("shader." + stage)).string();
            tool::write(file, calls::glsl_of(all, version.header, stage));
            std::vector<std::string> words = {compiler, file};
            if (version.vulkan) words.insert(words.end(), {"-V", "-o", (folder / "shader.spv").string()});
            const tool::outcome result = tool::run(words);
            CHECK_MESSAGE(silent(result), version.name, " ", stage, ": ", result.output);
        }
    }
}

TEST_CASE("HLSL with glslang, which is lax") {
    const std::string compiler = tool::find("glslangValidator").string();
    if (compiler.empty()) return skip::because("no glslangValidator on PATH");
    const tool::folder folder;
    const std::string file = (folder / "shader.hlsl").string();
    tool::write(file, calls::hlsl_of(calls::read()));
    constexpr struct {
        const char *stage, *name;
    } entries[] = {{"frag", "pixel"}, {"vert", "vertex"}, {"comp", "compute"}};
    for (const auto& entry : entries) {
        for (const char* types : {"--hlsl-offsets", "--hlsl-enable-16bit-types"}) {
            const tool::outcome result = tool::run({compiler, "-D", "-V", types, "-S", entry.stage, "-e", entry.name,
                                                    "-o", (folder / "shader.spv").string(), file});
            CHECK_MESSAGE(silent(result), entry.stage, " ", types, ": ", result.output);
        }
    }
}
