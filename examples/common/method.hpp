#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/ext/vector_double2.hpp>

#include <bumpshadow/horizon_map.hpp>

#include "common/heights.hpp"
#include "common/progress.hpp"

// Declared alone: CLI11 takes seconds to compile.
namespace CLI {
class App;
}

namespace examples {

enum class method { exact, cascade, sweep, sweep_classic, neighborhood };

// The words of the command line.
inline const std::vector<std::pair<std::string, method>> method_names{{"cascade", method::cascade},
                                                                      {"exact", method::exact},
                                                                      {"sweep", method::sweep},
                                                                      {"sweep-classic", method::sweep_classic},
                                                                      {"neighborhood", method::neighborhood}};

// How a program finds horizons.
struct horizon_settings {
    method how = method::cascade;
    bumpshadow::bake_options options;
};

[[nodiscard]] const std::string& name_of(method how);

// The options --method --steps --radius --curvature, the same in every program.
void add_horizon_options(CLI::App& app, horizon_settings& settings);

// Bakes into `out`, which has the extent of the map. Throws failure.
void bake_horizons(const height_samples& samples, const height_source& source, const horizon_settings& settings,
                   std::span<const glm::dvec2> directions, const bumpshadow::horizon_map& out, const progress& execute);

}  // namespace examples
