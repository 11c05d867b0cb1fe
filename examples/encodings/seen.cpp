#include "encodings/seen.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <bumpshadow/shader/shader.hpp>

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr double degree = std::numbers::pi / 180.0;

float light_of(bs::quantity stored, glm::vec3 light) {
    switch (stored) {
        case bs::quantity::sine: return bs::shader::bumpshadow_sine(light);
        case bs::quantity::angle: return bs::shader::bumpshadow_angle(light);
        case bs::quantity::slope: break;
    }
    return bs::shader::bumpshadow_slope(light);
}

}  // namespace

seen unseen(const sample_map& map, const bs::horizon_scale& scale) {
    seen result;
    result.horizons.resize(map.slopes.size());
    const float unit = bs::stored_scale(scale);
    for (const glm::dvec2 d : map.directions) {
        light_values values;
        for (std::size_t e = 0; e < values.size(); ++e) {
            const double angle = light_elevations[e] * degree, along = std::cos(angle);
            values[e] = light_of(scale.stored, glm::vec3(d.x * along, d.y * along, std::sin(angle))) * unit;
        }
        result.lights.push_back(values);
    }
    return result;
}

double mismatch(const sample_map& map, const seen& found, int margin, int only) {
    const std::size_t first = only < 0 ? 0 : std::size_t(only), end = only < 0 ? light_elevations.size() : first + 1;
    std::size_t wrong = 0, all = 0;
    const float* exact = map.slopes.data();
    const float* horizon = found.horizons.data();
    light_values slopes;
    for (std::size_t e = 0; e < slopes.size(); ++e) slopes[e] = float(std::tan(light_elevations[e] * degree));
    for (int b = 0; b < light_bearings; ++b) {
        const light_values& lights = found.lights[std::size_t(b)];
        for (int y = 0; y < map.extent.y; ++y, exact += map.extent.x, horizon += map.extent.x) {
            if (y < margin || y >= map.extent.y - margin) continue;
            for (int x = 0; x < map.extent.x; ++x) {
                const int in_patch = x % map.side;
                if (in_patch < margin || in_patch >= map.side - margin) continue;
                for (std::size_t e = first; e < end; ++e) {
                    const bool lit = bs::shader::bumpshadow_shadow_hard(lights[e], horizon[x]) > 0.5f;
                    wrong += lit != (slopes[e] >= exact[x]) ? 1u : 0u;
                }
                all += end - first;
            }
        }
    }
    return 100.0 * double(wrong) / double(all);
}

}  // namespace examples
