#include "common/picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace examples {

image8 picture_of_slice(const bumpshadow::horizon_map& horizons, int bearing) {
    constexpr float white = float(255.0 / (std::numbers::pi / 2.0));
    image8 picture(horizons.extent, 1);
    for (int y = 0; y < horizons.extent.y; ++y) {
        const float* slopes = horizons.row(bearing, y);
        std::uint8_t* pixels = picture.at(0, y);
        for (int x = 0; x < horizons.extent.x; ++x)
            pixels[x] = std::uint8_t(std::lround(white * std::atan(std::max(slopes[x], 0.0f))));
    }
    return picture;
}

image8 sheet(std::span<const image8> pictures, int columns, int gap) {
    const glm::ivec2 one = pictures.front().extent;
    const int channels = pictures.front().channels;
    const int rows = (int(pictures.size()) + columns - 1) / columns;
    image8 all({columns * (one.x + gap) - gap, rows * (one.y + gap) - gap}, channels);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int left = int(i) % columns * (one.x + gap), top = int(i) / columns * (one.y + gap);
        for (int y = 0; y < one.y; ++y)
            std::copy_n(pictures[i].at(0, y), std::size_t(one.x) * std::size_t(channels), all.at(left, top + y));
    }
    return all;
}

image8 shrink(const image8& picture, int longest) {
    const int block = (std::max(picture.extent.x, picture.extent.y) + longest - 1) / longest;
    if (block <= 1) return picture;
    image8 small({std::max(picture.extent.x / block, 1), std::max(picture.extent.y / block, 1)}, picture.channels);
    for (int y = 0; y < small.extent.y; ++y)
        for (int x = 0; x < small.extent.x; ++x) {
            const int right = std::min((x + 1) * block, picture.extent.x);
            const int bottom = std::min((y + 1) * block, picture.extent.y);
            for (int c = 0; c < picture.channels; ++c) {
                int sum = 0, count = 0;
                for (int v = y * block; v < bottom; ++v)
                    for (int u = x * block; u < right; ++u, ++count) sum += picture.at(u, v)[c];
                small.at(x, y)[c] = std::uint8_t((sum + count / 2) / count);
            }
        }
    return small;
}

}  // namespace examples
