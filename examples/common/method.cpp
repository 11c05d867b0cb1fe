#include "common/method.hpp"

#include <algorithm>

#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>

namespace examples {

namespace bs = bumpshadow;

const std::string& name_of(method how) {
    return std::find_if(method_names.begin(), method_names.end(),
                        [&](const auto& entry) { return entry.second == how; })
        ->first;
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
