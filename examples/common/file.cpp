#include "common/file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>

#ifdef _WIN32
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#endif

namespace examples {
namespace {

using path_character = std::filesystem::path::value_type;

#ifdef _WIN32
std::FILE* open_to_read(const std::filesystem::path& path) { return _wfopen(path.c_str(), L"rb"); }

// fopen would not let the signal handler remove what is open.
std::FILE* open_to_write(const std::filesystem::path& path) {
    const HANDLE handle = CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr,
                                      CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = std::error_code(int(GetLastError()), std::system_category()).default_error_condition().value();
        return nullptr;
    }
    return _fdopen(_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY), "wb");
}

void remove_file(const path_character* path) { DeleteFileW(path); }
#else
std::FILE* open_to_read(const std::filesystem::path& path) { return std::fopen(path.c_str(), "rb"); }
std::FILE* open_to_write(const std::filesystem::path& path) { return std::fopen(path.c_str(), "wb"); }
void remove_file(const path_character* path) { std::remove(path); }
#endif

// Parts that exist right now, for the signal handler, which may read nothing but lock-free atomics.
std::array<std::atomic<const path_character*>, 64> open_parts{};
static_assert(std::atomic<const path_character*>::is_always_lock_free);

extern "C" void remove_parts_and_end(int signal) {
    for (const std::atomic<const path_character*>& part : open_parts)
        if (const path_character* path = part.load()) remove_file(path);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void handle_signals() {
    static const bool once = [] {
        for (const int signal : {
                 SIGINT,
                 SIGTERM,
#ifdef SIGHUP
                 SIGHUP,
#endif
             })
            // A signal that the caller (nohup, say) has set to be ignored stays ignored.
            if (std::signal(signal, remove_parts_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
#ifdef SIGXFSZ
        std::signal(SIGXFSZ, SIG_IGN);  // a file over the size limit becomes a failed write instead
#endif
        return true;
    }();
    (void)once;
}

std::string reason_text(int reason) { return std::generic_category().message(reason); }

}  // namespace

std::vector<unsigned char> read_file(const std::filesystem::path& path) {
    const auto fail = [&](int reason) { throw failure("cannot read " + path.string() + ": " + reason_text(reason)); };
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) fail(EISDIR);
    std::FILE* file = open_to_read(path);
    if (file == nullptr) fail(errno);
    std::vector<unsigned char> bytes;
    std::array<unsigned char, 65536> chunk;
    for (std::size_t n; (n = std::fread(chunk.data(), 1, chunk.size(), file)) > 0;)
        bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + std::ptrdiff_t(n));
    const int reason = std::ferror(file) ? errno : 0;
    std::fclose(file);
    if (reason != 0) fail(reason);
    return bytes;
}

void refuse_inputs(const std::filesystem::path& output, const std::vector<std::string>& inputs) {
    for (const std::string& input : inputs) {
        std::error_code ignored;
        if (!input.empty() && std::filesystem::equivalent(path_of(input), output, ignored))
            throw failure("cannot write " + output.string() + ": it is read from");
    }
}

output_folder::output_folder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();
    for (std::filesystem::path p = whole; !p.empty() && !std::filesystem::exists(p, error); p = p.parent_path())
        created_.push_back(p);
    error.clear();
    std::filesystem::create_directories(whole, error);
    if (!error && !std::filesystem::is_directory(whole, error) && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    if (!error) return;
    remove_created();
    throw failure("cannot create folder " + path.string() + ": " + error.message());
}

void output_folder::remove_created() {
    std::error_code ignored;
    for (const std::filesystem::path& p : created_) std::filesystem::remove(p, ignored);
}

output_file::output_file(std::filesystem::path target) : target_(std::move(target)), file_behind_(target_) {
    std::error_code ignored, error;
    if (std::filesystem::is_symlink(target_, ignored)) {
        file_behind_ = std::filesystem::canonical(target_, error);
        if (error) fail(error.message());
    }
    part_ = file_behind_;
    part_ += ".part";
    handle_signals();
    // Renaming would put a file in the place of a device.
    const std::filesystem::file_status there = std::filesystem::status(target_, ignored);
    if (std::filesystem::is_directory(there)) fail(reason_text(EISDIR));
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) fail("it is no file");
    // Known to the handler before it exists, so that no moment is left in which a signal leaves it behind.
    bool noted = false;
    for (std::atomic<const path_character*>& part : open_parts) {
        const path_character* empty = nullptr;
        if ((noted = part.compare_exchange_strong(empty, part_.c_str()))) break;
    }
    if (!noted) fail(reason_text(EMFILE));
    file_ = open_to_write(part_);
    if (file_ != nullptr) return;
    const int reason = errno;
    forget();
    fail(reason_text(reason));
}

output_file::~output_file() {
    if (part_.empty()) return;
    if (file_ != nullptr) std::fclose(file_);
    remove_file(part_.c_str());
    forget();
}

void output_file::write(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(reason_text(errno));
}

void output_file::close() {
    if (file_ == nullptr) return;
    const bool failed = std::fflush(file_) != 0;
    const int reason = errno;
    const bool close_failed = std::fclose(file_) != 0;
    file_ = nullptr;
    if (failed || close_failed) fail(reason_text(failed ? reason : errno));
}

void output_file::commit() {
    close();
    std::error_code error;
    std::filesystem::rename(part_, file_behind_, error);
    if (error) fail(error.message());
    forget();
    part_.clear();
}

void output_file::fail(const std::string& reason) const {
    throw failure("cannot write " + target_.string() + ": " + reason);
}

void output_file::forget() noexcept {
    for (std::atomic<const path_character*>& part : open_parts) {
        const path_character* mine = part_.c_str();
        if (part.compare_exchange_strong(mine, nullptr)) return;
    }
}

}  // namespace examples
