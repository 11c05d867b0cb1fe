#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>

#include "common/file.hpp"

namespace examples {

// Which channel of an image is the height.
enum class channel { luminance, red, green, blue, alpha };

// Where a height map comes from and what its numbers mean.
struct height_source {
    std::string path;
    channel from = channel::luminance;
    std::optional<glm::ivec2> raw;  // extent of a file of bare little-endian float32
    std::optional<double> height_scale;
    glm::dvec2 texel_size{1.0, 1.0};
    bumpshadow::edge_mode edge = bumpshadow::edge_mode::repeat;
    std::optional<double> no_data;  // a sample value of the file; NaN is one too
};

// Tightly packed samples in the type that the file has.
struct height_samples {
    glm::ivec2 extent{0};
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> samples;

    [[nodiscard]] bool is_normalized() const { return !std::holds_alternative<std::vector<float>>(samples); }
};

// Reads a PNG, a JPEG, or raw float32 where source.raw is set. Gray of 8 or 16 bits keeps its type; luminance of real
// color (Rec. 709 weights, applied to the values as stored) becomes 16 bits. NaN and infinite heights, a channel that
// is not there, and a no_data value that the samples cannot have are refused. Throws failure.
[[nodiscard]] height_samples read_heights(const height_source& source);

// Calls `use` with a view of the samples in their own type.
template <class Function>
decltype(auto) with_height_map(const height_samples& heights, const height_source& source, double height_scale,
                               Function&& use) {
    return std::visit(
        [&]<class Sample>(const std::vector<Sample>& samples) -> decltype(auto) {
            bumpshadow::height_map<Sample> map = bumpshadow::tight_height_map(samples.data(), heights.extent);
            map.height_scale = height_scale;
            map.texel_size = source.texel_size;
            map.edge = source.edge;
            if (source.no_data) map.no_data = static_cast<Sample>(*source.no_data);
            return use(map);
        },
        heights.samples);
}

}  // namespace examples
