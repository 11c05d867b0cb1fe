// The compute kernel that bakes horizons through glslang: as OpenGL, OpenGL ES and Vulkan take it, and as HLSL, each
// kind of dispatch alone too.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/skip.hpp"
#include "support/tool.hpp"

TEST_CASE("the compute kernel") {
    const std::string compiler = tool::find("glslangValidator").string();
    if (compiler.empty()) return skip::because("no glslangValidator on PATH");
    struct target {
        const char *file, *opening;
        std::vector<std::string> words;
    };
    const tool::folder folder;
    const std::string shader = (folder / "kernel.comp").string(), binary = (folder / "kernel.spv").string();
    const target targets[] = {
        {"bumpshadow_bake.glsl", "#version 430\n", {}},
        {"bumpshadow_bake.glsl", "#version 310 es\n", {}},
        {"bumpshadow_bake.glsl", "#version 450\n", {"-V", "-o", binary}},
        {"bumpshadow_bake.hlsl", "", {"-D", "-V", "-e", "main", "-o", binary}},
    };
    for (const target& t : targets) {
        const std::string text = tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/") + t.file);
        REQUIRE(text.size() > 1000);
        const auto compiled = [&](const std::string& switches) {
            tool::write(shader, t.opening + switches + text);
            std::vector<std::string> words = {compiler};
            words.insert(words.end(), t.words.begin(), t.words.end());
            words.push_back(shader);
            return tool::run(words);
        };
        for (int kind = -2; kind <= 5; ++kind) {
            const bool every = kind == -2, known = every || (kind >= 0 && kind < 5);
            const tool::outcome result =
                compiled(every ? "" : "#define BUMPSHADOW_BAKE_KIND " + std::to_string(kind) + "\n");
            const bool silent = result.output.find("WARNING") == std::string::npos;
            CHECK_MESSAGE((result.good && silent) == known, t.file, " ", t.opening, kind, ": ", result.output);
            const bool refused = result.output.find("BUMPSHADOW_BAKE_KIND is 0") != std::string::npos;
            CHECK_MESSAGE(refused != known, t.file, " ", t.opening, kind, ": ", result.output);
        }
    }
}
