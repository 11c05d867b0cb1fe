// Makes the files that the tests of the programs read, and reads what these have written.
//   program_test_images make DIR
//   program_test_images pixel FILE X Y       the channels of a pixel
//   program_test_images size FILE            width, height, channels

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/file.hpp"
#include "common/image.hpp"

namespace {

using bytes = std::vector<unsigned char>;

void put(bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<unsigned char>(value >> shift & 255u));
}

// A chunk with its checksum, bit by bit as the PNG standard defines it.
void put_chunk(bytes& file, std::string_view type, const bytes& data) {
    put(file, std::uint32_t(data.size()));
    const std::size_t first = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    std::uint32_t crc = ~0u;
    for (std::size_t i = first; i < file.size(); ++i) {
        crc ^= file[i];
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    put(file, ~crc);
}

// A PNG without compression. Samples are interleaved; with 16 bits all of them count, else the low 8.
bytes png(std::uint32_t width, std::uint32_t height, int channels, int bits, const std::vector<unsigned>& samples) {
    constexpr std::array<unsigned char, 5> color_types{0, 0, 4, 2, 6};
    bytes rows;
    for (std::size_t y = 0, i = 0; y < height; ++y) {
        rows.push_back(0);
        for (std::size_t x = 0; x < width * std::size_t(channels); ++x, ++i) {
            if (bits == 16) rows.push_back(static_cast<unsigned char>(samples[i] >> 8));
            rows.push_back(static_cast<unsigned char>(samples[i] & 255u));
        }
    }
    std::uint32_t a = 1, b = 0;
    for (const unsigned char byte : rows) a = (a + byte) % 65521u, b = (b + a) % 65521u;
    const auto size = static_cast<unsigned>(rows.size());  // one stored block: below 65536
    bytes packed{0x78, 1, 1};
    for (const unsigned half : {size, ~size})
        for (const int shift : {0, 8}) packed.push_back(static_cast<unsigned char>(half >> shift & 255u));
    packed.insert(packed.end(), rows.begin(), rows.end());
    put(packed, b << 16 | a);

    bytes header;
    put(header, width);
    put(header, height);
    header.insert(header.end(), {static_cast<unsigned char>(bits), color_types[std::size_t(channels)], 0, 0, 0});
    bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    put_chunk(file, "IHDR", header);
    put_chunk(file, "IDAT", packed);
    put_chunk(file, "IEND", {});
    return file;
}

void save(const std::filesystem::path& path, const bytes& content) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
    if (!file.flush()) throw examples::failure("cannot write " + path.string());
}

void make(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    // A step, eight texels in a row: low, then high.
    const auto step = [](auto make_texel) {
        std::vector<unsigned> samples;
        for (unsigned x = 0; x < 8; ++x)
            for (const unsigned sample : make_texel(x >= 4)) samples.push_back(sample);
        return samples;
    };
    using list = std::vector<unsigned>;
    const bytes gray = png(8, 1, 1, 8, step([](bool high) { return list{high ? 255u : 0u}; }));
    save(folder / "gray8.png", gray);
    save(folder / "gray16.png", png(8, 1, 1, 16, step([](bool high) { return list{high ? 513u : 512u}; })));
    save(folder / "gray_alpha.png", png(8, 1, 2, 8, step([](bool high) { return list{7u, high ? 255u : 0u}; })));
    save(folder / "rgb.png", png(8, 1, 3, 8, step([](bool high) {
                                     return list{high ? 255u : 0u, 100u, high ? 0u : 255u};
                                 })));
    save(folder / "rgb_of_gray.png", png(8, 1, 3, 8, step([](bool high) { return list(3, high ? 255u : 0u); })));
    save(folder / "rgba16.png", png(8, 1, 4, 16, step([](bool high) {
                                        return list{0u, high ? 65535u : 0u, 0u, high ? 0u : 65535u};
                                    })));

    bytes cut = gray;
    cut.resize(gray.size() - 20);
    save(folder / "cut.png", cut);
    bytes flipped = gray;
    flipped[50] ^= 4;
    save(folder / "flipped.png", flipped);
    save(folder / "no_width.png", png(0, 1, 1, 8, {}));
    save(folder / "empty.png", {});
    save(folder / "text.png", {'h', 'e', 'l', 'l', 'o', '\n'});

    // The edge of the step lies between two blocks of a JPEG, so it survives.
    examples::image8 blocks({16, 8}, 1);
    for (int y = 0; y < 8; ++y)
        for (int x = 8; x < 16; ++x) *blocks.at(x, y) = 255;
    examples::output_file jpg(folder / "gray.jpg");
    write_jpg(jpg, blocks, 100);
    jpg.commit();
    bytes cut_jpg = examples::read_file(folder / "gray.jpg");
    cut_jpg.resize(cut_jpg.size() - 4);
    save(folder / "cut.jpg", cut_jpg);

    // Bumps on which a bake takes a while.
    list bumps;
    for (unsigned y = 0; y < 200; ++y)
        for (unsigned x = 0; x < 200; ++x) bumps.push_back((x * x * 7u + y * y * 3u + x * y) % 251u);
    save(folder / "bumps.png", png(200, 200, 1, 8, bumps));

    // A block in the middle of a plain: its shadow shows where the light comes from.
    list block;
    for (unsigned y = 0; y < 32; ++y)
        for (unsigned x = 0; x < 32; ++x) block.push_back(x >= 14 && x < 18 && y >= 14 && y < 18 ? 255u : 0u);
    // A gentle hill, 64 x 64, that tiles.
    list hill;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            hill.push_back(unsigned(4 * (32 - std::abs(x - 32)) + 3 * (32 - std::abs(y - 32))));
    save(folder / "hill.png", png(64, 64, 1, 8, hill));
    save(folder / "block.png", png(32, 32, 1, 8, block));
    list normals;  // flat
    for (int i = 0; i < 64 * 64; ++i) normals.insert(normals.end(), {128u, 128u, 255u});
    save(folder / "normals.png", png(64, 64, 3, 8, normals));
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() == 2 && words[0] == "make") {
        make(words[1]);
    } else if (words.size() == 2 && words[0] == "interrupt") {
        examples::output_file file(words[1]);
        file.write("half");
        std::raise(SIGTERM);
    } else if (words.size() >= 2 && (words[0] == "size" || words[0] == "pixel")) {
        const auto picture = std::get<examples::image8>(examples::read_image(words[1]));
        if (words[0] == "size") {
            std::printf("%d %d %d\n", picture.extent.x, picture.extent.y, picture.channels);
        } else {
            const unsigned char* pixel = picture.at(std::stoi(words.at(2)), std::stoi(words.at(3)));
            for (int c = 0; c < picture.channels; ++c) std::printf("%d ", pixel[c]);
            std::printf("\n");
        }
    } else {
        return 2;
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
