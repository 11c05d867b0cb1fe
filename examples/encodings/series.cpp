#include "encodings/series.hpp"

#include <cstddef>

#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"
#include "encodings/planes.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

constexpr int directions = 32;

// Texels of the textures of a series, [texture][y][x], as coefficients.
std::vector<std::vector<glm::vec4>> coefficients_of(const sample_map& map, const series_setup& s,
                                                    bs::fourier& encoding) {
    const horizons small = s.reduced > 1 ? reduced(map.every(directions), encoding.scale, s.reduced) : horizons{};
    const bs::horizon_map slopes = s.reduced > 1 ? small.view : map.every(directions);
    const std::vector<glm::dvec2> ways = map.directions_of(directions);
    if (s.tightened) require(bs::tighten_ranges(slopes, ways, encoding, {}));
    std::vector<stored> textures;
    std::vector<bs::texture> views;
    for (int i = 0; i < bs::texture_count(encoding); ++i)
        textures.emplace_back(bs::layout_of(encoding, slopes.extent, 1, i));
    for (stored& texture : textures) views.push_back(texture.view());
    require(bs::pack_fourier(slopes, ways, encoding, {}, views));

    const bs::fourier_decoding decoding = bs::decoding_of(encoding);
    std::vector<std::vector<glm::vec4>> all;
    for (std::size_t t = 0; t < textures.size(); ++t) {
        all.push_back(texel_centers(textures[t], 0, map.extent));
        const bool one = bs::channels_of(encoding, int(t))[1] < 0;
        for (glm::vec4& texel : all.back()) {
            if (one)
                texel.x = encoding.square_root ? shader::bumpshadow_fourier_root_constant(
                                                     texel.x, decoding.constant_scale, decoding.constant_offset)
                                               : texel.x * decoding.constant_scale + decoding.constant_offset;
            else
                texel = encoding.square_root
                            ? shader::bumpshadow_fourier_root_texel(texel, decoding.scale[t], decoding.offset[t])
                            : shader::bumpshadow_fourier_texel(texel, decoding.scale[t], decoding.offset[t]);
        }
    }
    return all;
}

score measure(const sample_map& map, const series_setup& s) {
    bs::fourier encoding = s.encoding;
    const auto texels = coefficients_of(map, s, encoding);
    judge judge(map, encoding.scale, s.margin);
    std::vector<float> found(map.texels());
    const auto xyz = [](glm::vec4 v) { return glm::vec3(v.x, v.y, v.z); };
    for (int b = 0; b < light_bearings; ++b) {
        const glm::vec2 way = shader::bumpshadow_fourier_direction(glm::vec2(map.directions[std::size_t(b)]));
        for (std::size_t i = 0; i < map.texels(); ++i) {
            const glm::vec4 first = texels[0][i];
            switch (encoding.coefficients) {
                case 3: found[i] = shader::bumpshadow_fourier_3(xyz(first), way); break;
                case 5: found[i] = shader::bumpshadow_fourier_5(first, texels[1][i].x, way); break;
                case 7: found[i] = shader::bumpshadow_fourier_7(first, xyz(texels[1][i]), way); break;
                default: found[i] = shader::bumpshadow_fourier_9(first, texels[1][i], texels[2][i].x, way); break;
            }
        }
        judge.look(b, found.data());
    }
    return judge.result();
}

}  // namespace

setup series(const series_setup& s, std::optional<double> most) {
    setup result;
    const bs::fourier& e = s.encoding;
    result.name = format("%d coefficients, %s%s%s, %s", e.coefficients, name_of(e.scale.stored),
                         name_of_limit(e.scale).c_str(), e.square_root ? ", signed roots" : "",
                         s.posted      ? "ranges -1 to 1 (the post)"
                         : s.tightened ? "ranges of the map"
                                       : "proven ranges");
    if (e.bits == 16) result.name += ", 16 bits";
    if (s.reduced > 1) result.name += format(", extent / %d", s.reduced);
    result.side = s.side;
    result.margin = s.margin;
    for (int i = 0; i < bs::texture_count(e); ++i)
        result.bytes += bs::layout_of(e, {1, 1}, 1, i).bytes_per_texel({1, 1}) / (s.reduced * s.reduced);
    result.fetches = bs::fetches(e);
    result.most = most;
    result.measure = [s](const codecs&, std::span<const sample_map> maps) {
        return each_map(maps, [&](const sample_map& map) { return measure(map, s); });
    };
    return result;
}

}  // namespace examples
