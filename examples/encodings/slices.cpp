#include "encodings/slices.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>

#include <bumpshadow/encode/stb_blocks.hpp>

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "common/report_text.hpp"
#include "encodings/seen.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

std::vector<float> first_channel(const std::vector<glm::vec4>& texels) {
    std::vector<float> values(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) values[i] = texels[i].x;
    return values;
}

void recompress_by_stb(std::vector<float>& plane, glm::ivec2 extent) {
    for (int y = 0; y < extent.y; y += 4)
        for (int x = 0; x < extent.x; x += 4) {
            std::array<float, 16> values;
            std::array<std::byte, 8> block;
            const auto at = [&](int i) -> float& {
                return plane[std::size_t(y + i / 4) * std::size_t(extent.x) + std::size_t(x + i % 4)];
            };
            for (int i = 0; i < 16; ++i) values[std::size_t(i)] = at(i);
            bs::encode_bc4_stb(values.data(), block.data());
            bs::decode_bc4(block.data(), values.data());
            for (int i = 0; i < 16; ++i) at(i) = values[std::size_t(i)];
        }
}

double measure_volume(const sample_map& map, const volume_setup& s, int margin) {
    bs::tangent_volume encoding = s.encoding;
    const bool by_stb = encoding.format == bs::texel_format::bc4 && s.blocks == block_encoder::stb;
    if (by_stb) encoding.format = bs::texel_format::r16;
    if (s.most == ceiling::steepest) encoding.scale.max_slope = map.steepest;

    bs::horizon_map slopes = map.every(s.directions);
    std::vector<float> small;
    if (s.reduced > 1) {
        const glm::ivec2 extent = bs::reduced_extent(map.extent, s.reduced);
        small.resize(bs::required_size(extent, s.directions));
        const bs::horizon_map out{.values = small, .extent = extent, .bearings = s.directions};
        expect(bs::reduce(slopes, encoding.scale, out));
        slopes = out;
    }
    stored texture(bs::layout_of(encoding, slopes.extent));
    bs::pack_options options;
    options.fit = s.fit;
    expect(bs::pack_tangent_volume(slopes, map.directions_of(s.directions), encoding, options, texture.view()));

    const int count = encoding.slices.count;
    std::vector<std::vector<float>> planes;
    for (int i = 0; i < count; ++i) {
        planes.push_back(first_channel(texel_centers(texture, i, map.extent)));
        if (by_stb) recompress_by_stb(planes.back(), map.extent);
    }
    seen found = unseen(map, encoding.scale);
    float* to = found.horizons.data();
    for (const glm::dvec2 d : map.directions) {
        const glm::vec3 taps = shader::bumpshadow_tangent_layers(shader_bearing(encoding.slices.function, d),
                                                                 float(encoding.slices.phase), float(count));
        const std::vector<float>&here = planes[std::size_t(taps.x)], &next = planes[std::size_t(taps.y)];
        for (std::size_t i = 0; i < here.size(); ++i)
            *to++ = shader::bumpshadow_tangent_horizon(here[i], next[i], taps.z);
    }
    return mismatch(map, found, margin);
}

double measure_best_volume(const sample_map& map, volume_setup s, int margin) {
    if (s.most != ceiling::best) return measure_volume(map, s, margin);
    s.most = ceiling::fixed;
    double least = std::numeric_limits<double>::infinity();
    for (const float slope : {1.75f, 2.0f, 2.5f, 3.0f, 4.0f, 6.0f, 9.0f}) {
        s.encoding.scale.max_slope = slope;
        least = std::min(least, measure_volume(map, s, margin));
    }
    return least;
}

const char* name_of(bs::texel_format format) {
    switch (format) {
        case bs::texel_format::r16: return "R16";
        case bs::texel_format::r16f: return "half";
        case bs::texel_format::bc4: return "BC4";
        default: break;
    }
    return "R8";
}

std::string name_of(bs::slice_fit fit, int directions) {
    if (fit == bs::slice_fit::point) return "point";
    return format("fitted to %d", directions) + (fit == bs::slice_fit::least_angle ? " by angle" : "");
}

image8 stacked(std::span<const stored> textures) {
    const bs::texture_layout& l = textures.front().layout;
    image8 all({l.extent.x, l.extent.y * l.layers * int(textures.size())}, 4);
    auto* to = all.samples.data();
    for (const stored& texture : textures)
        to = std::transform(texture.bytes.begin(), texture.bytes.end(), to,
                            [](std::byte b) { return std::to_integer<std::uint8_t>(b); });
    return all;
}

void unstack(const image8& all, std::span<stored> textures) {
    const auto* from = all.samples.data();
    for (stored& texture : textures)
        for (std::byte& b : texture.bytes) b = static_cast<std::byte>(*from++);
}

