#pragma once

#include <filesystem>
#include <vector>

#include "common/heights.hpp"

namespace examples {

// The height maps of a folder, as its MANIFEST.tsv describes them: tab-separated, a line of column names and one line
// for each map, with the columns file, height_scale, texel_size ("x y") and tiles (yes: repeat, no: clamp); other
// columns are ignored. Throws failure where the file cannot be read or understood.
[[nodiscard]] std::vector<height_source> read_manifest(const std::filesystem::path& folder);

}  // namespace examples
