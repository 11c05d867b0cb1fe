#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/stored_rows.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Horizons at 0, 45, 90, 135 degrees in the channels of one RGBA8 layer and at 180, 225, 270, 315 degrees in those of
// another: 8 bytes a texel. Decoded by shader/sine_layers.h.
//
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.2.

namespace bumpshadow {

// All that decoding needs. Published are sines of 0 to 90 degrees; slopes up to 4 interpolate better.
struct sine_layers {
    horizon_scale scale = {quantity::sine, std::numeric_limits<float>::infinity()};  // as published
    bool separate = false;  // two flat textures in place of an array of two layers
};

// Textures: one array, or two flat ones.
[[nodiscard]] constexpr int texture_count(const sine_layers& encoding) { return encoding.separate ? 2 : 1; }
// Fetches of a horizon, one more where the factors come from a cube.
[[nodiscard]] constexpr int fetches(const sine_layers&) { return 2; }

// Layout of each of the textures.
[[nodiscard]] constexpr texture_layout layout_of(const sine_layers& encoding, glm::ivec2 extent, int mips = 1) {
    return {.format = texel_format::rgba8,
            .kind = encoding.separate ? texture_kind::flat : texture_kind::array,
            .extent = extent,
            .layers = encoding.separate ? 1 : 2,
            .mips = mips};
}

// Directions, evenly around, whose sines the published method averages.
inline constexpr int sine_layers_directions = 32;
// How many of them make a channel.
inline constexpr int sine_layers_average = 5;

namespace sine_layers_detail {

[[nodiscard]] inline status check_textures(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                           const sine_layers& encoding, const pack_options& options,
                                           std::span<const texture> out) {
    if (status s = check(encoding.scale); !s) return s;
    if (levels.empty()) return {error::missing, "levels"};
    if (out.size() != std::size_t(texture_count(encoding)))
        return {error::mismatch, "textures", double(out.size()), double(texture_count(encoding))};
    const texture_layout wanted = layout_of(encoding, packed_extent(levels, out[0].layout), int(levels.size()));
    for (const texture& t : out)
        if (status s = check_layout(t, wanted); !s) return s;
    return check_levels(levels, directions, wanted, options.first_row);
}

// A row of both layers from eight rows of stored values, from texel x on.
inline void write(std::span<const texture> out, int level, int y, int x, const float* const (&rows)[8], int count) {
    for (int layer = 0; layer < 2; ++layer) {
        const bool separate = out.size() == 2;
        const texture& t = out[separate ? std::size_t(layer) : 0];
        std::byte* const to = t.slice(separate ? 0 : layer, level) + std::size_t(y) * t.layout.row_bytes(level);
        const float* const* const r = rows + 4 * layer;
        write_row_rgba8(r[0], r[1], r[2], r[3], count, to + 4 * std::size_t(x));
    }
}

}  // namespace sine_layers_detail

// Packs horizons in `directions` (evenly spaced ones serve best) into textures of the layout that layout_of gives.
//   levels: the map itself and its mips, if any, all in the same directions: those of fit_slices and make_mips, packed
//           by points. A map without mips may be a band of the textures' rows (options.first_row)
//   out: one texture, or two where they are separate
//   report: sums over the levels
// Memory: the horizons, O(width * directions * rows of the band), and the scratch.
// Bound of |decoded - value|: 1/510. Scratch: slice_scratch_size of level 0. Errors: those of for_slice_bands, and
// textures of another number or layout.
template <executor Executor = serial>
[[nodiscard]] status pack_sine_layers(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                      const sine_layers& encoding, const pack_options& options,
                                      std::span<const texture> out, Executor&& execute = {}) {
    using namespace sine_layers_detail;
    if (status s = check_textures(levels, directions, encoding, options, out); !s) return s;
    const slice_set slices{8, 0.0, bearing_function::exact};
    const auto pack = [&](const horizon_map& slopes, int level, const pack_options& each) {
        const auto sink = [&](const slice_rows& band) {
            const float* rows[8];
            for (int i = 0; i < 8; ++i) rows[i] = band.row(i, 0);
            write(out, level, band.y + options.first_row, 0, rows, slopes.extent.x);
        };
        return for_slice_bands(slopes, directions, slices, encoding.scale, each, 1, execute, sink);
    };
    return slice_detail::for_levels(levels, slices, 1, execute.concurrency(), options, pack);
}

// The same as published: each channel is the average of what is stored for the nearest five of 32 directions, those of
// fill_directions(directions, 0.0), in any order; options.fit is not looked at. Smoother along the bearing, and wrong
// (lit or shadowed) for 4.3 % of lights, where picked directions are for 3.6 % (mean of six maps).
// Errors: the above, and other directions than these 32. Scratch: slice_scratch_size of level 0 with 32 slices.
template <executor Executor = serial>
[[nodiscard]] status pack_sine_layers_averaged(std::span<const horizon_map> levels,
                                               std::span<const glm::dvec2> directions, const sine_layers& encoding,
                                               const pack_options& options, std::span<const texture> out,
                                               Executor&& execute = {}) {
    using namespace sine_layers_detail;
    constexpr int count = sine_layers_directions, reach = sine_layers_average / 2;
    if (status s = check_textures(levels, directions, encoding, options, out); !s) return s;
    if (directions.size() != std::size_t(count))
        return {error::mismatch, "directions", double(directions.size()), double(count)};
    const slice_set slices{count, 0.0, bearing_function::exact};
    return slice_detail::for_levels(
        levels, slices, 1, execute.concurrency(), options,
        [&](const horizon_map& slopes, int level, const pack_options& each) {
            pack_options picked = each;
            picked.fit = slice_fit::point;
            const auto sink = [&](const slice_rows& band) {
                constexpr int chunk = 256;
                float averages[8][chunk];
                const float* rows[8];
                for (int i = 0; i < 8; ++i) rows[i] = averages[i];
                for (int x0 = 0; x0 < slopes.extent.x; x0 += chunk) {
                    const int texels = (std::min)(chunk, slopes.extent.x - x0);
                    for (int i = 0; i < 8; ++i) {
                        std::fill_n(averages[i], texels, 0.0f);
                        for (int d = -reach; d <= reach; ++d) {
                            const float* const row = band.row((4 * i + d + count) % count, 0) + x0;
                            for (int x = 0; x < texels; ++x) averages[i][x] += (1.0f / sine_layers_average) * row[x];
                        }
                        // Five fifths are a little more than 1.
                        for (int x = 0; x < texels; ++x) averages[i][x] = averages[i][x] < 1.0f ? averages[i][x] : 1.0f;
                    }
                    write(out, level, band.y + options.first_row, x0, rows, texels);
                }
            };
            return for_slice_bands(slopes, directions, slices, encoding.scale, picked, 1, execute, sink);
        });
}

// pack_sine_layers for a map without mips.
template <executor Executor = serial>
[[nodiscard]] status pack_sine_layers(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                      const sine_layers& encoding, const pack_options& options,
                                      std::span<const texture> out, Executor&& execute = {}) {
    return pack_sine_layers(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, out, execute);
}
// pack_sine_layers_averaged for a map without mips.
template <executor Executor = serial>
[[nodiscard]] status pack_sine_layers_averaged(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                               const sine_layers& encoding, const pack_options& options,
                                               std::span<const texture> out, Executor&& execute = {}) {
    return pack_sine_layers_averaged(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, out,
                                     execute);
}

}  // namespace bumpshadow
