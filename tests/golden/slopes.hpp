#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/horizon_map.hpp>

namespace golden {

inline constexpr int bearings = 12;
inline constexpr glm::ivec2 extent{19, 10};  // no multiple of what is done at a time
inline constexpr float max_slope = 4.0f;

// A slope in 256ths of max_slope, up to 300.
constexpr int unclamped_parts(int bearing, int x, int y) {
    return (7 * x * x + y * y + 13 * x * y + 29 * bearing * (x + 1)) % 301;
}
constexpr int parts(int bearing, int x, int y) { return std::min(unclamped_parts(bearing, x, y), 256); }

// The first `count` bearings of it, in as many evenly spaced directions.
struct slopes {
    explicit slopes(int count = bearings) : directions(std::size_t(count)) {
        bumpshadow::fill_directions(directions);
        for (int i = 0; i < count; ++i)
            for (int y = 0; y < extent.y; ++y)
                for (int x = 0; x < extent.x; ++x)
                    values.push_back(float(unclamped_parts(i, x, y)) / 256.0f * max_slope);
    }
    [[nodiscard]] bumpshadow::horizon_map view() const {
        return {.values = values, .extent = extent, .bearings = int(directions.size())};
    }

    std::vector<glm::dvec2> directions;
    mutable std::vector<float> values;
};

}  // namespace golden
