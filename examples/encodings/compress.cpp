#include "encodings/compress.hpp"

#include <cstdlib>
#include <filesystem>
#include <random>
#include <system_error>
#include <utility>
#include <variant>

#include "common/file.hpp"
#include "common/report_text.hpp"

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

// A folder of its own for the files that go to the program and come back; removed with all that is in it.
class work_folder {
public:
    work_folder() {
        std::random_device random;
        std::error_code error;
        path_ =
            std::filesystem::temp_directory_path(error) / format("bumpshadow-encodings-%08x%08x", random(), random());
        if (error || !std::filesystem::create_directory(path_, error))
            throw failure("cannot make a temporary folder: " + error.message());
    }
    ~work_folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    work_folder(const work_folder&) = delete;
    work_folder& operator=(const work_folder&) = delete;

    [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

image8 read_rgb(const std::string& path) {
    auto picture = read_image(path);
    if (!std::holds_alternative<image8>(picture)) throw failure("cannot use " + path + ": not of 8 bits");
    return std::get<image8>(std::move(picture));
}

void run(const std::string& program, const std::string& rest) {
    const std::string command = '"' + program + "\" " + rest + silence;
    if (std::system(command.c_str()) != 0) throw failure("failed: " + command);
}

std::string in_quotes(const std::string& path) { return " \"" + path + '"'; }

}  // namespace

std::optional<std::string> find_codec(codec which) {
    const char* path = std::getenv("PATH");
    const std::string name = std::string(which == codec::astc ? "astcenc" : "bc7enc") + suffix;
    for (std::string left = path != nullptr ? path : ""; !left.empty();) {
        const std::size_t end = left.find(path_separator);
        const std::filesystem::path file = std::filesystem::path(left.substr(0, end)) / name;
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored)) return file.string();
        left = end == std::string::npos ? "" : left.substr(end + 1);
    }
    return std::nullopt;
}

image8 recompress(codec which, const std::string& program, const std::string& block, const image8& picture) {
    const work_folder folder;
    const std::string in = folder.file("in.png"), out = folder.file("out.png");
    output_file file(in);
    write_png(file, picture);
    file.commit();
    image8 result;
    if (which == codec::astc) {
        run(program, "-tl" + in_quotes(in) + in_quotes(out) + ' ' + block + " -medium -silent");
        result = read_rgb(out);
    } else {
        // It writes color and alpha apart, the latter to a name that it makes from the former.
        run(program, "-q -o -u4" + in_quotes(in) + in_quotes(folder.file("out.dds")) + in_quotes(out));
        const image8 color = read_rgb(out), alpha = read_rgb(folder.file("out_alpha.png"));
        result = image8(picture.extent, 4);
        for (int y = 0; y < picture.extent.y; ++y)
            for (int x = 0; x < picture.extent.x; ++x) {
                for (int c = 0; c < 3; ++c) result.at(x, y)[c] = color.at(x, y)[c];
                result.at(x, y)[3] = alpha.at(x, y)[0];
            }
    }
    if (result.extent != picture.extent || result.channels != 4)
        throw failure(program + " gave back an image of another size or kind");
    return result;
}

}  // namespace examples
