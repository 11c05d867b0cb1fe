#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/encoding.hpp"

namespace examples {

// A way to shadow that pictures are made with.
struct image_setup {
    std::string family, name;
    encoding_settings settings;  // kind none: no shadows
    std::string snippet = {};    // the case of shader_cost
    bool pictured = false;
};

[[nodiscard]] std::vector<image_setup> image_setups(bool quick);

}  // namespace examples
