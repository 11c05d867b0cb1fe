#pragma once

#include <cstdint>
#include <vector>

#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>

namespace examples {

// A wall of hewn stones in courses, 512 x 512, that tiles. The same on every run; nothing is read from anywhere.
struct stone_wall {
    glm::ivec2 extent{0};
    std::vector<std::uint16_t> heights;
    std::vector<glm::vec3> albedo;  // linear RGB
    double height_scale = 0.0;      // texels
};

[[nodiscard]] stone_wall make_stone_wall();

}  // namespace examples
