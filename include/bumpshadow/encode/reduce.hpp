#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Horizon maps of smaller extent: a map stored at a half, a quarter or an eighth, and mips.

namespace bumpshadow {

// Extent at 1 / factor, at least 1; what is left over of an odd extent is spread over all texels. A factor below 1
// counts as 1.
[[nodiscard]] inline GLM_CONSTEXPR glm::ivec2 reduced_extent(glm::ivec2 extent, int factor) {
    const int divisor = (std::max)(1, factor);
    return {(std::max)(1, extent.x / divisor), (std::max)(1, extent.y / divisor)};
}

// Mip levels, the map itself included, down to 32 texels along the shorter side: 16 x 16 cannot hold the distributions
// of all bearings to a percentage point, only to 2.
[[nodiscard]] constexpr int default_mips(glm::ivec2 extent) {
    int levels = 1;
    while (((std::min)(extent.x, extent.y) >> levels) >= 32) ++levels;
    return levels;
}

// How mips are made.
struct mip_options {
    // Keep the share of shadowed texels that level 0 has, for every elevation of the light: averages alone lose the
    // steep horizons, and shadows with them, as averages of alpha lose what is tested against it.
    bool keep_distribution = true;
    // As in bake_options. Sizes: mip_scratch_size.
    std::span<std::byte> scratch = {};
    std::pmr::memory_resource* memory = nullptr;  // null: std::pmr::get_default_resource()
};

namespace reduce_detail {

// The source texels under an output texel along one axis: [first, last], the ends with part of their width.
struct footprint {
    int first, last;
    float first_weight, last_weight;  // of a whole texel; last counts only where it is not first
};

[[nodiscard]] inline footprint under(int index, int from, int to) {
    // In units of 1 / to of a source texel all ends are whole numbers.
    const std::int64_t begin = std::int64_t(index) * from, end = begin + from;
    const int first = int(begin / to), last = int((end - 1) / to);
    return {first, last, float((std::min)(std::int64_t(first + 1) * to, end) - begin) / float(to),
            float(end - std::int64_t(last) * to) / float(to)};
}

// One row of an output slice: sums of stored values over rows, then over columns. work: `from.extent.x`, padded.
inline void reduce_row(const horizon_map& from, const horizon_scale& scale, int bearing, const horizon_map& out, int y,
                       float* work, float* sums) {
    const int width = from.extent.x;
    const footprint rows = under(y, from.extent.y, out.extent.y);
    std::fill_n(sums, width, 0.0f);
    for (int r = rows.first; r <= rows.last; ++r) {
        const float weight = r == rows.first ? rows.first_weight : r == rows.last ? rows.last_weight : 1.0f;
        const float* const row = from.row(bearing, r);
        slice_detail::lanes_seen seen;
        for (int x = 0; x < width; x += slice_detail::chunk)
            slice_detail::convert(scale, row + x, (std::min)(slice_detail::chunk, width - x), work + x, seen);
        for (int x = 0; x < width; ++x) sums[x] += weight * work[x];
    }
    const float area = float(double(from.extent.x) * from.extent.y / (double(out.extent.x) * out.extent.y));
    float* const to = out.row(bearing, y);
    for (int x = 0; x < out.extent.x; ++x) {
        const footprint columns = under(x, width, out.extent.x);
        float sum = columns.first_weight * sums[columns.first];
        for (int c = columns.first + 1; c < columns.last; ++c) sum += sums[c];
        if (columns.last > columns.first) sum += columns.last_weight * sums[columns.last];
        to[x] = slope_of_stored(scale, sum / area);
    }
}

// Distributions are kept in steps of 1 / 4095 of the stored quantity.
inline constexpr int bins = 4096;

[[nodiscard]] inline int bin_of(float stored) { return int(stored * float(bins - 1) + 0.5f); }

// Stored values at a bearing, or at a part of the way to the next one: what a shader interpolates there.
struct bearing_values {
    horizon_map map;  // stored values, not slopes
    int bearing, next;
    float part;  // 0: next is not read

