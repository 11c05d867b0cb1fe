#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <bumpshadow/encode/fourier_series.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/stored_rows.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Radial horizon maps: the horizon of a texel as a Fourier series over the bearing. Decoded by shader/fourier.h.
//
// Source: "Self-shadowing textures using radial horizon maps" (2010).

namespace bumpshadow {

// Bound of a coefficient mean(h sin kt) or mean(h cos kt), k > 0, of horizons 0 <= h <= 1: it is largest where h is 1
// while the sine is positive and 0 elsewhere, and the positive half of a sine has the mean 1/pi. Of -1 <= h <= 1 it is
// twice that, as the post says. Means over M evenly spaced directions can exceed it by a factor of at most x / sin x,
// x = k pi / M, for horizons as extreme as that: they are clamped.
inline constexpr float fourier_bound = 0.318309886f;

// What the smallest and the largest stored number stand for, up to largest_fourier_range in size.
struct fourier_range {
    float low = -fourier_bound, high = fourier_bound;  // in the stored quantity over what stands for 1
};

// A series of much larger coefficients would overflow, and its horizon not be a number.
inline constexpr float largest_fourier_range = 1e36f;

// All that decoding needs. Coefficients are counted: constant, sin t, cos t, sin 2t, cos 2t ..., with x = sin t and
// y = cos t of the bearing's direction; all but the constant are half of what the series has.
struct fourier {
    int coefficients = 5;  // 3, 5, 7 or 9: 4, 5, 8 or 9 bytes a texel of 8 bits
    horizon_scale scale;   // quantity, and the slope that stands for 1
    int bits = 8;          // or 16
    // Signed square roots are stored: finer near 0, coarser far from it, and 6 more operations for 5 coefficients.
    // Wrong (lit or shadowed) in 8 bits, mean of six maps: 4.27 % of lights with neither, 4.21 % with tighten_ranges,
    // 4.20 % with both.
    bool square_root = false;
    // Widens ranges that hold 0 a little, so that 0 is one of the numbers stored: else flat texels get a horizon.
    bool exact_zero = true;
    // Range of each coefficient, in the order above; those beyond `coefficients` do not matter.
    std::array<fourier_range, most_coefficients> ranges = {fourier_range{0.0f, 1.0f}};
};

// As the post has it: sines, roots, all ranges -1 to 1, in which 0 lies between two stored numbers.
[[nodiscard]] constexpr fourier fourier_as_posted() {
    fourier posted;
    posted.scale = {quantity::sine, std::numeric_limits<float>::infinity()};
    posted.square_root = true;
    posted.exact_zero = false;
    posted.ranges.fill({-1.0f, 1.0f});
    return posted;
}
// Its edge of the shadow, clamp(c + k (light - horizon), 0, 1) in sines: 1 / k is its width.
inline constexpr float fourier_posted_k = 20.0f;
// c of the same: the edge is centered.
inline constexpr float fourier_posted_c = 0.5f;

// Checks the number of coefficients, the bits, the ranges and the scale.
[[nodiscard]] inline status check(const fourier& encoding) {
    const int n = encoding.coefficients;
    if (n != 3 && n != 5 && n != 7 && n != 9) return {error::not_supported, "coefficients", double(n)};
    if (encoding.bits != 8 && encoding.bits != 16) return {error::not_supported, "bits", double(encoding.bits)};
    for (int i = 0; i < n; ++i) {
        const fourier_range r = encoding.ranges[std::size_t(i)];
        if (!is_finite(r.low)) return {error::not_finite, "range.low", double(r.low)};
        if (!is_finite(r.high)) return {error::not_finite, "range.high", double(r.high)};
        if (r.low < -largest_fourier_range)
            return {error::out_of_range, "range.low", double(r.low), double(-largest_fourier_range)};
        if (r.high > largest_fourier_range)
            return {error::out_of_range, "range.high", double(r.high), double(largest_fourier_range)};
        if (r.low > r.high) return {error::out_of_range, "range.low", double(r.low), double(r.high)};
    }
    return check(encoding.scale);
}

// Textures, all flat: of four channels, and a last one of one channel for the constant of 5 and 9 coefficients.
[[nodiscard]] constexpr int texture_count(const fourier& encoding) { return (encoding.coefficients + 3) / 4; }
// Texture fetches of a horizon: one of each texture.
[[nodiscard]] constexpr int fetches(const fourier& encoding) { return texture_count(encoding); }

// Coefficients in the channels of a texture; -1: none, stored as 1.
[[nodiscard]] constexpr std::array<int, 4> channels_of(const fourier& encoding, int index) {
    const int n = encoding.coefficients;
    if (index == 0) return n == 3 ? std::array{1, 2, 0, -1} : std::array{1, 2, 3, 4};
    if (index == 1 && n > 5) return n == 7 ? std::array{5, 6, 0, -1} : std::array{5, 6, 7, 8};
    return {0, -1, -1, -1};
}

// Layout of a texture: rgba8 or rgba16, or r8 or r16 for a last one of one channel.
//   index: of the texture, 0 to texture_count(encoding) - 1
[[nodiscard]] constexpr texture_layout layout_of(const fourier& encoding, glm::ivec2 extent, int mips = 1,
                                                 int index = 0) {
    const bool one = channels_of(encoding, index)[1] < 0;
    const texel_format format = encoding.bits == 8 ? (one ? texel_format::r8 : texel_format::rgba8)
                                                   : (one ? texel_format::r16 : texel_format::rgba16);
    return {.format = format, .extent = extent, .mips = mips};
}

// The range of a coefficient as stored: of its signed root where roots are, and widened so that a stored number is 0.
[[nodiscard]] inline fourier_range stored_range(const fourier& encoding, int coefficient) {
    fourier_range r = encoding.ranges[std::size_t(coefficient)];
    if (encoding.square_root) {
        const auto root = [](float v) { return std::copysign(std::sqrt(std::abs(v)), v); };
        r = {root(r.low), root(r.high)};
    }
    if (!encoding.exact_zero || !(r.low < 0.0f && r.high > 0.0f)) return r;
    const float last = encoding.bits == 8 ? 255.0f : 65535.0f;
    const float zero = std::clamp(std::floor(-r.low / (r.high - r.low) * last + 0.5f), 1.0f, last - 1.0f);
    const float step = (std::max)(r.high / (last - zero), -r.low / zero);
    return {-step * zero, step * (last - zero)};
}

// What the shader takes beside the texels: texel * scale + offset is the coefficient or its signed root, those of all
// but the constant for twice the coefficient.
struct fourier_decoding {
    glm::vec4 scale[2], offset[2];          // of the textures of four channels
    float constant_scale, constant_offset;  // of the one of one channel
};

// What decoding takes, from the ranges as they are stored.
[[nodiscard]] inline fourier_decoding decoding_of(const fourier& encoding) {
    fourier_decoding decoding{};
    const fourier_range constant = stored_range(encoding, 0);
    decoding.constant_scale = constant.high - constant.low;
    decoding.constant_offset = constant.low;
    const float twice = encoding.square_root ? 1.41421356f : 2.0f;
    for (int t = 0; t < 2 && t < texture_count(encoding); ++t)
        for (glm::length_t c = 0; c < 4; ++c) {
            const int i = channels_of(encoding, t)[std::size_t(c)];
            if (i < 0) continue;
            const fourier_range r = stored_range(encoding, i);
            const float factor = i == 0 ? 1.0f : twice;
            decoding.scale[t][c] = factor * (r.high - r.low);
            decoding.offset[t][c] = factor * r.low;
        }
    return decoding;
}

namespace fourier_detail {

inline constexpr int chunk = slice_detail::chunk;
inline constexpr int rows_of_item = slice_detail::rows_of_item;

[[nodiscard]] inline std::size_t scratch_bytes(std::size_t directions, std::size_t coefficients, int slots) {
    scratch_layout layout;
    layout.add<float>(directions, coefficients);
    layout.add<float>(std::size_t(slots), saturated_product(saturated_sum(coefficients, 1), chunk));
    return layout.bytes();
}

// Coefficients of `count` texels, a row of `chunk` each; work: a chunk.
inline void project(const horizon_map& slopes, const fourier& encoding, const float* weights, int x, int y, int count,
                    float* coefficients, float* work, slice_detail::lanes_seen& seen) {
    const std::size_t padded = slice_detail::padded(count);
    const int directions = slopes.bearings;
    for (int i = 0; i < encoding.coefficients; ++i) std::fill_n(coefficients + i * chunk, padded, 0.0f);
    for (int m = 0; m < directions; ++m) {
        slice_detail::convert(encoding.scale, slopes.row(m, y) + x, count, work, seen);
        for (int i = 0; i < encoding.coefficients; ++i)
            slice_detail::add(coefficients + i * chunk, work, weights[i * directions + m], padded);
    }
}

// Coefficients to stored values in [0, 1], in place. Returns how many lie outside the range.
inline std::size_t store(const fourier& encoding, int coefficient, int count, float* values) {
    const fourier_range given = encoding.ranges[std::size_t(coefficient)], r = stored_range(encoding, coefficient);
    const float scale = r.high > r.low ? 1.0f / (r.high - r.low) : 0.0f;
    int outside = 0;
    for (int x = 0; x < count; ++x) outside += values[x] < given.low || values[x] > given.high ? 1 : 0;
    if (encoding.square_root)
        for (int x = 0; x < count; ++x) values[x] = std::copysign(std::sqrt(std::abs(values[x])), values[x]);
    for (int x = 0; x < count; ++x) {
        const float v = (values[x] - r.low) * scale;
        const float above = v > 0.0f ? v : 0.0f;
        values[x] = above < 1.0f ? above : 1.0f;
    }
    return std::size_t(outside);
}

// `count` texels of a row, from texel x on; values: a row of `chunk` a coefficient. ones: a chunk.
inline void write(const fourier& encoding, int index, const float* values, float* ones, int x, int count,
                  std::byte* row) {
    const std::array<int, 4> channels = channels_of(encoding, index);
    if (channels[1] < 0) {
        const bool bytes = encoding.bits == 8;
        write_row(bytes ? texel_format::r8 : texel_format::r16, values, count, row + std::size_t(x) * (bytes ? 1 : 2));
        return;
    }
    const float* rows[4];
    for (std::size_t c = 0; c < 4; ++c) rows[c] = channels[c] < 0 ? ones : values + channels[c] * chunk;
    if (channels[3] < 0) std::fill_n(ones, count, 1.0f);
    if (encoding.bits == 8) {
        write_row_rgba8(rows[0], rows[1], rows[2], rows[3], count, row + std::size_t(x) * 4);
        return;
    }
    for (int i = 0; i < count; ++i)
        for (int c = 0; c < 4; ++c)
            stored_rows_detail::put(row + (std::size_t(x + i) * 4 + std::size_t(c)) * 2,
                                    static_cast<std::uint16_t>(int(rows[c][i] * 65535.0f + 0.5f)));
}

// Projects every level; visit(level, x, y, count, coefficients, work) gets `count` texels at a time, coefficients in
// rows of `chunk`, and returns how many of its numbers it clamped.
template <executor Executor, class Visit>
[[nodiscard]] status for_coefficients(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                      const fourier& encoding, const pack_options& options, Executor&& execute,
                                      const Visit& visit) {
    const std::size_t terms = std::size_t(encoding.coefficients);
    const std::size_t items = std::size_t(part_count(levels[0].extent.y, rows_of_item));
    const int slots = slot_pool::slots(execute.concurrency(), items);
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    scratch_block block;
    if (status s = block.allocate(where, scratch_bytes(directions.size(), terms, slots), "the scratch of a series"); !s)
        return s;
    float* const weights = block.carve<float>(directions.size() * terms);
    if (status s = fit_series(directions, encoding.coefficients, {weights, directions.size() * terms}); !s) return s;
    float* const buffers = block.carve<float>(std::size_t(slots) * (terms + 1) * chunk);

    std::atomic<std::size_t> clamped{0};
    std::atomic<float> steepest{0.0f};
    slot_pool pool(slots);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const horizon_map& slopes = levels[level];
        execute(std::size_t(part_count(slopes.extent.y, rows_of_item)), [&](std::size_t item) {
            const auto lease = pool.acquire();
            float* const coefficients = buffers + std::size_t(lease.index()) * (terms + 1) * chunk;
            float* const work = coefficients + terms * chunk;
            pack_report report;
            const int first = int(item) * rows_of_item;
            const int end = first + (std::min)(rows_of_item, slopes.extent.y - first);
            for (int y = first; y < end; ++y)
                for (int x = 0; x < slopes.extent.x; x += chunk) {
                    const int count = (std::min)(chunk, slopes.extent.x - x);
                    slice_detail::lanes_seen seen;
                    project(slopes, encoding, weights, x, y, count, coefficients, work, seen);
                    slice_detail::add(report, seen);
                    report.clamped += visit(int(level), x, y, count, coefficients, work);
                }
            clamped.fetch_add(report.clamped, std::memory_order_relaxed);
            slice_detail::raise(steepest, report.steepest);
        });
    }
    if (options.report != nullptr) *options.report = {clamped.load(), steepest.load()};
    return {};
}

}  // namespace fourier_detail

