#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/plan/recipe.hpp>

#include "common/encoding.hpp"
#include "common/heights.hpp"
#include "common/plan_json.hpp"

// Declared alone: CLI11 takes seconds to compile.
namespace CLI {
class App;
}

namespace examples {

// Where a program has its recipe from, and where it writes it to.
struct recipe_settings {
    std::string plan, recipe, save;  // files; empty: not given

    [[nodiscard]] bool given() const { return !plan.empty() || !recipe.empty(); }
};

// The options --plan --recipe --save-recipe, the same in every program.
void add_recipe_options(CLI::App& app, recipe_settings& settings);

// Throws failure where, beside a recipe, there is an option that it decides: any but those that say what the heights
// mean, where to write, how many threads there are, and `kept`. Also where files that are read would be written.
void check_recipe_options(const CLI::App& app, const recipe_settings& settings, const std::string& heights,
                          const std::string& output, std::initializer_list<const char*> kept);

// Plans for a map. Throws failure.
[[nodiscard]] bumpshadow::recipe plan_for(const height_samples& samples, const height_source& source,
                                          const bumpshadow::scene& wanted);
// Plans, or reads the recipe. Throws failure.
[[nodiscard]] bumpshadow::recipe recipe_for(const height_samples& samples, const height_source& source,
                                            const recipe_settings& settings);

// Horizons as a recipe bakes them.
struct recipe_horizons {
    std::vector<float> values;
    bumpshadow::horizon_map map;
    std::vector<glm::dvec2> directions;
};

// Bakes what a recipe with shadows needs, and packs it; together bake_recipe. Throws failure.
[[nodiscard]] recipe_horizons bake_for(const height_samples& samples, const height_source& source,
                                       const bumpshadow::recipe& r, int threads);
[[nodiscard]] encoded pack_for(recipe_horizons horizons, const bumpshadow::recipe& r, glm::ivec2 extent, int threads);
[[nodiscard]] encoded bake_recipe(const height_samples& samples, const height_source& source,
                                  const bumpshadow::recipe& r, int threads);

// Why the recipe is as it is, and what is predicted, a line each.
[[nodiscard]] std::string text_of(const bumpshadow::recipe& r);

}  // namespace examples
