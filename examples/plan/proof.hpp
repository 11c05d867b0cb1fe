#pragma once

#include <string>
#include <vector>

#include <bumpshadow/plan/recipe.hpp>

#include "common/encoding.hpp"
#include "common/heights.hpp"
#include "plan/measured.hpp"

namespace examples {

// What a set-up costs and how far it is off, on one map. Seconds are of the processor, on one thread.
struct set_up_figures {
    measured_error error;
    double bytes = 0.0;  // a texel of the height map
    double bake_seconds = 0.0, pack_seconds = 0.0;
    double gpu_cost = 0.0;
    int fetches = 0;
};

struct planned_map {
    bumpshadow::recipe how;
    set_up_figures figures;
    double plan_seconds = 0.0;
};

// Plans for a map; with `measure` also bakes and packs it and measures the error. Throws failure.
[[nodiscard]] planned_map plan_map(const height_samples& samples, const height_source& source,
                                   const bumpshadow::scene& wanted, const lit_pixels* measure);

// One scene on one map, beside 16 slices of 8 bits at full size with their usual bake.
struct proof_row {
    std::string scene, map;
    glm::ivec2 extent{0};
    double asked = 0.0;  // mismatch
    planned_map plan;
    set_up_figures usual;
    double sixteen_seconds = 0.0;  // the bake of 16 bearings

    // Within 20 % of what is measured, or 0.1 percentage points.
    [[nodiscard]] bool agrees() const;
    [[nodiscard]] double bytes_saved() const { return 1.0 - plan.figures.bytes / usual.bytes; }
    [[nodiscard]] double bake_saved() const { return 1.0 - plan.figures.bake_seconds / usual.bake_seconds; }
    [[nodiscard]] double work_saved() const;  // bake and pack
    [[nodiscard]] double excess() const { return plan.figures.error.mismatch / asked - 1.0; }
};

// A bar and whether it holds.
struct proof_line {
    std::string text;
    bool held = false;
};

struct proof {
    std::vector<proof_row> rows;
    std::vector<proof_line> lines;
};

// Runs all scenes on all maps of the folder that BUMPSHADOW_HEIGHT_MAPS names. Throws failure.
[[nodiscard]] proof run_proof();

[[nodiscard]] std::string table_of(const proof& all);
[[nodiscard]] std::string json_of(const proof& all);
[[nodiscard]] std::string json_of(const planned_map& one, bool measured);

}  // namespace examples
