#include "shader_cost/glsl.hpp"

#include <cstdlib>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/file.hpp"

// POSIX leaves it to the program; glibc declares it, too.
extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace examples {

namespace {

std::filesystem::path new_folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shader_cost.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw failure("cannot make a folder " + pattern);
    return pattern;
}

}  // namespace

glsl_compiler::glsl_compiler(std::string program, std::filesystem::path folder)
    : program_(std::move(program)), folder_(std::move(folder)) {}

// Once the other constructor is done, whatever is thrown leads to the destructor.
glsl_compiler::glsl_compiler(std::string program) : glsl_compiler(std::move(program), new_folder()) {
    std::string output;
    if (run({"--version"}, output) == 0) return;
    throw failure("cannot run " + program_ +
                  " (Debian, Ubuntu: glslang-tools), or --glslang has to name glslangValidator");
}

glsl_compiler::~glsl_compiler() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

int glsl_compiler::run(const std::vector<std::string>& arguments, std::string& output) const {
    const std::string log = (folder_ / "log").string();
    std::vector<std::string> texts{program_};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const int error = posix_spawnp(&child, program_.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (error != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    const std::vector<unsigned char> bytes = read_file(log);
    output.assign(bytes.begin(), bytes.end());
    return WEXITSTATUS(status);
}

std::vector<std::uint32_t> glsl_compiler::compile(const std::string& name, const std::string& glsl) const {
    const std::filesystem::path source = folder_ / "shader.comp", target = folder_ / "shader.spv";
    output_file file(source);
    file.write(glsl);
    file.commit();
    std::string output;
    if (run({"-V", "-S", "comp", "-o", target.string(), source.string()}, output) != 0)
        throw failure(name + " does not compile:\n" + output + glsl);
    const std::vector<unsigned char> bytes = read_file(target);
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), 4 * words.size());
    return words;
}

}  // namespace examples
