#include "encodings/eight.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"
#include "encodings/seen.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

double measure(const sample_map& map, const eight_setup& s) {
    stored texture(bs::layout_of(s.encoding, map.extent));
    const bs::texture view = texture.view();
    const std::vector<glm::dvec2> directions = map.directions_of(32);
    expect(s.averaged ? bs::pack_sine_layers_averaged(map.every(32), directions, s.encoding, {}, {&view, 1})
                      : bs::pack_sine_layers(map.every(32), directions, s.encoding, {}, {&view, 1}));
    const auto layer0 = texel_centers(texture, 0, map.extent), layer1 = texel_centers(texture, 1, map.extent);

    seen found = unseen(map, s.encoding.scale);
    const auto look = [&](const auto& factors_of) {
        float* to = found.horizons.data();
        for (const glm::dvec2 d : map.directions) {
            const shader::bumpshadow_eight factors = factors_of(d);
            for (std::size_t i = 0; i < layer0.size(); ++i)
                *to++ = shader::bumpshadow_sine_layers_factors(layer0[i], layer1[i], factors);
        }
    };
    if (!s.cube) {
        look([](glm::dvec2 d) {
            return shader::bumpshadow_factors_of_bearing(shader_bearing(bs::bearing_function::exact, d));
        });
        return mismatch(map, found, s.margin);
    }
    // The factors of a cube depend on the elevation, too.
    stored cube(bs::layout_of(*s.cube));
    expect(bs::write_factor_cube(*s.cube, cube.view()));
    double sum = 0.0;
    for (std::size_t e = 0; e < light_elevations.size(); ++e) {
        const double angle = light_elevations[e] * std::numbers::pi / 180.0;
        look([&](glm::dvec2 d) {
            const glm::vec3 light(d.x * std::cos(angle), d.y * std::cos(angle), std::sin(angle));
            const glm::vec4 texel = bs::sample_cube(cube.view(), {}, light);
            return s.cube->form == bs::factor_form::published ? shader::bumpshadow_factors_published_cube(texel)
                                                              : shader::bumpshadow_factors_biased_cube(texel);
        });
        sum += mismatch(map, found, s.margin, int(e));
    }
    return sum / double(light_elevations.size());
}

}  // namespace

setup eight(const eight_setup& s) {
    setup result;
    result.name =
        format("8 slices in 2 layers, %s%s, %s", name_of(s.encoding.scale.stored),
               name_of_limit(s.encoding.scale).c_str(), s.averaged ? "five of 32 averaged (Lengyel)" : "fitted to 32");
    if (s.cube) result.name += s.cube->form == bs::factor_form::published ? ", published cube" : ", biased cube";
    result.bytes = 8.0;
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
