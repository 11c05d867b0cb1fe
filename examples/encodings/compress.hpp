#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/image.hpp"

namespace examples {

// Block compression of RGBA images by programs that are no part of this project: astcenc (Debian: astcenc), and bc7enc
// (npm: @gpu-tex-enc/bc).
enum class codec { astc, bc7 };

// Path of the program, where PATH has it.
[[nodiscard]] std::optional<std::string> find_codec(codec which);

// The image after compression and decompression. program: from find_codec; block: "4x4" and so on, ASTC only.
// Throws failure where the program fails.
[[nodiscard]] image8 recompress(codec which, const std::string& program, const std::string& block,
                                const image8& picture);

}  // namespace examples
