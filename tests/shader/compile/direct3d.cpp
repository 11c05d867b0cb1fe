// Every snippet through Microsoft's compilers, which are stricter than glslang: Windows libraries, for example those in
// dist/win32-x64 of the npm package webgpu, called under Wine.

#include <cstdlib>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/calls.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

namespace {

// What Windows libraries need here, as a sentence; empty: nothing is missing.
std::string missing() {
    const char* const folder = std::getenv("BUMPSHADOW_HLSL_COMPILERS");
    if (folder == nullptr)
        return "BUMPSHADOW_HLSL_COMPILERS names no folder with d3dcompiler_47.dll and dxcompiler.dll";
    for (const char* name : {"env", "wine", "x86_64-w64-mingw32-g++"})
        if (tool::find(name).empty()) return std::string("no ") + name + " on PATH";
    return {};
}

struct target {
    const char *entry, *profile;
};

constexpr target fxc[] = {{"pixel", "ps_4_0"},  {"pixel", "ps_5_0"},  {"pixel", "ps_5_1"},
                          {"vertex", "vs_4_0"}, {"vertex", "vs_5_0"}, {"compute", "cs_5_0"}};
constexpr target dxc[] = {
    {"pixel", "ps_6_0"}, {"pixel", "ps_6_6"}, {"vertex", "vs_6_0"}, {"compute", "cs_6_0"}, {"compute", "cs_6_6"}};

// program: d3d_program.cpp, built; library: one of Microsoft's.
void check_targets(const std::string& program, const std::string& library, const std::string& file,
                   std::span<const target> targets) {
    if (!std::ifstream(library)) return skip::because("no " + library);
    // A Wine of its own, which neither asks for what it lacks nor puts its own library in place of Microsoft's.
    std::vector<std::string> words = {tool::find("env").string(), std::string("WINEPREFIX=") + BUMPSHADOW_WINE_FOLDER,
                                      "WINEDEBUG=-all", "WINEDLLOVERRIDES=d3dcompiler_47=n;mscoree,mshtml="};
    words.insert(words.end(), {tool::find("wine").string(), program, library, file});
    for (const target& t : targets) words.insert(words.end(), {t.entry, t.profile});
    const tool::outcome result = tool::run(words);
    CHECK_MESSAGE(result.good, library, ": ", result.output);
    // A line for each, so that a program that does nothing does not pass.
    for (const target& t : targets)
        CHECK_MESSAGE(result.output.find(std::string(t.profile) + ": compiled") != std::string::npos, result.output);
}

}  // namespace

// Shader models 4 and 5 by FXC, 6 by DXC, as programs that use Direct3D call them.
TEST_CASE("HLSL with FXC and DXC, warnings as errors") {
    if (const std::string why = missing(); !why.empty()) return skip::because("FXC and DXC: " + why);
    const tool::folder folder;
    const std::string program = (folder / "d3d.exe").string(), file = (folder / "shader.hlsl").string();
    const tool::outcome built =
        tool::run({tool::find("x86_64-w64-mingw32-g++").string(), "-std=c++17", "-O1", "-static", "-o", program,
                   std::string(BUMPSHADOW_TESTS_FOLDER) + "/shader/compile/d3d_program.cpp"});
    REQUIRE_MESSAGE(built.good, built.output);
    tool::write(file, calls::hlsl_of(calls::read()));
    const std::string libraries = std::getenv("BUMPSHADOW_HLSL_COMPILERS");
    check_targets(program, libraries + "/d3dcompiler_47.dll", file, fxc);
    check_targets(program, libraries + "/dxcompiler.dll", file, dxc);
}
