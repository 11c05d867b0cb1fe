#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

// Tiles of a map that a light never shadows, so that an engine need not fetch their horizons.

namespace bumpshadow {

// Tiles along each axis; the last ones may be narrower. A side below 1 counts as 1.
[[nodiscard]] inline GLM_CONSTEXPR glm::ivec2 tile_count(glm::ivec2 extent, int side) {
    const int texels = (std::max)(1, side);
    return {part_count(extent.x, texels), part_count(extent.y, texels)};
}

// The steepest horizon of every tile, over all bearings of the map, as slopes [y][x]; no_horizon where all are holes.
// A light whose slope is above it is never blocked in the tile. A border of one texel around a tile counts as well,
// since filtering reaches there; beyond the map by the edge mode.
//   side: texels along a tile, at least 1; out: tile_count() of them
// Between baked bearings horizons are not known to be lower: bake as many as the texture is fitted to.
// Errors: sizes. Then nothing is written.
[[nodiscard]] inline status tile_horizons(const horizon_map& slopes, edge_mode edge, int side, std::span<float> out) {
    if (status s = check_horizons(slopes); !s) return s;
    if (side <= 0) return {error::not_positive, "side of a tile", double(side)};
    const glm::ivec2 tiles = tile_count(slopes.extent, side);
    const std::size_t count = std::size_t(tiles.x) * std::size_t(tiles.y);
    if (out.size() < count) return {error::too_small, "tiles", double(out.size()), double(count)};
    std::fill_n(out.begin(), count, no_horizon);
    for (int bearing = 0; bearing < slopes.bearings; ++bearing)
        for (int t = 0; t < tiles.y; ++t)
            // In 64 bits: the row after the last one, and the end of a tile that reaches beyond the map.
            for (std::int64_t y = std::int64_t(t) * side - 1,
                              end = (std::min)(y + 1 + side, std::int64_t(slopes.extent.y));
                 y <= end; ++y) {
                const auto at = resolve_edge(y, slopes.extent.y, edge);
                if (at < 0) continue;
                const float* const row = slopes.row(bearing, int(at));
                for (int u = 0; u < tiles.x; ++u) {
                    float& most = out[std::size_t(t) * std::size_t(tiles.x) + std::size_t(u)];
                    const int first = u * side, last = first + (std::min)(side, slopes.extent.x - first);
                    float here = most;
                    for (int x = first; x < last; ++x) here = row[x] > here ? row[x] : here;
                    for (const int x : {first - 1, last}) {
                        const auto beside = resolve_edge(x, slopes.extent.x, edge);
                        if (beside >= 0) here = row[beside] > here ? row[beside] : here;
                    }
                    most = here;
                }
            }
    return {};
}

}  // namespace bumpshadow
