#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/stored_rows.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Neighboring slices in the channels of RGBA8 array layers. Likeness of the channels is what BC7 and ASTC compress:
// hand the layers to the texture pipeline.

namespace bumpshadow {

// Which slices lie in which layer.
enum class slice_grouping : unsigned char {
    four,         // slices 4 l ... 4 l + 3 in layer l: two fetches; the count is a multiple of 4
    overlapping,  // slices 3 l ... 3 l + 3 in layer l, the last one being the next layer's first: one fetch, 4/3 of the
                  // bytes; the count is a multiple of 3
};

// Slices of the whole turn: their arc is 1. Decoding: shader/slice_layers.h.
struct slice_layers {
    slice_set slices = {};                           // of the whole turn
    horizon_scale scale = {};                        // quantity, and the slope that stands for 1
    slice_grouping grouping = slice_grouping::four;  // and so one or two fetches
};

// Slices that a layer adds.
[[nodiscard]] constexpr int slices_per_layer(slice_grouping grouping) {
    return grouping == slice_grouping::four ? 4 : 3;
}

// Checks slices, scale and that the layers are full.
[[nodiscard]] inline status check(const slice_layers& encoding) {
    if (status s = check(encoding.slices); !s) return s;
    if (status s = check(encoding.scale); !s) return s;
    if (is_arc(encoding.slices)) return {error::not_supported, "arc", encoding.slices.arc};
    const int each = slices_per_layer(encoding.grouping), count = encoding.slices.count;
    if (count % each != 0) return {error::not_a_multiple, "slices", double(count), double(each)};
    return {};
}

// An array of rgba8 of the extent of the horizons, slices / slices_per_layer layers.
[[nodiscard]] constexpr texture_layout layout_of(const slice_layers& encoding, glm::ivec2 extent, int mips = 1) {
    return {texel_format::rgba8,
            texture_kind::array,
            extent,
            1,
            encoding.slices.count / slices_per_layer(encoding.grouping),
            mips};
}

// Texture fetches of a horizon.
[[nodiscard]] constexpr int fetches(const slice_layers& encoding) {
    return encoding.grouping == slice_grouping::four ? 2 : 1;
}

// Packs horizons in `directions` (evenly spaced ones serve best) into a texture of the layout that layout_of gives.
//   levels: the map itself and its mips, if any, all in the same directions: those of fit_slices and make_mips, packed
//           by points. A map without mips may be a band of the texture's rows (options.first_row)
//   report: sums over the levels
// Memory: the horizons, O(width * directions * rows of the band), and the scratch.
// Bound of |decoded - value|: 1/510. Scratch: slice_scratch_size of level 0. Errors: those of for_slice_bands, and a
// texture of another layout.
template <executor Executor = serial>
[[nodiscard]] status pack_slice_layers(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                       const slice_layers& encoding, const pack_options& options, const texture& out,
                                       Executor&& execute = {}) {
    if (status s = check(encoding); !s) return s;
    if (levels.empty()) return {error::missing, "levels"};
    if (status s = check_layout(out, layout_of(encoding, packed_extent(levels, out.layout), int(levels.size()))); !s)
        return s;
    if (status s = check_levels(levels, directions, out.layout, options.first_row); !s) return s;

    const int count = encoding.slices.count, step = slices_per_layer(encoding.grouping);
    return slice_detail::for_levels(
        levels, encoding.slices, 1, execute.concurrency(), options,
        [&](const horizon_map& slopes, int level, const pack_options& each) {
            const auto sink = [&](const slice_rows& band) {
                const std::size_t row = std::size_t(band.y + options.first_row) * out.layout.row_bytes(level);
                for (int layer = 0; layer < out.layout.layers; ++layer) {
                    const int i = layer * step;
                    write_row_rgba8(band.row(i, 0), band.row(i + 1, 0), band.row(i + 2, 0),
                                    band.row((i + 3) % count, 0), slopes.extent.x, out.slice(layer, level) + row);
                }
            };
            return for_slice_bands(slopes, directions, encoding.slices, encoding.scale, each, 1, execute, sink);
        });
}

// The same without mips.
template <executor Executor = serial>
[[nodiscard]] status pack_slice_layers(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                       const slice_layers& encoding, const pack_options& options, const texture& out,
                                       Executor&& execute = {}) {
    return pack_slice_layers(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, out, execute);
}

}  // namespace bumpshadow
