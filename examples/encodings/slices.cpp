#include "encodings/slices.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "common/report_text.hpp"
#include "encodings/planes.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

score measure_volume(const sample_map& map, const volume_setup& s, int margin) {
    bs::horizon_scale scale = s.encoding.scale;
    if (s.most == ceiling::steepest) scale.max_slope = map.steepest;
    const bs::horizon_map slopes = map.every(s.directions);
    const horizons small = s.reduced > 1 ? reduced(slopes, scale, s.reduced) : horizons{};
    planes slices = fit_planes(s.reduced > 1 ? small.view : slopes, map.directions_of(s.directions), s.encoding.slices,
                               scale, s.fit);
    if (s.encoding.format == bs::texel_format::bc4 && s.blocks == block_encoder::stb)
        pass_through_stb(slices);
    else
        pass_through(slices, s.encoding.format);
    return judge_slices(map, enlarged(slices, map.extent), s.encoding.slices, scale, margin);
}

score measure_best_volume(const sample_map& map, volume_setup s, int margin) {
    if (s.most != ceiling::best) return measure_volume(map, s, margin);
    s.most = ceiling::fixed;
    score best;
    for (const float slope : {1.75f, 2.0f, 2.5f, 3.0f, 4.0f, 6.0f, 9.0f}) {
        s.encoding.scale.max_slope = slope;
        score found = measure_volume(map, s, margin);
        if (best.wrong.empty() || found.percent() < best.percent()) best = std::move(found);
    }
    return best;
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

// All channels of all layers.
planes channels_of(const stored& texture, glm::ivec2 extent) {
    planes channels{extent, {}};
    for (int layer = 0; layer < texture.layout.layers; ++layer) {
        const std::vector<glm::vec4> texels = texel_centers(texture, layer, extent);
        for (int c = 0; c < 4; ++c)
            for (std::vector<float>& to = channels.values.emplace_back(); const glm::vec4& texel : texels)
                to.push_back(texel[c]);
    }
    return channels;
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
    const int count = bs::layout_of(e, {1, 1}).layers;
    result.name = format("%d slices in %d %s layers, %s", e.slices.count, count,
                         e.grouping == bs::slice_grouping::four ? "grouped" : "overlapping", name_of(e.scale.stored));
    result.name += name_of_limit(e.scale) + (!compressed                ? ", RGBA8"
                                             : compressed == codec::bc7 ? ", BC7"
                                                                        : ", ASTC " + block);
    const int columns = compressed == codec::bc7 ? 4 : std::atoi(block.c_str());
    const int rows = compressed == codec::bc7 ? 4 : std::atoi(block.c_str() + block.find('x') + 1);
    result.bytes = count * (compressed ? 16.0 / (columns * rows) : 4.0);
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
            require(bs::pack_slice_layers(map.every(s.directions), map.directions_of(s.directions), s.encoding, {},
                                          texture.view()));
            return 0.0;
        });
        if (s.compressed) {
            const std::string& program = s.compressed == codec::astc ? *programs.astc : *programs.bc7;
            unstack(recompress(*s.compressed, program, s.block, stacked(textures)), textures);
        }
        return each_map(maps, [&](const sample_map& map) {
            const stored& texture = textures[std::size_t(&map - maps.data())];
            return judge_layers(map, channels_of(texture, map.extent), s.encoding);
        });
    };
    return result;
}

}  // namespace examples
