#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <bumpshadow/status.hpp>

namespace examples {

// What the programs throw where they cannot go on; its text is for a person and names the file or option.
struct failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Throws failure where a call of the library failed.
inline void require(const bumpshadow::status& status) {
    if (!status) throw failure(status.message().c_str());
}

// The path that a text in UTF-8 names: one from a command line or a file. On Windows the path's own constructor takes
// each byte for a letter.
[[nodiscard]] inline std::filesystem::path path_of(const std::string& text) {
#ifdef _WIN32
    return std::u8string(text.begin(), text.end());
#else
    return text;
#endif
}

// All bytes of a file. Throws failure.
[[nodiscard]] std::vector<unsigned char> read_file(const std::filesystem::path& path);

// Throws failure where an output is one of the files that are read. Empty inputs name none.
void refuse_inputs(const std::filesystem::path& output, const std::vector<std::string>& inputs);

// A folder and its missing parents; what was created goes again, as far as it is empty, unless kept. Throws failure.
class output_folder {
public:
    explicit output_folder(const std::filesystem::path& path);
    ~output_folder() { remove_created(); }
    output_folder(const output_folder&) = delete;
    output_folder& operator=(const output_folder&) = delete;

    void keep() { created_.clear(); }

private:
    void remove_created();

    std::vector<std::filesystem::path> created_;  // deepest first
};

// A file that exists whole or not at all: bytes go to `target` + ".part", which commit() gives its name. A link stays,
// and the file that it leads to is meant, which has to be there.
// Without a commit, after any failure and on SIGINT, SIGTERM and SIGHUP, the part is removed.
class output_file {
public:
    // Opens the part, so that a folder that cannot be written is known before any work. Throws failure, also where the
    // target is there and is no file (a folder, a device, a pipe).
    explicit output_file(std::filesystem::path target);
    ~output_file();
    output_file(const output_file&) = delete;
    output_file& operator=(const output_file&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }
    // Flushes and closes the part; a full disk is found here at the latest.
    void close();
    // Closes and renames. Replaces a file that was there.
    void commit();

    [[nodiscard]] const std::filesystem::path& target() const { return target_; }

private:
    [[noreturn]] void fail(const std::string& reason) const;
    void forget() noexcept;

    std::filesystem::path target_, file_behind_, part_;
    std::FILE* file_ = nullptr;
};

}  // namespace examples
