#pragma once

// Horizon maps that own their memory, shared by the tests of encodings.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/horizon_map.hpp>

#include "support/shapes.hpp"

// Slopes with the directions that they are for: evenly spaced, the first at +x.
struct horizons {
    glm::ivec2 extent{0};
    int bearings = 0;
    std::vector<glm::dvec2> directions;
    mutable std::vector<float> slopes;

    horizons(glm::ivec2 size, int count)
        : extent(size),
          bearings(count),
          directions(shapes::directions(count)),
          slopes(bumpshadow::required_size(size, count)) {}

    // Independent slopes in [-0.25, 1.75), reproducible.
    static horizons random(glm::ivec2 size, int count, std::uint64_t seed) {
        horizons result(size, count);
        result.fill(seed);
        return result;
    }
    void fill(std::uint64_t seed) {
        shapes::noise source(seed);
        for (float& slope : slopes) slope = float(2.0 * source.uniform() - 0.25);
    }
    [[nodiscard]] bumpshadow::horizon_map view() const {
        return {.values = slopes, .extent = extent, .bearings = bearings};
    }
    [[nodiscard]] float& at(int bearing, int x, int y) const {
        return slopes[(std::size_t(bearing) * std::size_t(extent.y) + std::size_t(y)) * std::size_t(extent.x) +
                      std::size_t(x)];
    }
};
