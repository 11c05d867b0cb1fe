// The shaders through Microsoft's compilers, which are stricter than glslang: Windows libraries, for example those in
// dist/win32-x64 of the npm package webgpu, called under Wine.

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/calls.hpp"
#include "shader/compile/shaders.hpp"
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

// A shader to compile: file, entry point, profile.
struct job {
    std::string file, entry, profile;
};

// d3d_program.cpp, built, with a folder for the shaders.
struct compilers {
    tool::folder folder;
    std::string program = (folder / "d3d.exe").string();
    int files = 0;

    compilers() {
        const tool::outcome built =
            tool::run({tool::find("x86_64-w64-mingw32-g++").string(), "-std=c++17", "-O1", "-static", "-o", program,
                       std::string(BUMPSHADOW_TESTS_FOLDER) + "/shader/compile/d3d_program.cpp"});
        REQUIRE_MESSAGE(built.good, built.output);
    }

    [[nodiscard]] std::string write(const std::string& text) {
        std::string file = (folder / (std::to_string(files++) + ".hlsl")).string();
        tool::write(file, text);
        return file;
    }

    // library: one of Microsoft's.
    [[nodiscard]] tool::outcome run(const std::string& library, const std::vector<job>& jobs) const {
        // A Wine of its own, which neither asks for what it lacks nor puts its own library in place of Microsoft's.
        std::vector<std::string> words = {tool::find("env").string(),
                                          std::string("WINEPREFIX=") + BUMPSHADOW_WINE_FOLDER, "WINEDEBUG=-all",
                                          "WINEDLLOVERRIDES=d3dcompiler_47=n;mscoree,mshtml="};
        words.insert(words.end(), {tool::find("wine").string(), program, library});
        for (const job& j : jobs) words.insert(words.end(), {j.file, j.entry, j.profile});
        return tool::run(words);
    }

    void check(const std::string& library, const std::vector<job>& jobs) const {
        const tool::outcome result = run(library, jobs);
        CHECK_MESSAGE(result.good, library, ": ", result.output);
        // A line for each, so that a program that does nothing does not pass.
        for (const job& j : jobs)
            CHECK_MESSAGE(result.output.find(j.file + ' ' + j.profile + ": compiled") != std::string::npos,
                          result.output);
    }
};

// FXC for shader models 4 and 5, DXC for 6, as programs that use Direct3D call them; empty: there is none.
std::string library(bool fxc) {
    const char* const folder = std::getenv("BUMPSHADOW_HLSL_COMPILERS");
    std::string path = std::string(folder) + (fxc ? "/d3dcompiler_47.dll" : "/dxcompiler.dll");
    if (std::ifstream(path)) return path;
    skip::because("no " + path);
    return {};
}

}  // namespace

TEST_CASE("every snippet with FXC and DXC, warnings as errors") {
    if (const std::string why = missing(); !why.empty()) return skip::because("FXC and DXC: " + why);
    constexpr const char* targets[2][6][2] = {
        {{"pixel", "ps_6_0"}, {"pixel", "ps_6_6"}, {"vertex", "vs_6_0"}, {"compute", "cs_6_0"}, {"compute", "cs_6_6"}},
        {{"pixel", "ps_4_0"},
         {"pixel", "ps_5_0"},
         {"pixel", "ps_5_1"},
         {"vertex", "vs_4_0"},
         {"vertex", "vs_5_0"},
         {"compute", "cs_5_0"}}};
    compilers with;
    const std::string file = with.write(calls::hlsl_of(calls::read()));
    for (const bool fxc : {true, false}) {
        std::vector<job> jobs;
        for (const auto& [entry, profile] : targets[fxc ? 1 : 0])
            if (entry != nullptr) jobs.push_back({file, entry, profile});
        if (const std::string name = library(fxc); !name.empty()) with.check(name, jobs);
    }
}

TEST_CASE("the paste file and what is composed, with FXC and DXC, warnings as errors") {
    if (const std::string why = missing(); !why.empty()) return skip::because("FXC and DXC: " + why);
    using namespace shaders_under_test;
    compilers with;
    for (const bool fxc : {true, false}) {
        const std::string name = library(fxc), pixel = fxc ? "ps_5_0" : "ps_6_0", vertex = fxc ? "vs_5_0" : "vs_6_0";
        if (name.empty()) continue;
        std::vector<job> jobs;
        // Pixels may sample, vertices not.
        for (const variant& v : every_variant())
            jobs.push_back({with.write(pasted_hlsl(v)), v.samples ? "pixel" : "vertex", v.samples ? pixel : vertex});
        for (const chosen& c : every_choice()) jobs.push_back({with.write(composed_hlsl(c)), "pixel", pixel});
        jobs.push_back({with.write(example_hlsl()), "main", pixel});
        with.check(name, jobs);

        jobs.clear();
        for (const variant& v : wrong_variants()) jobs.push_back({with.write(pasted_hlsl(v)), "pixel", pixel});
        const tool::outcome refused = with.run(name, jobs);
        CHECK_MESSAGE(refused.output.find(": compiled") == std::string::npos, refused.output);
        for (const setting& s : settings)
            CHECK_MESSAGE(refused.output.find(std::string("BUMPSHADOW_") + s.name + " is 0") != std::string::npos,
                          refused.output);
    }
}
