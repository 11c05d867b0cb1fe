#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "common/heights.hpp"

namespace examples {

// The height maps of a folder, as its MANIFEST.tsv describes them: tab-separated, a line of column names and one line
// for each map, with the columns file, height_scale, texel_size ("x y") and tiles (yes: repeat, no: clamp); other
// columns are ignored. Throws failure where the file cannot be read or understood.
[[nodiscard]] std::vector<height_source> read_manifest(const std::filesystem::path& folder);

// The folder that the environment variable BUMPSHADOW_HEIGHT_MAPS names, if it has a manifest; else empty.
[[nodiscard]] std::filesystem::path known_folder();

// File name without folder and extension.
[[nodiscard]] std::string name_of(const height_source& map);

// The maps of that folder whose names begin with these, in this order; none where there is no such folder. Throws
// failure where one is missing.
[[nodiscard]] std::vector<height_source> known_maps(std::initializer_list<const char*> names);

}  // namespace examples
