#include "encodings/series.hpp"

#include <cstddef>

#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"
#include "encodings/seen.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

constexpr int directions = 32;

// Texels of the textures of a series, [texture][y][x], as coefficients.
std::vector<std::vector<glm::vec4>> coefficients_of(const sample_map& map, const series_setup& s,
                                                    bs::fourier& encoding) {
    const bs::horizon_map slopes = map.every(directions);
    const std::vector<glm::dvec2> ways = map.directions_of(directions);
    if (s.tightened) expect(bs::tighten_ranges(slopes, ways, encoding, {}));
    std::vector<stored> textures;
    std::vector<bs::texture> views;
    for (int i = 0; i < bs::texture_count(encoding); ++i)
        textures.emplace_back(bs::layout_of(encoding, map.extent, 1, i));
    for (stored& texture : textures) views.push_back(texture.view());
    expect(bs::pack_fourier(slopes, ways, encoding, {}, views));

    const bs::fourier_decoding decoding = bs::decoding_of(encoding);
    std::vector<std::vector<glm::vec4>> all;
    for (std::size_t t = 0; t < textures.size(); ++t) {
        all.push_back(texel_centers(textures[t], 0, map.extent));
        const bool one = textures[t].layout.format == bs::texel_format::r8;
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

double measure(const sample_map& map, const series_setup& s) {
    bs::fourier encoding = s.encoding;
    const auto texels = coefficients_of(map, s, encoding);
    seen found = unseen(map, encoding.scale);
    float* to = found.horizons.data();
    const auto xyz = [](glm::vec4 v) { return glm::vec3(v.x, v.y, v.z); };
    for (const glm::dvec2 d : map.directions) {
        const glm::vec2 way = shader::bumpshadow_fourier_direction(glm::vec2(d));
        for (std::size_t i = 0; i < map.texels(); ++i) {
            const glm::vec4 first = texels[0][i];
            switch (encoding.coefficients) {
                case 3: *to++ = shader::bumpshadow_fourier_3(xyz(first), way); break;
                case 5: *to++ = shader::bumpshadow_fourier_5(first, texels[1][i].x, way); break;
                case 7: *to++ = shader::bumpshadow_fourier_7(first, xyz(texels[1][i]), way); break;
                default: *to++ = shader::bumpshadow_fourier_9(first, texels[1][i], texels[2][i].x, way); break;
            }
        }
    }
    return mismatch(map, found);
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
    for (int i = 0; i < bs::texture_count(e); ++i)
        result.bytes += bs::layout_of(e, {1, 1}, 1, i).bytes_per_texel({1, 1});
    result.fetches = bs::fetches(e);
    result.most = most;
    result.measure = [s](const codecs&, std::span<const sample_map> maps) {
        return each_map(maps, [&](const sample_map& map) { return measure(map, s); });
    };
    return result;
}

}  // namespace examples
