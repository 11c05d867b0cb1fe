// DDS files as Microsoft states them (DDS_HEADER, DDS_HEADER_DXT10), word by word.

#include <bumpshadow/texture.hpp>

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/dds.hpp"
#include "common/file.hpp"

using namespace bumpshadow;

namespace {

// The file as 32-bit words; what follows the header counts 0, 1, 2 ... in bytes.
std::vector<std::uint32_t> words_of(const texture_layout& layout, std::size_t header_words) {
    std::vector<std::byte> bytes(layout.required_size());
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = std::byte(i & 255u);
    const std::filesystem::path path = "golden.dds";
    examples::output_file out(path);
    examples::write_dds(out, {bytes, layout});
    out.commit();
    const std::vector<unsigned char> file = examples::read_file(path);
    std::filesystem::remove(path);

    REQUIRE(file.size() == 4 * header_words + bytes.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) wrong += file[4 * header_words + i] != (i & 255u);
    CHECK(wrong == 0);
    std::vector<std::uint32_t> words(header_words);
    for (std::size_t i = 0; i < 4 * header_words; ++i) words[i / 4] |= std::uint32_t(file[i]) << (i % 4 * 8);
    return words;
}

}  // namespace

TEST_CASE("a volume of 8 bits") {
    const texture_layout layout{
        .format = texel_format::r8, .kind = texture_kind::volume, .extent = {19, 10}, .depth = 12};
    std::vector<std::uint32_t> wanted(32);
    wanted[0] = 0x20534444;  // "DDS "
    wanted[1] = 124;
    wanted[2] = 0x80100f;  // caps, height, width, pitch, pixel format, depth
    wanted[3] = 10;
    wanted[4] = 19;
    wanted[5] = 19;
    wanted[6] = 12;
    wanted[19] = 32;
    wanted[20] = 0x20000;  // luminance
    wanted[22] = 8;
    wanted[23] = 0xff;
    wanted[27] = 0x1008;    // texture, complex
    wanted[28] = 0x200000;  // volume
    CHECK(words_of(layout, 32) == wanted);
}

TEST_CASE("an array of BC4") {
    const texture_layout layout{
        .format = texel_format::bc4, .kind = texture_kind::array, .extent = {20, 12}, .layers = 8};
    std::vector<std::uint32_t> wanted(37);
    wanted[0] = 0x20534444;
    wanted[1] = 124;
    wanted[2] = 0x81007;  // caps, height, width, pixel format, linear size
    wanted[3] = 12;
    wanted[4] = 20;
    wanted[5] = 5 * 3 * 8;  // blocks of 8 bytes
    wanted[19] = 32;
    wanted[20] = 0x4;         // four characters
    wanted[21] = 0x30315844;  // "DX10"
    wanted[27] = 0x1008;
    wanted[32] = 80;  // DXGI_FORMAT_BC4_UNORM
    wanted[33] = 3;   // D3D10_RESOURCE_DIMENSION_TEXTURE2D
    wanted[35] = 8;
    CHECK(words_of(layout, 37) == wanted);
}
