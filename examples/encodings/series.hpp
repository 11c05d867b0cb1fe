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
};
[[nodiscard]] setup series(const series_setup& s, std::optional<double> most = {});

}  // namespace examples
