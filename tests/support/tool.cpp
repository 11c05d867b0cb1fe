#include "support/tool.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <system_error>

namespace tool {

namespace fs = std::filesystem;

#ifdef _WIN32
constexpr char separator = ';';
constexpr std::string_view extension = ".exe";
#else
constexpr char separator = ':';
constexpr std::string_view extension;
#endif

fs::path find(std::string_view name) {
    const char* const variable = std::getenv("PATH");
    std::string_view rest = variable != nullptr ? variable : "";
    while (!rest.empty()) {
        const std::string_view place = rest.substr(0, rest.find(separator));
        rest.remove_prefix(place.size() < rest.size() ? place.size() + 1 : place.size());
        fs::path candidate = fs::path(place) / (std::string(name) + std::string(extension));
        std::error_code ignored;
        if (!place.empty() && fs::is_regular_file(candidate, ignored)) return candidate;
    }
    return {};
}

outcome run(const std::vector<std::string>& words) {
    const folder temporary;
    const std::string log = (temporary / "log").string();
    std::string command;
    for (const std::string& word : words) command += '"' + word + "\" ";
    command += "> \"" + log + "\" 2>&1";
#ifdef _WIN32
    command = '"' + command + '"';  // cmd takes one pair away
#endif
    const int code = std::system(command.c_str());
    return {code == 0, read(log)};
}

folder::folder() {
    std::random_device random;
    std::error_code error;
    do {
        path_ = fs::temp_directory_path(error) / ("bumpshadow_" + std::to_string(random()));
    } while (!fs::create_directory(path_, error) && !error);
}

folder::~folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

}  // namespace tool
