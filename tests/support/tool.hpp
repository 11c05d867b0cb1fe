#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Programs that a test calls where they are installed.
namespace tool {

// A program on PATH; empty: none.
[[nodiscard]] std::filesystem::path find(std::string_view name);

struct outcome {
    bool good = false;   // it ran and exited with 0
    std::string output;  // standard output and error together
};

// Runs a program and waits for it.
[[nodiscard]] outcome run(const std::vector<std::string>& words);

// A new folder for temporary files, removed with all that is in it.
class folder {
public:
    folder();
    ~folder();
    folder(const folder&) = delete;
    folder& operator=(const folder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

[[nodiscard]] std::string read(const std::filesystem::path& path);
void write(const std::filesystem::path& path, std::string_view text);

}  // namespace tool
