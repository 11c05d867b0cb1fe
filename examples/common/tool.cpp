#include "common/tool.hpp"

#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#ifndef _WIN32
#include <sys/wait.h>
#endif

namespace examples {
namespace {

#ifdef _WIN32
constexpr char path_separator = ';';
constexpr const char* suffix = ".exe";
constexpr const char* silence = " >NUL 2>&1";
#else
constexpr char path_separator = ':';
constexpr const char* suffix = "";
constexpr const char* silence = " >/dev/null 2>&1";
#endif

// As one word of the shell.
std::string word_of_shell(const std::string& text) {
#ifdef _WIN32
    return '"' + text + '"';
#else
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + '\'';
#endif
}

}  // namespace

std::optional<std::string> find_tool(const std::string& name) {
    const char* path = std::getenv("PATH");
    for (std::string left = path != nullptr ? path : ""; !left.empty();) {
        const std::size_t end = left.find(path_separator);
        const std::filesystem::path file = std::filesystem::path(left.substr(0, end)) / (name + suffix);
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored)) return file.string();
        left = end == std::string::npos ? "" : left.substr(end + 1);
    }
    return std::nullopt;
}

bool run_tool(const std::string& program, const std::vector<std::string>& words) {
    std::string command = word_of_shell(program);
    for (const std::string& word : words) command.append(" ").append(word_of_shell(word));
    command += silence;
    const int status = std::system(command.c_str());
#ifndef _WIN32
    // While the program runs Ctrl-C ends only that, and is meant for both. A shell in between makes it 128 + SIGINT.
    if ((WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) ||
        (WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGINT))
        std::raise(SIGINT);
#endif
    return status == 0;
}

}  // namespace examples
