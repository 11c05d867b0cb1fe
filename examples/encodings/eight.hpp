#pragma once

#include <optional>

#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/factor_cube.hpp>

#include "encodings/setups.hpp"

namespace examples {

// Eight horizons in two layers.
struct eight_setup {
    bumpshadow::sine_layers encoding = {};
    bool averaged = true;                              // as published, or else fitted to 32
    std::optional<bumpshadow::factor_cube> cube = {};  // none: computed factors
    int side = patch_side;
    int margin = 0;
    int reduced = 1;  // extent over this; `side` has to be a multiple of it
};
[[nodiscard]] setup eight(const eight_setup& s);

}  // namespace examples