// Bytes of scratch for the two functions below, at the most, on an executor of that concurrency.
[[nodiscard]] inline std::size_t fourier_scratch_size(glm::ivec2 extent, std::size_t directions,
                                                      const fourier& encoding, int concurrency = 1) {
    const auto items = std::size_t(part_count(extent.y, fourier_detail::rows_of_item));
    return fourier_detail::scratch_bytes(directions, std::size_t(encoding.coefficients),
                                         slot_pool::slots(concurrency, items));
}

// Packs horizons in `directions` (evenly spaced ones serve best, 16 or more) into textures of the layouts that
// layout_of gives.
//   levels: the map itself and its mips, if any (make_fourier_mips, encode/fourier_mips.hpp), all in the same
//           directions. A map without mips may be a band of the textures' rows (options.first_row)
//   out: texture_count(encoding) of them
//   report: sums over the levels; counts slopes above max_slope and coefficients outside their range
// Memory: the horizons, O(width * directions * rows of the band), and the scratch.
// options.fit is not looked at: the series is always the least-squares one.
// Bound of |decoded - value| of a coefficient: (high - low) / 510 before doubling, without roots.
// Errors: sizes; too_small for fewer directions than coefficients, out_of_range where they do not determine a
// coefficient; textures of another number or layout; scratch. Then nothing is written.
template <executor Executor = serial>
[[nodiscard]] status pack_fourier(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                  const fourier& encoding, const pack_options& options, std::span<const texture> out,
                                  Executor&& execute = {}) {
    using namespace fourier_detail;
    if (status s = check(encoding); !s) return s;
    if (levels.empty()) return {error::missing, "levels"};
    const int textures = texture_count(encoding);
    if (out.size() != std::size_t(textures)) return {error::mismatch, "textures", double(out.size()), double(textures)};
    for (int i = 0; i < textures; ++i) {
        const texture_layout wanted = layout_of(encoding, packed_extent(levels, out[0].layout), int(levels.size()), i);
        if (status s = check_layout(out[std::size_t(i)], wanted); !s) return s;
    }
    if (status s = check_levels(levels, directions, out[0].layout, options.first_row); !s) return s;
    const auto visit = [&](int level, int x, int y, int count, float* coefficients, float* work) {
        std::size_t clamped = 0;
        for (int i = 0; i < encoding.coefficients; ++i)
            clamped += fourier_detail::store(encoding, i, count, coefficients + i * chunk);
        for (int i = 0; i < textures; ++i) {
            const texture& t = out[std::size_t(i)];
            std::byte* const row = t.slice(0, level) + std::size_t(y + options.first_row) * t.layout.row_bytes(level);
            fourier_detail::write(encoding, i, coefficients, work, x, count, row);
        }
        return clamped;
    };
    return for_coefficients(levels, directions, encoding, options, execute, visit);
}

