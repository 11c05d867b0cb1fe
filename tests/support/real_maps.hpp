#pragma once

// Real height maps, for tests that are linked with the programs (BUMPSHADOW_TESTS_READ_IMAGES), which read images.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "common/heights.hpp"
#include "common/manifest.hpp"

// use(name, height_map) for each map of the folder BUMPSHADOW_HEIGHT_MAPS whose name is among `names`, or for all of
// them; says so where there is no such folder.
template <class Use>
void for_real_maps(const std::vector<std::string_view>& names, const Use& use) {
    const std::filesystem::path folder = examples::known_folder();
    if (folder.empty()) {
        MESSAGE("skipped: BUMPSHADOW_HEIGHT_MAPS does not name a folder of height maps");
        return;
    }
    for (const examples::height_source& source : examples::read_manifest(folder)) {
        const std::string name = examples::name_of(source);
        if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
        const auto samples = examples::read_heights(source);
        examples::with_height_map(samples, source, *source.height_scale, [&](const auto& map) { use(name, map); });
    }
}
