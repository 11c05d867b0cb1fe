#include "encodings/stored.hpp"

#include <cmath>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"

namespace examples {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

std::vector<glm::vec4> texel_centers(const stored& texture, int index, glm::ivec2 extent) {
    const bs::const_texture from = texture.view();
    std::vector<glm::vec4> values;
    values.reserve(std::size_t(extent.x) * std::size_t(extent.y));
    const bool volume = from.layout.kind == bs::texture_kind::volume;
    const glm::ivec2 own = from.layout.extent;
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec2 uv{(float(x) + 0.5f) / float(extent.x), (float(y) + 0.5f) / float(extent.y)};
            if (own == extent)
                values.push_back(volume ? bs::fetch(from, {x, y, index}) : bs::fetch(from, {x, y, 0}, 0, index));
            else if (volume)
                values.push_back(
                    bs::sample_volume(from, {}, {uv.x, uv.y, (float(index) + 0.5f) / float(from.layout.depth)}));
            else
                values.push_back(bs::sample(from, {}, uv, 0.0f, index));
        }
    return values;
}

float shader_bearing(bs::bearing_function function, glm::dvec2 direction) {
    const glm::vec2 v(direction);
    switch (function) {
        case bs::bearing_function::quintic: return shader::bumpshadow_bearing_quintic(v);
        case bs::bearing_function::cubic: return shader::bumpshadow_bearing_cubic(v);
        case bs::bearing_function::octant: return shader::bumpshadow_bearing_octant(v);
        case bs::bearing_function::diamond: return shader::bumpshadow_bearing_diamond(v);
        case bs::bearing_function::exact: break;
    }
    return shader::bumpshadow_bearing_exact(v);
}

const char* name_of(bs::quantity stored) {
    switch (stored) {
        case bs::quantity::sine: return "sine";
        case bs::quantity::angle: return "angle";
        case bs::quantity::slope: break;
    }
    return "slope";
}

std::string name_of_limit(const bs::horizon_scale& scale) {
    if (std::isinf(scale.max_slope)) return "";
    return format(", to %g", double(scale.max_slope));
}

}  // namespace examples