    [[nodiscard]] float at(int x, int y) const {
        const float value = map.row(bearing, y)[x];
        return part == 0.0f ? value : value * (1.0f - part) + map.row(next, y)[x] * part;
    }
    // Moves the value by as small a change as possible of what it is made of.
    void add(int x, int y, float difference) const {
        const auto bounded = [](float v) { return v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f; };
        const float rest = 1.0f - part, share = difference / (rest * rest + part * part);
        float& value = map.row(bearing, y)[x];
        value = bounded(value + rest * share);
        if (part == 0.0f) return;
        float& other = map.row(next, y)[x];
        other = bounded(other + part * share);
    }
};

[[nodiscard]] inline float stored_with(const horizon_scale& scale, float factor, float slope) {
    const float value = quantity_of_slope(scale.stored, slope > 0.0f ? slope : 0.0f) * factor;
    return value < 1.0f ? value : 1.0f;
}

// How many texels of a map of slopes have which value.
inline void count_slopes(const bearing_values& slopes, const horizon_scale& scale, std::uint32_t* counts) {
    std::fill_n(counts, bins, 0u);
    const float factor = stored_scale(scale);
    for (int y = 0; y < slopes.map.extent.y; ++y) {
        const float *const row = slopes.map.row(slopes.bearing, y), *const other = slopes.map.row(slopes.next, y);
        for (int x = 0; x < slopes.map.extent.x; ++x) {
            const float value = stored_with(scale, factor, row[x]), next = stored_with(scale, factor, other[x]);
            ++counts[bin_of(value * (1.0f - slopes.part) + next * slopes.part)];
        }
    }
}

// The texels of a level that have about the same value share its ranks, from `first` on.
struct tie {
    std::uint32_t first, count, given;
};

// Moves the values at a bearing of a level to those of the map that have the same rank. Texels of one bin get its ranks
// in a scattered order (multiples of the golden section), so that an area that averaging made even still is shadowed to
// the right part.
//   counts: of the map, `total` in all. way: part of the way that they go. ties: bins of scratch. bin_of_rank: a number
//   a texel of scratch
inline void match(const bearing_values& level, const std::uint32_t* counts, std::size_t total, float way, tie* ties,
                  std::uint16_t* bin_of_rank) {
    const glm::ivec2 extent = level.map.extent;
    const std::size_t texels = required_size(extent, 1);
    std::size_t below = counts[0];
    for (std::size_t rank = 0, bin = 0; rank < texels; ++rank) {
        const double place = (double(rank) + 0.5) * double(total) / double(texels);
        while (double(below) <= place && bin + 1 < std::size_t(bins)) below += counts[++bin];
        bin_of_rank[rank] = static_cast<std::uint16_t>(bin);
    }
    std::fill_n(ties, bins, tie{0, 0, 0});
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) ++ties[bin_of(level.at(x, y))].count;
    for (int bin = 1; bin < bins; ++bin) ties[bin].first = ties[bin - 1].first + ties[bin - 1].count;
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            const float value = level.at(x, y);
            tie& t = ties[bin_of(value)];
            const std::uint32_t scattered = t.given++ * 2654435769u;
            const std::uint32_t rank = t.first + std::uint32_t((std::uint64_t(scattered) * t.count) >> 32);
            level.add(x, y, way * (float(bin_of_rank[rank]) * (1.0f / float(bins - 1)) - value));
        }
}

[[nodiscard]] inline status check_reduced(const horizon_map& from, const horizon_map& out) {
    if (out.extent.x <= 0) return {error::not_positive, "output extent.x", double(out.extent.x)};
    if (out.extent.y <= 0) return {error::not_positive, "output extent.y", double(out.extent.y)};
    if (out.extent.x > from.extent.x)
        return {error::out_of_range, "output extent.x", double(out.extent.x), double(from.extent.x)};
    if (out.extent.y > from.extent.y)
        return {error::out_of_range, "output extent.y", double(out.extent.y), double(from.extent.y)};
    return check_output(out, out.extent, std::size_t(from.bearings));
}

[[nodiscard]] inline std::size_t row_bytes(int width, int slots) {
    scratch_layout layout;
    for (int i = 0; i < slots; ++i) layout.add<float>(slice_detail::padded(width)).add<float>(std::size_t(width));
    return layout.add<float*>(2 * std::size_t(slots)).bytes();
}