// Sets encoding.ranges to those of the coefficients that a map and its mips have, which is what its bits are best spent
// on; the ranges before do not matter. Of a map that is packed in bands, take the union of the bands' ranges.
// Errors and scratch as above.
template <executor Executor = serial>
[[nodiscard]] status tighten_ranges(std::span<const horizon_map> levels, std::span<const glm::dvec2> directions,
                                    fourier& encoding, const pack_options& options, Executor&& execute = {}) {
    using namespace fourier_detail;
    fourier free = encoding;
    free.ranges.fill({0.0f, 0.0f});
    if (status s = check(free); !s) return s;
    if (levels.empty()) return {error::missing, "levels"};
    if (status s = check_levels(levels, directions, layout_of(free, levels[0].extent, int(levels.size()))); !s)
        return s;
    // With the sign turned, the lowest is the highest as well.
    std::array<std::atomic<float>, most_coefficients> below, above;
    for (std::atomic<float>& v : below) v = std::numeric_limits<float>::lowest();
    for (std::atomic<float>& v : above) v = std::numeric_limits<float>::lowest();
    const auto visit = [&](int, int, int, int count, const float* coefficients, float*) {
        for (std::size_t i = 0; i < std::size_t(free.coefficients); ++i) {
            const float* const row = coefficients + i * std::size_t(chunk);
            slice_detail::raise(below[i], -*std::min_element(row, row + count));
            slice_detail::raise(above[i], *std::max_element(row, row + count));
        }
        return std::size_t{0};
    };
    if (status s = for_coefficients(levels, directions, free, options, execute, visit); !s) return s;
    for (std::size_t i = 0; i < std::size_t(free.coefficients); ++i) encoding.ranges[i] = {-below[i], above[i]};
    return {};
}

// pack_fourier for a map without mips.
template <executor Executor = serial>
[[nodiscard]] status pack_fourier(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                  const fourier& encoding, const pack_options& options, std::span<const texture> out,
                                  Executor&& execute = {}) {
    return pack_fourier(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, out, execute);
}
// tighten_ranges for a map without mips.
template <executor Executor = serial>
[[nodiscard]] status tighten_ranges(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                    fourier& encoding, const pack_options& options, Executor&& execute = {}) {
    return tighten_ranges(std::span<const horizon_map>(&slopes, 1), directions, encoding, options, execute);
}

}  // namespace bumpshadow
