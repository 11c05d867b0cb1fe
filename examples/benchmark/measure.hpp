#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <bumpshadow/horizon_map.hpp>

#include "common/heights.hpp"

namespace examples {

enum class method { sweep_classic, sweep, neighborhood, cascade, exact };

// One line of the table: a way to bake.
struct contender {
    std::string name = {};
    method how = method::cascade;
    int steps = bumpshadow::bake_options{}.steps;
    int bearings = 16;
    int threads = 1;
};

// Error of the elevation against the exact one, in degrees.
struct errors {
    double mean = 0.0;
    double percentile_99 = 0.0;
    double largest = 0.0;
    double bias = 0.0;  // mean with its sign: above 0 where horizons are too high
};

struct figures {
    contender who = {};
    double nanoseconds = 0.0;  // a sample: one texel in one bearing; median of the repeats
    double ratio = 0.0;        // times as fast as the yardstick; median over pairs of runs that follow each other
    errors error = {};
    std::size_t scratch = 0;  // bytes, the most that was held at any time
};

struct settings {
    int repeats = 5;
    int texels = 2048;  // of the sample that errors are measured on, with all bearings
};

inline constexpr int yardstick_bearings = 16;
inline constexpr int fine_steps = 48;

struct measurement {
    std::string name;  // of the map
    glm::ivec2 extent{0};
    std::size_t error_samples = 0;
    std::vector<figures> rows;    // the yardstick first, exact last
    double thread_speedup = 0.0;  // two threads against one, median over pairs of runs
    std::size_t scratch_4 = 0;    // bytes the cascade took for 4 bearings
    std::size_t scratch_32 = 0;   // and for 32

    [[nodiscard]] const figures& row(method how, int steps, int threads) const;
};

// Runs everything on one map. Throws failure where something cannot be run.
[[nodiscard]] measurement measure(const std::string& name, const height_samples& heights, const height_source& source,
                                  double height_scale, const settings& how);

}  // namespace examples
