#include "common/heights.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "common/image.hpp"
#include "common/report_text.hpp"

namespace examples {
namespace {

[[noreturn]] void refuse(const height_source& source, const std::string& why) {
    throw failure("cannot use " + source.path + ": " + why);
}

std::vector<float> read_raw(const height_source& source, glm::ivec2 extent) {
    const std::vector<unsigned char> file = read_file(path_of(source.path));
    const std::uint64_t texels = std::uint64_t(extent.x) * std::uint64_t(extent.y);
    if (file.size() % 4 != 0 || file.size() / 4 != texels)
        refuse(source, "it has " + std::to_string(file.size()) + " bytes, but --raw " + std::to_string(extent.x) + " " +
                           std::to_string(extent.y) + " needs 4 for each texel");
    std::vector<float> heights(texels);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const unsigned char* b = file.data() + 4 * i;
        heights[i] = std::bit_cast<float>(std::uint32_t(b[0]) | std::uint32_t(b[1]) << 8 | std::uint32_t(b[2]) << 16 |
                                          std::uint32_t(b[3]) << 24);
    }
    return heights;
}

template <class Sample>
std::vector<Sample> pick_channel(const image<Sample>& picture, int index) {
    std::vector<Sample> heights(picture.samples.size() / std::size_t(picture.channels));
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = picture.samples[i * std::size_t(picture.channels) + std::size_t(index)];
    return heights;
}

template <class Sample>
bool is_gray(const image<Sample>& picture) {
    if (picture.channels < 3) return true;
    for (std::size_t i = 0; i < picture.samples.size(); i += std::size_t(picture.channels))
        if (picture.samples[i] != picture.samples[i + 1] || picture.samples[i] != picture.samples[i + 2]) return false;
    return true;
}

template <class Sample>
std::vector<std::uint16_t> luminance(const image<Sample>& picture) {
    constexpr std::uint64_t widen = 65535u / std::numeric_limits<Sample>::max();
    std::vector<std::uint16_t> heights(picture.samples.size() / std::size_t(picture.channels));
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const Sample* c = picture.samples.data() + i * std::size_t(picture.channels);
        // 0.2126, 0.7152, 0.0722; the three add up to 65536.
        const std::uint64_t sum =
            widen * (std::uint64_t{13933} * c[0] + std::uint64_t{46871} * c[1] + std::uint64_t{4732} * c[2]);
        heights[i] = std::uint16_t((sum + 32768) >> 16);
    }
    return heights;
}

template <class Sample>
height_samples from_image(const height_source& source, const image<Sample>& picture) {
    const int channels = picture.channels;
    switch (source.from) {
        case channel::luminance:
            if (is_gray(picture)) return {picture.extent, pick_channel(picture, 0)};
            if (source.no_data) refuse(source, "--no-data needs a gray image or a --channel");
            return {picture.extent, luminance(picture)};
        case channel::red: return {picture.extent, pick_channel(picture, 0)};
        case channel::green: return {picture.extent, pick_channel(picture, channels < 3 ? 0 : 1)};
        case channel::blue: return {picture.extent, pick_channel(picture, channels < 3 ? 0 : 2)};
        case channel::alpha: break;
    }
    if (channels % 2 != 0) refuse(source, "--channel alpha, but it has no alpha channel");
    return {picture.extent, pick_channel(picture, channels - 1)};
}

}  // namespace

height_samples read_heights(const height_source& source) {
    height_samples heights = source.raw ? height_samples{*source.raw, read_raw(source, *source.raw)}
                                        : std::visit([&](const auto& picture) { return from_image(source, picture); },
                                                     read_image(path_of(source.path)));
    std::visit(
        [&]<class Sample>(const std::vector<Sample>& samples) {
            if constexpr (std::is_integral_v<Sample>) {
                constexpr Sample largest = std::numeric_limits<Sample>::max();
                if (source.no_data && !(*source.no_data >= 0.0 && *source.no_data <= double(largest) &&
                                        *source.no_data == std::floor(*source.no_data)))
                    refuse(source, format("--no-data %g is given, but it has to be one of its sample values, 0 to %d",
                                          *source.no_data, int(largest)));
            } else {
                bumpshadow::height_map<Sample> map = bumpshadow::tight_height_map(samples.data(), heights.extent);
                if (source.no_data) map.no_data = static_cast<Sample>(*source.no_data);
                if (const bumpshadow::status s = bumpshadow::check_samples(map); !s)
                    refuse(source, s.message().c_str());
            }
        },
        heights.samples);
    return heights;
}

}  // namespace examples