double judge_layers(const sample_map& map, const bs::slice_layers& encoding, const stored& texture) {
    std::vector<std::vector<glm::vec4>> layers;
    for (int i = 0; i < texture.layout.layers; ++i) layers.push_back(texel_centers(texture, i, map.extent));
    seen found = unseen(map, encoding.scale);
    float* to = found.horizons.data();
    const float count = float(encoding.slices.count);
    for (const glm::dvec2 d : map.directions) {
        const float position = shader::bumpshadow_slice_position(shader_bearing(encoding.slices.function, d),
                                                                 float(encoding.slices.phase), count);
        if (encoding.grouping == bs::slice_grouping::four) {
            const glm::vec3 at = shader::bumpshadow_grouped_layers(position, float(texture.layout.layers));
            const auto &here = layers[std::size_t(at.x)], &next = layers[std::size_t(at.y)];
            for (std::size_t i = 0; i < here.size(); ++i)
                *to++ = shader::bumpshadow_grouped_horizon(here[i], next[i].x, at.z);
        } else {
            const glm::vec2 at = shader::bumpshadow_overlapping_layer(position);
            for (const glm::vec4& values : layers[std::size_t(at.x)])
                *to++ = shader::bumpshadow_overlapping_horizon(values, at.y);
        }
    }
    return mismatch(map, found);
}

}  // namespace

setup volume(const volume_setup& s, std::optional<double> most) {
    const bs::tangent_volume& e = s.encoding;
    setup result;
    result.name = format("%d slices, %s, %s, %s", e.slices.count, name_of(e.scale.stored),
                         name_of(s.fit, s.directions).c_str(), name_of(e.format));
    if (s.blocks == block_encoder::stb) result.name += " by stb";
    result.name += s.most == ceiling::steepest ? ", to the steepest"
                   : s.most == ceiling::best   ? ", to the best for the map"
                                               : name_of_limit(e.scale);
    if (s.reduced > 1) result.name += format(", extent / %d", s.reduced);
    result.side = s.reduced > 1 ? 56 : patch_side;
    result.margin = s.reduced > 1 ? s.reduced : 0;
    constexpr glm::ivec2 some{840, 840};  // a multiple of all factors and blocks
    result.bytes = bs::layout_of(e, some / s.reduced).bytes_per_texel(some);
    result.fetches = bs::fetches(e);
    result.most = most;
    result.measure = [s, margin = result.margin](const codecs&, std::span<const sample_map> maps) {
        return each_map(maps, [&](const sample_map& map) { return measure_best_volume(map, s, margin); });
    };
    return result;
}

setup layers(const layers_setup& s, std::optional<double> most) {
    const bs::slice_layers& e = s.encoding;
    const std::optional<codec> compressed = s.compressed;
    const std::string& block = s.block;
    setup result;
    const int planes = bs::layout_of(e, {1, 1}).layers;
    result.name = format("%d slices in %d %s layers, %s", e.slices.count, planes,
                         e.grouping == bs::slice_grouping::four ? "grouped" : "overlapping", name_of(e.scale.stored));
    result.name += name_of_limit(e.scale) + (!compressed                ? ", RGBA8"
                                             : compressed == codec::bc7 ? ", BC7"
                                                                        : ", ASTC " + block);
    const int columns = compressed == codec::bc7 ? 4 : std::atoi(block.c_str());
    const int rows = compressed == codec::bc7 ? 4 : std::atoi(block.c_str() + block.find('x') + 1);
    result.bytes = planes * (compressed ? 16.0 / (columns * rows) : 4.0);
    // The last block of a row or column must not be smaller than the others.
    if (compressed && (patch_side % columns != 0 || patch_side % rows != 0))
        result.side = patch_side / columns * columns;
    result.fetches = bs::fetches(e);
    result.most = most;
    result.needs = compressed;
    result.measure = [s](const codecs& programs, std::span<const sample_map> maps) {
        std::vector<stored> textures(maps.size(), stored({}));
        each_map(maps, [&](const sample_map& map) {
            stored& texture = textures[std::size_t(&map - maps.data())];
            texture = stored(bs::layout_of(s.encoding, map.extent));
            expect(bs::pack_slice_layers(map.every(s.directions), map.directions_of(s.directions), s.encoding, {},
                                         texture.view()));
            return 0.0;
        });
        if (s.compressed) {
            const std::string& program = s.compressed == codec::astc ? *programs.astc : *programs.bc7;
            unstack(recompress(*s.compressed, program, s.block, stacked(textures)), textures);
        }
        return each_map(maps, [&](const sample_map& map) {
            return judge_layers(map, s.encoding, textures[std::size_t(&map - maps.data())]);
        });
    };
    return result;
}

}  // namespace examples