template <executor Executor>
[[nodiscard]] status average(const horizon_map& from, const horizon_scale& scale, const horizon_map& out,
                             const bake_options& where, Executor&& execute) {
    const std::size_t items = std::size_t(from.bearings) * std::size_t(out.extent.y);
    const int slots = slot_pool::slots(execute.concurrency(), items);
    scratch_block block;
    if (status s = block.allocate(where, row_bytes(from.extent.x, slots), "the scratch of a reduction"); !s) return s;
    float** const rows = block.carve<float*>(2 * std::size_t(slots));
    for (int i = 0; i < slots; ++i) {
        rows[2 * i] = block.carve<float>(slice_detail::padded(from.extent.x));
        rows[2 * i + 1] = block.carve<float>(std::size_t(from.extent.x));
    }
    slot_pool pool(slots);
    execute(items, [&](std::size_t item) {
        const auto lease = pool.acquire();
        const int bearing = int(item / std::size_t(out.extent.y)), y = int(item % std::size_t(out.extent.y));
        reduce_row(from, scale, bearing, out, y, rows[2 * lease.index()], rows[2 * lease.index() + 1]);
    });
    return {};
}

}  // namespace reduce_detail

// Averages horizons over areas: output texel (x, y) covers the source from x * from.extent / out.extent to
// (x + 1) * from.extent / out.extent, exactly, whatever the extents are, so that its center stands at the same place of
// the map, in parts of its extent, and one texture coordinate serves both. No area reaches over the border: maps that
// repeat still do.
//   out: any extent up to the source's; reduced_extent gives the usual ones
//   scale: horizons are averaged in the stored quantity, clamped to [0, max_slope] first; a hole counts as 0
// Lit or shadowed wrongly at texels of the whole extent (mean of six maps): 2.8 % with 8 slices, but 3.9 % at half the
// extent, 7.2 % at a quarter, 14 % at an eighth, even with 32 slices: fewer slices cost less than fewer texels. Errors:
// sizes, and no memory (`memory`; two rows a thread).
template <executor Executor = serial>
[[nodiscard]] status reduce(const horizon_map& from, const horizon_scale& scale, const horizon_map& out,
                            Executor&& execute = {}, std::pmr::memory_resource* memory = nullptr) {
    using namespace reduce_detail;
    if (status s = check(scale); !s) return s;
    if (status s = check_horizons(from); !s) return s;
    if (status s = check_reduced(from, out); !s) return s;
    bake_options where;
    where.memory = memory;
    return average(from, scale, out, where, execute);
}

namespace reduce_detail {

// The bearings that are matched at a time, none of which share slices: first those between even slices and the next,
// then those from odd ones, the last of an odd number by itself, then the slices.
struct pass {
    int first, step, count;
    bool between;
};
[[nodiscard]] inline std::array<pass, 4> passes(int slices) {
    const bool odd = slices % 2 != 0;
    const int pairs = slices / 2;
    return {pass{0, 2, pairs, true}, pass{1, 2, odd ? pairs : (slices > 2 ? pairs : 0), true},
            pass{slices - 1, 1, odd && slices > 1 ? 1 : 0, true}, pass{0, 1, slices, false}};
}

// Where between two slices a round matches, counted from the last round; then come the slices.
inline constexpr float parts[3] = {0.5f, 0.25f, 0.75f};

// Small levels need more of them, and can afford them.
[[nodiscard]] constexpr int rounds(int level) { return 1 << (2 * (std::min)(level, 3)); }

struct mip_scratch {
    tie* ties;
    std::uint16_t* bin_of_rank;
};

[[nodiscard]] inline scratch_layout match_layout(glm::ivec2 first_level, int slices, int slots) {
    scratch_layout layout;
    for (int i = 0; i < slots; ++i)
        layout.add<tie>(std::size_t(bins)).add<std::uint16_t>(required_size(first_level, 1));
    return layout.add<mip_scratch>(std::size_t(slots)).add<std::uint32_t>(std::size_t(slices), 4 * bins);
}

// Slopes to stored values, or back, in place.
template <executor Executor>
void convert_all(const horizon_map& map, const horizon_scale& scale, bool back, Executor&& execute) {
    const float factor = stored_scale(scale);
    execute(std::size_t(map.bearings), [&](std::size_t bearing) {
        for (int y = 0; y < map.extent.y; ++y) {
            float* const row = map.row(int(bearing), y);
            for (int x = 0; x < map.extent.x; ++x)
                row[x] = back ? slope_of_stored(scale, row[x]) : stored_with(scale, factor, row[x]);
        }
    });
}

}  // namespace reduce_detail

// Bytes of scratch that make_mips takes, at the most: O(slices) besides a number for each texel of level 1 a thread.
[[nodiscard]] inline std::size_t mip_scratch_size(glm::ivec2 extent, int slices, int concurrency = 1) {
    using namespace reduce_detail;
    const std::size_t rows = row_bytes(extent.x, slot_pool::slots(concurrency, slot_pool::max_slots));
    const int slots = slot_pool::slots(concurrency, std::size_t(slices));
    return (std::max)(rows, match_layout({mip_extent(extent.x, 1), mip_extent(extent.y, 1)}, slices, slots).bytes());
}

