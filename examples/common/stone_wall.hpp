#pragma once

#include <cstdint>
#include <vector>

#include <glm/ext/vector_int2.hpp>

#include "common/image.hpp"

namespace examples {

// A wall of hewn stones in courses, 512 x 512, that tiles. The same on every run; nothing is read from anywhere.
struct stone_wall {
    glm::ivec2 extent{0};
    std::vector<std::uint16_t> heights;
    image8 diffuse;             // RGB, sRGB
    double height_scale = 0.0;  // texels
};

[[nodiscard]] stone_wall make_stone_wall();

}  // namespace examples
