#pragma once

#include <string>
#include <vector>

#include "common/heights.hpp"
#include "report/findings.hpp"
#include "report/section.hpp"

namespace examples {

// The maps of a run, read, and those that could not be.
struct map_choice {
    std::vector<report_map> maps;
    std::vector<skipped_map> skipped;
};

// Files and folders as named on the command line; none: the demo's wall and, unless quick, four maps of the folder that
// BUMPSHADOW_HEIGHT_MAPS names. A folder gives the maps of its MANIFEST.tsv, which says their scales, or else its PNG
// files. `settings` holds for all other files. Every map that is left out is said on stderr. Throws failure where no
// map is left.
[[nodiscard]] map_choice choose_maps(const std::vector<std::string>& paths, const height_source& settings, bool quick);

[[nodiscard]] map_facts facts_of(const report_map& map);

}  // namespace examples
