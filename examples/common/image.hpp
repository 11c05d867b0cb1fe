#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

#include <glm/ext/vector_int2.hpp>

#include "common/file.hpp"

namespace examples {

// An image of 1 (gray), 2 (gray, alpha), 3 (RGB) or 4 (RGBA) interleaved channels, [y][x][channel], first row on top.
template <class Sample>
struct image {
    glm::ivec2 extent{0};
    int channels = 0;
    std::vector<Sample> samples;

    image() = default;
    image(glm::ivec2 size, int channel_count)
        : extent(size),
          channels(channel_count),
          samples(std::size_t(size.x) * std::size_t(size.y) * std::size_t(channel_count)) {}

    [[nodiscard]] const Sample* at(int x, int y) const {
        return samples.data() + (std::size_t(y) * std::size_t(extent.x) + std::size_t(x)) * std::size_t(channels);
    }
    [[nodiscard]] Sample* at(int x, int y) {
        return samples.data() + (std::size_t(y) * std::size_t(extent.x) + std::size_t(x)) * std::size_t(channels);
    }
};

using image8 = image<std::uint8_t>;
using image16 = image<std::uint16_t>;

// Reads a PNG or JPEG file. Files of up to 8 bits a channel come back as image8, 16-bit files as image16. PNG chunks
// with a wrong checksum and files that end too early are refused. Throws failure.
[[nodiscard]] std::variant<image8, image16> read_image(const std::filesystem::path& path);

// True where an image of this size can be written as PNG.
[[nodiscard]] bool fits_png(std::int64_t width, std::int64_t height, int channels);

// Both write to an open file and leave the commit to the caller. Throw failure.
void write_png(output_file& file, const image8& picture);
void write_jpg(output_file& file, const image8& picture, int quality);

}  // namespace examples
