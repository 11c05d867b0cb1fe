#include "encodings/eight.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"
#include "encodings/planes.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

score measure(const sample_map& map, const eight_setup& s) {
    const horizons small = s.reduced > 1 ? reduced(map.every(32), s.encoding.scale, s.reduced) : horizons{};
    const bs::horizon_map slopes = s.reduced > 1 ? small.view : map.every(32);
    stored texture(bs::layout_of(s.encoding, slopes.extent));
    const bs::texture view = texture.view();
    const std::vector<glm::dvec2> directions = map.directions_of(32);
    require(s.averaged ? bs::pack_sine_layers_averaged(slopes, directions, s.encoding, {}, {&view, 1})
                       : bs::pack_sine_layers(slopes, directions, s.encoding, {}, {&view, 1}));
    const auto layer0 = texel_centers(texture, 0, map.extent), layer1 = texel_centers(texture, 1, map.extent);

    judge judge(map, s.encoding.scale, s.margin);
    std::vector<float> found(map.texels());
    const auto look = [&](const shader::bumpshadow_eight& factors) {
        for (std::size_t i = 0; i < found.size(); ++i)
            found[i] = shader::bumpshadow_sine_layers_factors(layer0[i], layer1[i], factors);
        return found.data();
    };
    if (!s.cube) {
        for (int b = 0; b < light_bearings; ++b)
            judge.look(b, look(shader::bumpshadow_factors_of_bearing(
                              shader_bearing(bs::bearing_function::exact, map.directions[std::size_t(b)]))));
        return judge.result();
    }
    // The factors of a cube depend on the elevation, too.
    stored cube(bs::layout_of(*s.cube));
    require(bs::write_factor_cube(*s.cube, cube.view()));
    for (std::size_t e = 0; e < light_elevations.size(); ++e) {
        const double angle = light_elevations[e] * std::numbers::pi / 180.0;
        for (int b = 0; b < light_bearings; ++b) {
            const glm::dvec2 d = map.directions[std::size_t(b)];
            const glm::vec3 light(d.x * std::cos(angle), d.y * std::cos(angle), std::sin(angle));
            const glm::vec4 texel = bs::sample_cube(cube.view(), {}, light);
            judge.look(
                b,
                look(s.cube->form == bs::factor_form::published ? shader::bumpshadow_factors_published_cube(texel)
                                                                : shader::bumpshadow_factors_biased_cube(texel)),
                e);
        }
    }
    return judge.result();
}

}  // namespace

setup eight(const eight_setup& s) {
    setup result;
    result.name =
        format("8 slices in 2 layers, %s%s, %s", name_of(s.encoding.scale.stored),
               name_of_limit(s.encoding.scale).c_str(), s.averaged ? "five of 32 averaged (Lengyel)" : "fitted to 32");
    if (s.cube) result.name += s.cube->form == bs::factor_form::published ? ", published cube" : ", biased cube";
    if (s.reduced > 1) result.name += format(", extent / %d", s.reduced);
    result.bytes = 8.0 / (s.reduced * s.reduced);
    result.fetches = bs::fetches(s.encoding) + (s.cube ? 1 : 0);
    result.side = s.side;
    result.margin = s.margin;
    result.measure = [s](const codecs&, std::span<const sample_map> maps) {
        return each_map(maps, [&](const sample_map& map) { return measure(map, s); });
    };
    return result;
}

setup published_sine_layers(int side, int margin) {
    eight_setup s;
    s.side = side;
    s.margin = margin;
    return eight(s);
}

}  // namespace examples
