#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/stored_rows.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Slices of scaled horizons, one channel, that the texture unit interpolates along the bearing.
// Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, sections 3 to 5.

namespace bumpshadow {

// Slice i of the texture is slice i of `slices`. Decoding: shader/tangent_volume.h.
//   volume  One fetch. Texel centers of the third coordinate stand at (i + 0.5) / count, so the coordinate of a bearing
//           is bearing - phase + 0.5 / count, repeating. Mip levels halve the slices as well: those of a level stand
//           where its texel centers are for the same coordinate (slices_of_level), and are fitted there. That loses
//           shadows: with 8 slices the mean shadow factor (waves, lights of 10 to 60 degrees) is off by up to 15, 29
//           and 30 percentage points at the levels of 4, 2 and 1 slices. Mips want an array.
//   array   Two fetches. All levels have all slices, and so can have the shadows of level 0 (make_mips: within 1
//           percentage point; bc4, whose blocks of small levels span much, 1, 3 and 5 at levels 1, 2 and 3 of
//           maps of 256 texels).
//   flat    One slice, one fetch, and no bearing.
// Over an arc of bearings (slice_set) arc_coordinate_of has the constants: a volume is clamped along its third
// coordinate in place of repeating, and has no mips; an array has them.
struct tangent_volume {
    slice_set slices = {};                     // bearings that are stored
    horizon_scale scale = {};                  // quantity, and the slope that stands for 1
    texel_format format = texel_format::r8;    // r8, r16, r16f, bc4
    texture_kind kind = texture_kind::volume;  // or array; flat for a single slice
};

// Checks slices, scale, format and kind.
[[nodiscard]] inline status check(const tangent_volume& encoding) {
    if (status s = check(encoding.slices); !s) return s;
    if (status s = check(encoding.scale); !s) return s;
    const texel_format f = encoding.format;
    if (f != texel_format::r8 && f != texel_format::r16 && f != texel_format::r16f && f != texel_format::bc4)
        return {error::not_supported, "format", double(f)};
    if (encoding.kind == texture_kind::cube) return {error::not_supported, "kind", double(encoding.kind)};
    if (encoding.kind == texture_kind::flat && encoding.slices.count != 1)
        return {error::mismatch, "slices of a flat texture", double(encoding.slices.count), 1.0};
    return {};
}

// One texture of the extent of the horizons, a slice or a layer for each of the slices.
[[nodiscard]] constexpr texture_layout layout_of(const tangent_volume& encoding, glm::ivec2 extent, int mips = 1) {
    const int count = encoding.slices.count;
    return {.format = encoding.format,
            .kind = encoding.kind,
            .extent = extent,
            .depth = encoding.kind == texture_kind::volume ? count : 1,
            .layers = encoding.kind == texture_kind::array ? count : 1,
            .mips = mips};
}

// Texture fetches of a horizon.
[[nodiscard]] constexpr int fetches(const tangent_volume& encoding) {
    return encoding.kind == texture_kind::array ? 2 : 1;
}

// What is added to a bearing to get the third coordinate of a volume of the whole turn.
[[nodiscard]] constexpr double coordinate_offset(const tangent_volume& encoding) {
    return 0.5 / encoding.slices.count - encoding.slices.phase;
}

// Where a bearing lies in the texture of an arc: scale * fract(bearing - start) + offset. The wrap of fract lies half
// way between the ends of the arc, on its far side.
struct arc_coordinate {
    float start = 0.0f;   // turns
    float scale = 0.0f;   // of a volume coordinates a turn, of an array layers a turn
    float offset = 0.0f;  // a coordinate, or a layer
};

// Of a volume the third coordinate, of an array the position among its layers; the arc is below 1. The position of a
// bearing is off by 1e-7 (count - 1) / arc slices.
[[nodiscard]] inline arc_coordinate arc_coordinate_of(const tangent_volume& encoding) {
    const slice_set& slices = encoding.slices;
    const bool volume = encoding.kind == texture_kind::volume;
    const double unit = volume ? 1.0 / slices.count : 1.0, first = slices.phase - std::floor(slices.phase);
    arc_coordinate c;
    c.start = float(first - 0.5 * (1.0 - slices.arc));
    if (slices.count > 1) c.scale = float(unit * (slices.count - 1) / slices.arc);
    c.offset = float((volume ? 0.5 * unit : 0.0) - double(c.scale) * (first - double(c.start)));
    return c;
}

// Slices of a mip level, at the bearings of its texel centers: n of them, coordinate (j + 0.5) / n. A volume over an
// arc has level 0 alone.
[[nodiscard]] constexpr slice_set slices_of_level(const tangent_volume& encoding, int level) {
    slice_set slices = encoding.slices;
    if (encoding.kind == texture_kind::volume && !is_arc(slices)) {
        slices.count = mip_extent(encoding.slices.count, level);
        slices.phase = 0.5 / slices.count - coordinate_offset(encoding);
    }
    return slices;
}

namespace tangent_volume_detail {

// Checks that the encoding can have as many levels.
[[nodiscard]] inline status check_mips(const tangent_volume& encoding, slice_fit fit, int mips) {
    if (encoding.kind != texture_kind::volume || mips == 1) return {};
    if (fit == slice_fit::point) return {error::not_supported, "mips of a volume without a fit", double(mips)};
    if (is_arc(encoding.slices)) return {error::not_supported, "mips of a volume over an arc", double(mips)};
    return {};
}

template <class Byte>
[[nodiscard]] Byte* slice_bytes(const basic_texture<Byte>& t, int level, int slice) {
    const bool volume = t.layout.kind == texture_kind::volume;
    return t.slice(volume ? 0 : slice, level, volume ? slice : 0);
}

// Writes a band of rows of all slices of a level, the first of them to row y.
inline void write_band(const slice_rows& band, int slices, const texture& out, int level, int y) {
    const texel_format format = out.layout.format;
    const std::size_t row_bytes = out.layout.row_bytes(level);
    const int width = out.layout.level_extent(level).x;
    for (int i = 0; i < slices; ++i) {
        std::byte* const to = slice_bytes(out, level, i);
        if (format == texel_format::bc4)
            encode_bc4_row([&](int r) { return band.row(i, r); }, band.count, width,
                           to + std::size_t(y / 4) * row_bytes);
        else
            for (int r = 0; r < band.count; ++r)
                write_row(format, band.row(i, r), width, to + std::size_t(y + r) * row_bytes);
    }
}

// Texels x ... x + count - 1 of a row of a slice.
inline void read_texels(const const_texture& t, int level, int slice, int x, int y, int count, float* to) {
    const std::byte* const from = slice_bytes(t, level, slice);
    const std::size_t row_bytes = t.layout.row_bytes(level);
    if (t.layout.format != texel_format::bc4) {
        read_row(t.layout.format, from + std::size_t(y) * row_bytes, x, count, to);
        return;
    }
    for (int i = x; i < x + count;) {
        float values[16];
        decode_bc4(from + std::size_t(y / 4) * row_bytes + std::size_t(i / 4) * 8, values);
        do {
            to[i - x] = values[4 * (y % 4) + i % 4];
        } while (++i < x + count && i % 4 != 0);
    }
}

}  // namespace tangent_volume_detail

// Packs horizons in `directions` (evenly spaced ones serve best) into a texture of the layout that layout_of gives.
//   levels: the map itself and its mips, if any, all in the same directions: of an array those of fit_slices and
//           make_mips, packed by points; of a volume made by reduce in all directions and fitted here. A map without
//           mips may be a band of the texture's rows (options.first_row)
//   fit: point only without mips or for an array, since the slices of a volume's mips stand elsewhere
//   report: sums over the levels
// Memory: the horizons, O(width * directions * rows of the band), and the scratch.
// Bound of |decoded - value|: 1/510 for r8, 1/131070 for r16, 2^-12 for r16f; for bc4 see encode/bc4.hpp.
// Scratch: slice_scratch_size of level 0. Errors: those of for_slice_bands, and a texture of another layout.
template <executor Executor = serial>
[[nodiscard]] status pack_tangent_volume(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                         const tangent_volume& encoding, const pack_options& options,
                                         const texture& out, Executor&& execute = {}) {
    using namespace tangent_volume_detail;
    if (status s = check(encoding); !s) return s;
    if (levels.empty()) return {error::missing, "levels"};
    if (status s = check_layout(out, layout_of(encoding, packed_extent(levels, out.layout), int(levels.size()))); !s)
        return s;
    if (status s = check_mips(encoding, options.fit, int(levels.size())); !s) return s;
    if (status s = check_levels(levels, directions, out.layout, options.first_row); !s) return s;
    const int rows = encoding.format == texel_format::bc4 ? 4 : 1;
    const auto pack = [&](const horizon_map& slopes, int level, const pack_options& each) {
        const slice_set slices = slices_of_level(encoding, level);
        const auto sink = [&](const slice_rows& band) {
            write_band(band, slices.count, out, level, band.y + options.first_row);
        };
        return for_slice_bands(slopes, directions, slices, encoding.scale, each, rows, execute, sink);
    };
    return slice_detail::for_levels(levels, encoding.slices, rows, execute.concurrency(), options, pack);
}

// The same without mips.
template <executor Executor = serial>
[[nodiscard]] status pack_tangent_volume(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                         const tangent_volume& encoding, const pack_options& options,
                                         const texture& out, Executor&& execute = {}) {
    return pack_tangent_volume(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, out, execute);
}

// Half the slices: every other one, over an arc those of both ends included. For machines with less memory.
[[nodiscard]] constexpr tangent_volume halved(tangent_volume encoding) {
    slice_set& slices = encoding.slices;
    slices.count = is_arc(slices) ? (slices.count + 1) / 2 : slices.count / 2;
    return encoding;
}

// Makes the texture of halved(encoding) from that of `encoding`, while loading it; the count of slices has to be even,
// over an arc odd.
//   fit: point drops every other slice, bytes and all, but not of a volume with mips, whose slices stand elsewhere;
//        least_squares fits half the slices to all of them, and so does least_angle
//   report: not written, since a texture has no samples that are clamped
template <executor Executor = serial>
[[nodiscard]] status halve_slices(const const_texture& from, const tangent_volume& encoding,
                                  const pack_options& options, const texture& out, Executor&& execute = {}) {
    using namespace tangent_volume_detail;
    if (status s = check(encoding); !s) return s;
    const bool arc = is_arc(encoding.slices);
    const int spaces = encoding.slices.count - (arc ? 1 : 0);
    if (spaces % 2 != 0)
        return {error::not_a_multiple, arc ? "slices of an arc less 1" : "slices", double(spaces), 2.0};
    const tangent_volume half = halved(encoding);
    const texture_layout& layout = from.layout;
    if (status s = check_layout(from, layout_of(encoding, layout.extent, layout.mips)); !s) return s;
    if (status s = check_layout(out, layout_of(half, layout.extent, layout.mips)); !s) return s;
    if (status s = check_mips(encoding, options.fit, layout.mips); !s) return s;
    if (options.fit == slice_fit::point) {
        execute(std::size_t(half.slices.count), [&](std::size_t i) {
            for (int level = 0; level < layout.mips; ++level)
                std::memcpy(slice_bytes(out, level, int(i)), slice_bytes(from, level, 2 * int(i)),
                            layout.slice_bytes(level));
        });
        return {};
    }
    pack_report none;
    pack_options each = options;
    each.report = &none;
    const int rows = encoding.format == texel_format::bc4 ? 4 : 1;
    scratch_block block;
    const slice_detail::request largest{layout.extent, std::size_t(encoding.slices.count), half.slices, rows};
    if (status s = slice_detail::take_scratch(largest, execute.concurrency(), block, each); !s) return s;
    for (int level = 0; level < layout.mips; ++level) {
        const slice_set wide = slices_of_level(encoding, level), slices = slices_of_level(half, level);
        const auto make_plan = [&](slice_detail::plan& p, std::span<glm::dvec2>, double* work) {
            const auto bearing = [&](std::size_t i) { return bearing_of(wide, int(i)); };
            return slice_detail::plan_fit(p, std::size_t(wide.count), bearing, work);
        };
        const auto source = [&](int slice, int x, int y, int count, float* to, slice_detail::lanes_seen&) {
            read_texels(from, level, slice, x, y, count, to);
            std::fill(to + count, to + slice_detail::padded(count), 0.0f);
        };
        status s = slice_detail::run(
            {layout.level_extent(level), std::size_t(wide.count), slices, rows}, each, make_plan, source, execute,
            [&](const slice_rows& band) { write_band(band, slices.count, out, level, band.y); });
        if (!s) return s;
    }
    return {};
}

// Size of a texture without mips, in units of 1024 bytes.
[[nodiscard]] constexpr double texture_kbytes(glm::ivec2 extent, int slices, double bits_a_texel) {
    return double(extent.x) * double(extent.y) * double(slices) * bits_a_texel / 8.0 / 1024.0;
}

// A line of Forsyth's table of memory.
struct memory_line {
    const char* type;    // what the texture is for
    const char* format;  // as he calls it
    glm::ivec2 extent;   // texels
    int slices;          // 1 but for horizons
    double kbytes;       // of 1024 bytes
};

// The table of his section 5, computed: what horizons cost beside the other textures of a surface. (512, 512) gives
// the published numbers; the last four lines are a horizon map of 16 slices at full, half and quarter extent, and of 8
// at a quarter.
[[nodiscard]] inline GLM_CONSTEXPR std::array<memory_line, 8> memory_table(glm::ivec2 extent) {
    const auto line = [](const char* type, const char* format, glm::ivec2 texels, int slices, double bits) {
        return memory_line{type, format, texels, slices, texture_kbytes(texels, slices, bits)};
    };
    const auto horizons = [](glm::ivec2 texels, int slices) {
        tangent_volume encoding;
        encoding.slices.count = slices;
        const double bytes = double(layout_of(encoding, texels).required_size());
        return memory_line{"horizon map", "8bpp scalar", texels, slices, bytes / 1024.0};
    };
    const glm::ivec2 half{mip_extent(extent.x, 1), mip_extent(extent.y, 1)};
    const glm::ivec2 quarter{mip_extent(extent.x, 2), mip_extent(extent.y, 2)};
    return {line("diffuse texture", "32bpp ARGB", extent, 1, 32.0),
            line("diffuse texture", "DXT1, 4bpp compressed", extent, 1, 4.0),
            line("normal map", "32bpp ARGB", extent, 1, 32.0),
            line("normal map", "8bpp indexed palette", extent, 1, 8.0),
            horizons(extent, 16),
            horizons(half, 16),
            horizons(quarter, 16),
            horizons(quarter, 8)};
}

}  // namespace bumpshadow
