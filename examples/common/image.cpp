#include "common/image.hpp"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>
#include <memory>
#include <span>
#include <string>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace examples {
namespace {

using bytes = std::span<const unsigned char>;

constexpr std::array<unsigned char, 8> png_signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

bool is_png(bytes file) {
    return file.size() >= png_signature.size() && std::equal(png_signature.begin(), png_signature.end(), file.begin());
}

bool is_jpeg(bytes file) { return file.size() >= 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff; }

std::uint32_t crc32(bytes data) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> t{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            t[i] = i;
            for (int bit = 0; bit < 8; ++bit) t[i] = (t[i] & 1u) != 0 ? 0xedb88320u ^ (t[i] >> 1) : t[i] >> 1;
        }
        return t;
    }();
    std::uint32_t crc = ~0u;
    for (const unsigned char byte : data) crc = table[(crc ^ byte) & 255u] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t big_endian(bytes file, std::size_t at) {
    return std::uint32_t(file[at]) << 24 | std::uint32_t(file[at + 1]) << 16 | std::uint32_t(file[at + 2]) << 8 |
           std::uint32_t(file[at + 3]);
}

// stb_image does not look at checksums, so a flipped bit would become a wrong height. Returns what is wrong, or null.
const char* png_defect(bytes file) {
    for (std::size_t at = png_signature.size(); file.size() - at >= 12;) {
        const std::size_t length = big_endian(file, at);
        if (length > file.size() - at - 12) break;
        if (crc32(file.subspan(at + 4, length + 4)) != big_endian(file, at + 8 + length))
            return "broken PNG: wrong checksum";
        if (std::memcmp(file.data() + at + 4, "IEND", 4) == 0) return nullptr;
        at += 12 + length;
    }
    return "broken PNG: the file ends too early";
}

// stb_image takes colors beyond the end of a palette from memory that was never written. Black ones follow instead; it
// does not look at the checksum. The file has no defect.
void lengthen_palette(std::vector<unsigned char>& file) {
    constexpr std::size_t most = 3 * 256;
    for (std::size_t at = png_signature.size(); std::memcmp(file.data() + at + 4, "IEND", 4) != 0;) {
        const std::size_t length = big_endian(file, at);
        if (std::memcmp(file.data() + at + 4, "PLTE", 4) == 0 && length < most && length % 3 == 0) {
            file.insert(file.begin() + std::ptrdiff_t(at + 8 + length), most - length, 0);
            file[at + 2] = most >> 8, file[at + 3] = most & 255;
            return;
        }
        at += 12 + length;
    }
}

// stb_image 2.27 writes beyond the end of Huffman tables that say that they have more than 256 codes.
bool jpeg_tables_fit(bytes file) {
    for (std::size_t at = 2; at + 4 <= file.size();) {
        const unsigned char marker = file[at + 1];
        // Bytes of a scan, fill bytes, and markers that nothing follows.
        if (file[at] != 0xff || marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd9) || marker == 0xff) {
            ++at;
            continue;
        }
        const std::size_t length = std::size_t(file[at + 2]) << 8 | file[at + 3], end = at + 2 + length;
        if (marker == 0xc4)
            for (std::size_t table = at + 4; table < end && table + 17 <= file.size();) {
                std::size_t codes = 0;
                for (std::size_t bits = 1; bits <= 16; ++bits) codes += file[table + bits];
                if (codes > 256) return false;
                table += 17 + codes;
            }
        at = end;
    }
    return true;
}

// stb_image fills the rest of a cut JPEG with gray. The end marker has to follow the last start of a scan.
const char* jpeg_defect(bytes file) {
    constexpr std::array<unsigned char, 2> scan{0xff, 0xda}, end{0xff, 0xd9};
    const auto last_scan = std::find_end(file.begin(), file.end(), scan.begin(), scan.end());
    if (last_scan == file.end()) return "broken JPEG: no image data";
    if (!jpeg_tables_fit(file)) return "broken JPEG: a table of more than 256 codes";
    return std::search(last_scan, file.end(), end.begin(), end.end()) == file.end()
               ? "broken JPEG: the file ends too early"
               : nullptr;
}

template <class Sample>
image<Sample> decode(bytes file, const std::filesystem::path& path) {
    int width = 0, height = 0, channels = 0;
    const int size = int(file.size());
    const auto free_samples = [](Sample* samples) { stbi_image_free(samples); };
    std::unique_ptr<Sample, decltype(free_samples)> samples(nullptr, free_samples);
    if constexpr (sizeof(Sample) == 2)
        samples.reset(stbi_load_16_from_memory(file.data(), size, &width, &height, &channels, 0));
    else
        samples.reset(stbi_load_from_memory(file.data(), size, &width, &height, &channels, 0));
    if (samples == nullptr) throw failure("cannot read " + path.string() + ": broken image: " + stbi_failure_reason());
    image<Sample> result({width, height}, channels);
    std::copy_n(samples.get(), result.samples.size(), result.samples.begin());
    return result;
}

// stb_image_write calls back from C-like code that takes no failure; what is thrown by the file passes through it
// only after its own memory is released, so the bytes are collected first.
struct collected {
    std::vector<std::byte> bytes;
    static void add(void* self, void* data, int size) {
        const auto* first = static_cast<const std::byte*>(data);
        auto& all = static_cast<collected*>(self)->bytes;
        all.insert(all.end(), first, first + size);
    }
};

}  // namespace

std::variant<image8, image16> read_image(const std::filesystem::path& path) {
    std::vector<unsigned char> file = read_file(path);
    const auto refuse = [&](const std::string& why) { throw failure("cannot read " + path.string() + ": " + why); };
    if (file.empty()) refuse("the file is empty");
    if (file.size() > std::size_t(INT_MAX)) refuse("larger than 2 GiB");
    if (!is_png(file) && !is_jpeg(file)) refuse("neither PNG nor JPEG");
    if (const char* defect = is_png(file) ? png_defect(file) : jpeg_defect(file)) refuse(defect);
    if (is_png(file)) lengthen_palette(file);
    if (stbi_is_16_bit_from_memory(file.data(), int(file.size()))) return decode<std::uint16_t>(file, path);
    return decode<std::uint8_t>(file, path);
}

bool fits_png(std::int64_t width, std::int64_t height, int channels) {
    // stb_image_write counts bytes, and the bits it makes of them, in int.
    return height > 0 && width > 0 && width <= (INT_MAX / 2 / height - 1) / channels;
}

void write_png(output_file& file, const image8& picture) {
    if (!fits_png(picture.extent.x, picture.extent.y, picture.channels))
        throw failure("cannot write " + file.target().string() + ": too large for a PNG, " +
                      std::to_string(picture.extent.x) + " x " + std::to_string(picture.extent.y) + " pixels");
    collected out;
    if (stbi_write_png_to_func(collected::add, &out, picture.extent.x, picture.extent.y, picture.channels,
                               picture.samples.data(), picture.extent.x * picture.channels) == 0)
        throw failure("cannot write " + file.target().string() + ": no memory to compress it");
    file.write(out.bytes);
}

void write_jpg(output_file& file, const image8& picture, int quality) {
    collected out;
    if (stbi_write_jpg_to_func(collected::add, &out, picture.extent.x, picture.extent.y, picture.channels,
                               picture.samples.data(), quality) == 0)
        throw failure("cannot write " + file.target().string() + ": the picture cannot be compressed");
    file.write(out.bytes);
}

}  // namespace examples
