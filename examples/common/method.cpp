#include "common/method.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>

#include "common/arguments.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

const std::vector<std::pair<std::string, method>> method_names{{"cascade", method::cascade},
                                                               {"exact", method::exact},
                                                               {"sweep", method::sweep},
                                                               {"sweep-classic", method::sweep_classic},
                                                               {"neighborhood", method::neighborhood}};

}  // namespace

const std::string& name_of(method how) {
    return std::find_if(method_names.begin(), method_names.end(),
                        [&](const auto& entry) { return entry.second == how; })
        ->first;
}

void add_horizon_options(CLI::App& app, horizon_settings& settings) {
    add_choice(app, "--method", settings.how, method_names, "how horizons are found")->type_name("METHOD");
    app.add_option("--steps", settings.options.steps, "cascade: texels of a level that it looks at; more is finer")
        ->check(whole_number(1, 1 << 20))
        ->capture_default_str()
        ->type_name("K");
    app.add_option("--radius", settings.options.radius,
                   "occluders farther than this are left out, in the unit of --texel-size (default: none are)")
        ->check(positive_or_infinite_number())
        ->type_name("R");
    app.add_option_function<std::pair<double, double>>(
           "--curvature",
           [&settings](const auto& curvature) {
               settings.options.curvature = {curvature.first, curvature.second};
           },
           "curvature of the base surface along x and y, 1/unit (default 0 0)")
        ->check(finite_number())
        ->type_name("KX KY");
}

void bake_horizons(const height_samples& samples, const height_source& source, const horizon_settings& settings,
                   std::span<const glm::dvec2> directions, const bs::horizon_map& out, const progress& execute) {
    const auto bake = [&](const auto& map) {
        const bs::bake_options& options = settings.options;
        switch (settings.how) {
            case method::exact: return bs::bake_exact(map, directions, out, options, execute);
            case method::sweep: return bs::bake_sweep(map, directions, out, options, execute);
            case method::sweep_classic: return bs::bake_sweep_classic(map, directions, out, options, execute);
            case method::neighborhood: return bs::bake_neighborhood(map, directions, out, options, execute);
            case method::cascade: break;
        }
        return bs::bake_cascade(map, directions, out, options, execute);
    };
    const bs::status status = with_height_map(samples, source, source.height_scale.value_or(1.0), bake);
    require(status);
}

}  // namespace examples