// Fills the mips of a horizon map that has the slices of a texture and no other (fit_slices makes it of more), in their
// order around the circle.
//   levels: levels 1, 2 ... of its mip chain, extents as mip_extent has them, bearings as the map; written
//   scale: of the encoding that they are for
// Accuracy: the mean of the hard shadow factor over a level is within 1 percentage point of level 0's (1.07 on one of
// twelve maps at 32 texels), for lights of 10 to 60 degrees, at slices and between them, while levels are not smaller
// than default_mips makes them. Averages alone (keep_distribution off) are off by up to 2.8 points at level 1 and 54 at
// level 4.
// Errors: sizes; scratch.
template <executor Executor = serial>
[[nodiscard]] status make_mips(const horizon_map& map, const horizon_scale& scale, std::span<const horizon_map> levels,
                               const mip_options& options = {}, Executor&& execute = {}) {
    using namespace reduce_detail;
    if (status s = check(scale); !s) return s;
    if (status s = check_horizons(map); !s) return s;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const glm::ivec2 extent{mip_extent(map.extent.x, int(i) + 1), mip_extent(map.extent.y, int(i) + 1)};
        if (status s = check_output(levels[i], extent, std::size_t(map.bearings)); !s) return s;
    }
    if (levels.empty()) return {};
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    // All of it before anything is written.
    const std::size_t needed = mip_scratch_size(map.extent, map.bearings, execute.concurrency());
    scratch_block all, block;
    if (!options.scratch.empty() && options.scratch.size() < needed)
        return {error::too_small, "options.scratch", double(options.scratch.size()), double(needed)};
    if (options.scratch.empty()) {
        if (status s = all.allocate(where, scratch_layout().add<std::byte>(needed).bytes(), "the scratch of mips"); !s)
            return s;
        where.scratch = {all.carve<std::byte>(needed), needed};
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (status s = average(i == 0 ? map : levels[i - 1], scale, levels[i], where, execute); !s) return s;
    if (!options.keep_distribution) return {};

    const int slices = map.bearings, slots = slot_pool::slots(execute.concurrency(), std::size_t(slices));
    if (status s = block.allocate(where, needed, "the scratch of mips"); !s) return s;
    mip_scratch* const scratch = block.carve<mip_scratch>(std::size_t(slots));
    for (int i = 0; i < slots; ++i)
        scratch[i] = {block.carve<tie>(std::size_t(bins)),
                      block.carve<std::uint16_t>(required_size(levels[0].extent, 1))};
    std::uint32_t* const counts = block.carve<std::uint32_t>(4 * std::size_t(slices) * bins);
    // Of the slices, then of each part of the way to the next.
    execute(4 * std::size_t(slices), [&](std::size_t i) {
        const int bearing = int(i) % slices, group = int(i) / slices;
        count_slopes({map, bearing, (bearing + 1) % slices, group == 0 ? 0.0f : parts[group - 1]}, scale,
                     counts + i * bins);
    });
    slot_pool pool(slots);
    for (std::size_t n = 0; n < levels.size(); ++n) {
        const horizon_map& level = levels[n];
        convert_all(level, scale, false, execute);
        // Each pass undoes a part of the one before. Steps of half the way in the second half of the rounds share what
        // cannot be had at once.
        const int last = rounds(int(n) + 1) - 1;
        for (int round = 0; round <= last; ++round)
            for (const pass& p : passes(slices)) {
                const int group = (last - round) % 3;
                const float way = 2 * round > last && slices > 1 ? 0.5f : 1.0f;
                execute(std::size_t(p.count), [&](std::size_t i) {
                    const auto lease = pool.acquire();
                    const int bearing = p.first + int(i) * p.step;
                    const std::size_t of_map = std::size_t(p.between ? (group + 1) * slices + bearing : bearing);
                    match({level, bearing, (bearing + 1) % slices, p.between ? parts[group] : 0.0f},
                          counts + of_map * bins, required_size(map.extent, 1), way, scratch[lease.index()].ties,
                          scratch[lease.index()].bin_of_rank);
                });
            }
        convert_all(level, scale, true, execute);
    }
    return {};
}

}  // namespace bumpshadow
