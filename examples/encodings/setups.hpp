#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "encodings/compress.hpp"
#include "encodings/sample.hpp"
#include "encodings/score.hpp"

namespace examples {

// Programs that compress blocks, where they were found.
struct codecs {
    std::optional<std::string> astc = find_codec(codec::astc), bc7 = find_codec(codec::bc7);
};

// A way to store horizons and to read them again.
struct setup {
    std::string name;
    double bytes = 0.0;  // a texel
    int fetches = 0;     // for one horizon
    // Of the mismatch, to that of Lengyel's layout: what has to be reached.
    std::optional<double> most = {};
    std::optional<codec> needs = {};
    int side = patch_side;  // texels of a patch that are used
    int margin = 0;         // texels at the border of a patch that are not judged
    // Of each map.
    std::function<std::vector<score>(const codecs&, std::span<const sample_map>)> measure;
};

struct section {
    std::string title;
    std::vector<setup> setups;
};

// Lengyel's layout: eight sines, each the average of five of 32, in 8 bits; factors computed. All others are compared
// with it.
[[nodiscard]] setup published_sine_layers(int side = patch_side, int margin = 0);

// What the table shows.
[[nodiscard]] std::vector<section> all_setups();

}  // namespace examples
