#include "support/hlsl.hpp"

#include "support/tool.hpp"

namespace hlsl {

std::string missing() {
    for (const char* name : {"glslangValidator", "spirv-cross"})
        if (tool::find(name).empty()) return std::string("HLSL does not run: no ") + name + " on PATH";
    return {};
}

translation to_glsl(std::string_view text, std::string_view stage) {
    const tool::folder folder;
    const std::string source = (folder / "shader.hlsl").string(), binary = (folder / "shader.spv").string(),
                      result = (folder / "shader.glsl").string();
    tool::write(source, text);
    const tool::outcome compiled = tool::run({tool::find("glslangValidator").string(), "-D", "-V", "-S",
                                              std::string(stage), "-e", "main", "-o", binary, source});
    if (!compiled.good) return {compiled.output, {}};
    const tool::outcome translated =
        tool::run({tool::find("spirv-cross").string(), "--version", "450", "--no-es", "--output", result, binary});
    if (!translated.good) return {translated.output, {}};
    return {{}, tool::read(result)};
}

}  // namespace hlsl
