#pragma once

#include <optional>
#include <string>

#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>

#include "encodings/setups.hpp"

namespace examples {

// Slices of one channel.
// What max_slope is: that of the encoding, the steepest horizon of the map, or what gives the least mismatch.
enum class ceiling { fixed, steepest, best };
enum class block_encoder { library, stb };

struct volume_setup {
    bumpshadow::tangent_volume encoding = {};
    int directions = 32;
    bumpshadow::slice_fit fit = bumpshadow::slice_fit::least_squares;
    ceiling most = ceiling::fixed;
    block_encoder blocks = block_encoder::library;
    int reduced = 1;  // extent over this
};

[[nodiscard]] setup volume(const volume_setup& s, std::optional<double> most = {});

// Slices in the channels of layers.
struct layers_setup {
    bumpshadow::slice_layers encoding = {};
    int directions = 96;
    std::optional<codec> compressed = {};
    std::string block = {};  // ASTC
};

[[nodiscard]] setup layers(const layers_setup& s, std::optional<double> most = {});

}  // namespace examples
