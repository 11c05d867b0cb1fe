#include "encodings/compress.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <random>
#include <span>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "common/file.hpp"
#include "common/report_text.hpp"
#include "common/tool.hpp"

namespace examples {
namespace {

// A folder of its own for the files that go to the program and come back; removed with all that is in it.
class work_folder {
public:
    work_folder() {
        std::random_device random;
        std::error_code error;
        // cppcheck-suppress useInitializationList ; it takes the two above
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

void run(const std::string& program, const std::vector<std::string>& words) {
    if (run_tool(program, words)) return;
    std::string all = "failed: " + program;
    for (const std::string& word : words) all.append(" ").append(word);
    throw failure(all);
}

// KTX 1 without mips: the format that astcenc takes and gives without packing it. PNG would take longer than the
// blocks. Source: Khronos, KTX File Format Specification, version 1.
constexpr std::array<std::uint8_t, 12> ktx_identifier{0xab, 'K', 'T', 'X', ' ', '1', '1', 0xbb, '\r', '\n', 0x1a, '\n'};
constexpr std::size_t ktx_words = 14;  // those of the header, and the size of the level

void write_ktx(const std::string& path, const image8& picture) {
    const auto width = std::uint32_t(picture.extent.x), height = std::uint32_t(picture.extent.y);
    // Byte order, type, its size, format (RGBA), internal format (RGBA8), base format, extent, depth, layers, faces,
    // levels, bytes of remarks; bytes of the level.
    const std::array<std::uint32_t, ktx_words> words{0x04030201, 0x1401, 1, 0x1908, 0x8058, 0x1908, width,
                                                     height,     0,      0, 1,      1,      0,      4 * width * height};
    output_file file(path);
    file.write(std::as_bytes(std::span(ktx_identifier)));
    file.write(std::as_bytes(std::span(words)));
    file.write(std::as_bytes(std::span(picture.samples)));
    file.commit();
}

// Channels of a format of KTX, and which of them are red, green, blue and alpha.
struct ktx_channels {
    std::uint32_t format;
    std::size_t count;
    std::array<std::size_t, 4> of;
};
constexpr std::size_t opaque = 4;  // none of them: 255
// astcenc leaves out what an image does not use, colors of gray and alpha where all of it is 255, and packs the rows
// tightly.
constexpr std::array ktx_formats{ktx_channels{0x1908, 4, {0, 1, 2, 3}}, ktx_channels{0x1907, 3, {0, 1, 2, opaque}},
                                 ktx_channels{0x8227, 2, {0, 0, 0, 1}}, ktx_channels{0x1903, 1, {0, 0, 0, opaque}}};

// One of 8 bits a channel, without mips.
image8 read_ktx(const std::string& path) {
    const std::vector<unsigned char> file = read_file(path);
    constexpr std::size_t header = sizeof ktx_identifier + 4 * ktx_words;
    std::array<std::uint32_t, ktx_words> words{};
    if (file.size() < header || !std::equal(ktx_identifier.begin(), ktx_identifier.end(), file.begin()))
        throw failure("cannot use " + path + ": not KTX");
    std::memcpy(words.data(), file.data() + sizeof ktx_identifier, 4 * (ktx_words - 1));
    const auto channels = std::find_if(ktx_formats.begin(), ktx_formats.end(),
                                       [&](const ktx_channels& c) { return c.format == words[3]; });
    if (words[0] != 0x04030201 || words[1] != 0x1401 || channels == ktx_formats.end())
        throw failure("cannot use " + path + ": not of 8 bits a channel");
    image8 picture({int(words[6]), int(words[7])}, 4);
    const std::size_t row = channels->count * words[6];
    if (file.size() != header + words[12] + row * words[7]) throw failure("cannot use " + path + ": of a wrong size");
    for (int y = 0; y < picture.extent.y; ++y)
        for (int x = 0; x < picture.extent.x; ++x) {
            const auto* const from =
                file.data() + header + words[12] + std::size_t(y) * row + std::size_t(x) * channels->count;
            for (std::size_t c = 0; c < 4; ++c)
                picture.at(x, y)[c] = channels->of[c] == opaque ? std::uint8_t(255) : from[channels->of[c]];
        }
    return picture;
}

}  // namespace

std::optional<std::string> find_codec(codec which) { return find_tool(which == codec::astc ? "astcenc" : "bc7enc"); }

image8 recompress(codec which, const std::string& program, const std::string& block, const image8& picture) {
    const work_folder folder;
    image8 result;
    if (which == codec::astc) {
        const std::string in = folder.file("in.ktx"), out = folder.file("out.ktx");
        write_ktx(in, picture);
        run(program, {"-tl", in, out, block, "-medium", "-silent"});
        result = read_ktx(out);
    } else {
        const std::string in = folder.file("in.png"), out = folder.file("out.png");
        output_file file(in);
        write_png(file, picture);
        file.commit();
        // It writes color and alpha apart, the latter to a name that it makes from the former.
        run(program, {"-q", "-o", "-u4", in, folder.file("out.dds"), out});
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
