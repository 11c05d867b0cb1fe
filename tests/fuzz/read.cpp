// Fuzz target: the files that the programs read. Bytes become a PNG, a JPEG, raw floats or a MANIFEST.tsv, which is
// read as the programs read it: either there are heights of that size, all finite, or there is one line of text.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/manifest.hpp"
#include "fuzz/input.hpp"

namespace {

using fuzz::require;
namespace fs = std::filesystem;

// A folder of this process, removed at its end.
struct folder {
    fs::path path = fs::temp_directory_path() / ("bumpshadow_fuzz_" + std::to_string(getpid()));
    folder() { fs::create_directories(path); }
    folder(const folder&) = delete;
    folder& operator=(const folder&) = delete;
    ~folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

fs::path write(const char* name, std::span<const std::uint8_t> bytes) {
    static const folder of_process;
    fs::path path = of_process.path / name;
    std::FILE* const file = std::fopen(path.string().c_str(), "wb");
    require(file != nullptr, "the temporary folder can be written");
    require(std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(), "the temporary folder has room");
    require(std::fclose(file) == 0, "the temporary folder has room");
    return path;
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = ~0u;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

// Gives each chunk of a PNG the right checksum, or no changed input would get to the decoder.
void repair(std::vector<std::uint8_t>& file) {
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t length = std::size_t(file[at]) << 24 | std::size_t(file[at + 1]) << 16 |
                                   std::size_t(file[at + 2]) << 8 | std::size_t(file[at + 3]);
        if (length > file.size() - at - 12) return;
        const std::uint32_t crc = crc32(std::span(file).subspan(at + 4, length + 4));
        for (std::size_t i = 0; i < 4; ++i) file[at + 8 + length + i] = std::uint8_t(crc >> (24 - 8 * i));
        at += 12 + length;
    }
}

// True where a PNG or a JPEG says that it has more than 512 x 512 pixels, which would only take time.
bool is_large(std::span<const std::uint8_t> file) {
    const auto two = [&](std::size_t at) { return at + 1 < file.size() ? file[at] * 256 + file[at + 1] : 0; };
    if (file.size() > 24 && file[0] == 0x89) return two(16) != 0 || two(20) != 0 || two(18) > 512 || two(22) > 512;
    for (std::size_t at = 0; at + 9 < file.size(); ++at)
        if (file[at] == 0xff && file[at + 1] >= 0xc0 && file[at + 1] <= 0xc2 &&
            (two(at + 5) > 512 || two(at + 7) > 512))
            return true;
    return false;
}

// Calls `use`; what it throws has to be a failure of one line that names the file.
template <class Use>
void attempt(const fs::path& path, const Use& use) {
    try {
        use();
    } catch (const examples::failure& failure) {
        const std::string text = failure.what();
        require(text.find(path.string()) != std::string::npos, "a failure names the file");
        require(text.find('\n') == std::string::npos && text.size() < path.string().size() + 4300,
                "a failure is one line");
    }
}

void read_map(fuzz::input& in, bool raw) {
    examples::height_source source;
    source.from = examples::channel(in.below(5));
    if (in.flag()) source.no_data = in.number<double>();
    if (raw) source.raw = glm::ivec2(1 + in.below(16), 1 + in.below(16));
    const bool right = in.flag();
    std::vector<std::uint8_t> file(in.rest().begin(), in.rest().end());
    if (!raw && right) repair(file);
    if (!raw && is_large(file)) return;
    if (raw && right) file.resize(std::size_t(source.raw->x) * std::size_t(source.raw->y) * 4);
    const fs::path path = write("heights", file);
    source.path = path.string();
    attempt(path, [&] {
        const examples::height_samples heights = examples::read_heights(source);
        const std::size_t texels = bumpshadow::required_size(heights.extent, 1);
        std::visit(
            [&](const auto& samples) { require(samples.size() == texels && texels > 0, "every texel is there"); },
            heights.samples);
        if (raw) require(heights.extent == *source.raw, "raw floats have the extent that was given");
        examples::with_height_map(heights, source, 1.0, [&](const auto& map) {
            require(bool(bumpshadow::check(map)) && bool(bumpshadow::check_samples(map)), "what is read can be baked");
        });
    });
}

void read_list(fuzz::input& in) {
    const fs::path path = write("MANIFEST.tsv", in.rest());
    attempt(path, [&] {
        for (const examples::height_source& map : examples::read_manifest(path.parent_path()))
            require(map.height_scale.has_value() && bumpshadow::is_finite(*map.height_scale) &&
                        bumpshadow::is_finite(map.texel_size.x) && bumpshadow::is_finite(map.texel_size.y) &&
                        map.texel_size.x > 0.0 && map.texel_size.y > 0.0,
                    "the numbers of a manifest can be used");
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    fuzz::input in(bytes, size);
    const int kind = in.below(4);
    if (kind == 3)
        read_list(in);
    else
        read_map(in, kind == 2);
    return 0;
}
