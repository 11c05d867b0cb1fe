#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace examples {

// glslangValidator, run in a folder of its own that is removed in the end.
class glsl_compiler {
public:
    // Throws failure where `program` cannot be run.
    explicit glsl_compiler(std::string program);
    ~glsl_compiler();
    glsl_compiler(const glsl_compiler&) = delete;
    glsl_compiler& operator=(const glsl_compiler&) = delete;

    // A compute shader as SPIR-V. Throws failure with what the program says about it; `name`: what it is called there.
    [[nodiscard]] std::vector<std::uint32_t> compile(const std::string& name, const std::string& glsl) const;

private:
    glsl_compiler(std::string program, std::filesystem::path folder);
    // Exit code, or -1; `output` receives what is printed.
    [[nodiscard]] int run(const std::vector<std::string>& arguments, std::string& output) const;

    std::string program_;
    std::filesystem::path folder_;
};

}  // namespace examples
