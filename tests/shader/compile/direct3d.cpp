// The shaders through Microsoft's compilers, which are stricter than glslang: Windows libraries, called under Wine. The
// npm package webgpu has them in dist/win32-x64.

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/calls.hpp"
#include "shader/compile/shaders.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

namespace {

// Where the two libraries are looked for: in the folder that BUMPSHADOW_HLSL_COMPILERS names, or else where npm puts
// them at the top of the project.
std::string library_folder() {
    const char* const named = std::getenv("BUMPSHADOW_HLSL_COMPILERS");
    return named != nullptr ? named : BUMPSHADOW_TESTS_FOLDER "/../node_modules/webgpu/dist/win32-x64";
}

// FXC for shader models 4 and 5, DXC for 6, as programs that use Direct3D call them.
std::string library(bool fxc) { return library_folder() + (fxc ? "/d3dcompiler_47.dll" : "/dxcompiler.dll"); }

// What Windows libraries need here, as a sentence; empty: nothing is missing.
std::string missing(bool fxc) {
    const std::string what = fxc ? "FXC: no " : "DXC: no ";
    if (!std::ifstream(library(fxc))) return what + library(fxc) + " (see BUMPSHADOW_HLSL_COMPILERS in cmake/run.sh)";
    for (const char* name : {"env", "wine", "x86_64-w64-mingw32-g++"})
        if (tool::find(name).empty()) return what + name + " on PATH";
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

// Calls use(compilers, whether it is FXC) for each of the two that is here.
template <class Use>
void with_each(const Use& use) {
    std::optional<compilers> all;
    for (const bool fxc : {true, false}) {
        if (const std::string why = missing(fxc); !why.empty()) {
            skip::because(why);
            continue;
        }
        if (!all) all.emplace();
        use(*all, fxc);
    }
}

}  // namespace

TEST_CASE("every snippet with FXC and DXC, warnings as errors") {
    const std::vector<std::array<const char*, 2>> models_4_and_5 = {{"pixel", "ps_4_0"},  {"pixel", "ps_5_0"},
                                                                    {"pixel", "ps_5_1"},  {"vertex", "vs_4_0"},
                                                                    {"vertex", "vs_5_0"}, {"compute", "cs_5_0"}},
                                                  model_6 = {{"pixel", "ps_6_0"},
                                                             {"pixel", "ps_6_6"},
                                                             {"vertex", "vs_6_0"},
                                                             {"compute", "cs_6_0"},
                                                             {"compute", "cs_6_6"}};
    with_each([&](compilers& with, bool fxc) {
        const std::string file = with.write(calls::hlsl_of(calls::read()));
        std::vector<job> jobs;
        for (const auto& [entry, profile] : fxc ? models_4_and_5 : model_6) jobs.push_back({file, entry, profile});
        with.check(library(fxc), jobs);
    });
}

TEST_CASE("the compute kernel, whole and each kind of dispatch alone, with FXC and DXC, warnings as errors") {
    const std::string kernel = tool::read(BUMPSHADOW_SHADER_FOLDER "/bumpshadow_bake.hlsl");
    REQUIRE(kernel.size() > 1000);
    with_each([&](compilers& with, bool fxc) {
        std::vector<job> jobs;
        for (int kind = -1; kind < 5; ++kind) {
            const std::string alone = "#define BUMPSHADOW_BAKE_KIND " + std::to_string(kind) + "\n";
            const std::string file = with.write((kind < 0 ? std::string() : alone) + kernel);
            if (fxc) {
                jobs.push_back({file, "main", "cs_5_0"});
                jobs.push_back({file, "main", "cs_5_1"});
            } else {
                jobs.push_back({file, "main", "cs_6_0"});
                jobs.push_back({file, "main", "cs_6_6"});
            }
        }
        with.check(library(fxc), jobs);
    });
}

TEST_CASE("the paste file and what is composed, with FXC and DXC, warnings as errors") {
    using namespace shaders_under_test;
    with_each([&](compilers& with, bool fxc) {
        const std::string pixel = fxc ? "ps_5_0" : "ps_6_0", vertex = fxc ? "vs_5_0" : "vs_6_0";
        std::vector<job> jobs;
        // Pixels may sample, vertices not.
        for (const variant& v : every_variant())
            jobs.push_back({with.write(pasted_hlsl(v)), v.samples ? "pixel" : "vertex", v.samples ? pixel : vertex});
        for (const chosen& c : every_choice()) jobs.push_back({with.write(composed_hlsl(c)), "pixel", pixel});
        jobs.push_back({with.write(example_hlsl()), "main", pixel});
        with.check(library(fxc), jobs);

        jobs.clear();
        for (const variant& v : wrong_variants()) jobs.push_back({with.write(pasted_hlsl(v)), "pixel", pixel});
        const tool::outcome refused = with.run(library(fxc), jobs);
        CHECK_MESSAGE(refused.output.find(": compiled") == std::string::npos, refused.output);
        for (const setting& s : settings)
            CHECK_MESSAGE(refused.output.find(std::string("BUMPSHADOW_") + s.name + " is 0") != std::string::npos,
                          refused.output);
    });
}
