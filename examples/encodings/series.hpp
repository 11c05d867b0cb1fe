#pragma once

#include <optional>

#include <bumpshadow/encode/fourier.hpp>

#include "encodings/setups.hpp"

namespace examples {

// Fourier series over the bearing.
struct series_setup {
    bumpshadow::fourier encoding = {};
    bool tightened = true;  // ranges are the map's
    bool posted = false;    // only for the name
    int reduced = 1;        // extent over this; `side` has to be a multiple of it
    int side = patch_side;
    int margin = 0;
};
[[nodiscard]] setup series(const series_setup& s, std::optional<double> most = {});

}  // namespace examples
