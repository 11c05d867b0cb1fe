#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/fourier_series.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Mips of radial horizon maps.

namespace bumpshadow {

namespace fourier_detail {

// Rows of level 0 whose coefficients are held at a time.
inline constexpr int counted_rows = 64;

// Rounds in which a level is brought to the distributions of level 0: small ones need more, and can afford them.
[[nodiscard]] constexpr int mip_rounds(int level) { return 4 << (std::min)(level, 3); }
// How far a round goes, in differences that it sees: the series keeps only a part of them.
inline constexpr float mip_step = 1.25f;

struct match_scratch {
    reduce_detail::tie* ties;
    std::uint16_t* bin_of_rank;
    float* plane;  // a number a texel of a level
    float* coefficients;
};

// The series of rows of a map, and the horizons that it stands for.
struct series_rows {
    const fourier& encoding;
    const float* weights;  // [term][direction]
    const float* basis;    // [direction][term]
    float* coefficients;   // [term][row][x] of the rows held
    std::size_t step = 0;  // from term to term
    int width = 0;

    // Row y of a map to row r of those held; work: as `project` takes it.
    void hold(const horizon_map& map, int y, int r, float* work) const {
        slice_detail::lanes_seen seen;
        for (int x = 0; x < width; x += chunk) {
            const int count = (std::min)(chunk, width - x);
            project(map, encoding, weights, x, y, count, work, work + encoding.coefficients * chunk, seen);
            for (int i = 0; i < encoding.coefficients; ++i)
                std::copy_n(work + i * chunk, count,
                            coefficients + std::size_t(i) * step + std::size_t(r) * std::size_t(width) + x);
        }
    }
    // Stored values in [0, 1] that row r has in a direction.
    void decode(int direction, int r, float* to) const {
        const float* const from = coefficients + std::size_t(r) * std::size_t(width);
        const float* const terms = basis + direction * encoding.coefficients;
        for (int x = 0; x < width; ++x) to[x] = terms[0] * from[x];
        for (int i = 1; i < encoding.coefficients; ++i) {
            const float* const row = from + std::size_t(i) * step;
            for (int x = 0; x < width; ++x) to[x] += terms[i] * row[x];
        }
        for (int x = 0; x < width; ++x) {
            const float above = to[x] > 0.0f ? to[x] : 0.0f;
            to[x] = above < 1.0f ? above : 1.0f;
        }
    }
};

// body(y, slot) for rows, in bands.
template <executor Executor, class Body>
void for_rows(int rows, slot_pool& pool, Executor&& execute, const Body& body) {
    execute(std::size_t(part_count(rows, rows_of_item)), [&](std::size_t item) {
        const auto lease = pool.acquire();
        const int first = int(item) * rows_of_item, end = first + (std::min)(rows_of_item, rows - first);
        for (int y = first; y < end; ++y) body(y, lease.index());
    });
}

struct mip_sizes {
    std::size_t directions, terms, held, first_level, row_bytes;
    int width, slots;
};

[[nodiscard]] inline mip_sizes sizes_of_mips(glm::ivec2 extent, std::size_t directions, const fourier& encoding,
                                             int concurrency) {
    const glm::ivec2 first{mip_extent(extent.x, 1), mip_extent(extent.y, 1)};
    const std::size_t texels = required_size(first, 1);
    const std::size_t rows = required_size({extent.x, (std::min)(extent.y, counted_rows)}, 1);
    const int slots = slot_pool::slots(concurrency, slot_pool::max_slots);
    return {directions, std::size_t(encoding.coefficients),        (std::max)(texels, rows),
            texels,     reduce_detail::row_bytes(extent.x, slots), extent.x,
            slots};
}

[[nodiscard]] inline std::size_t scratch_bytes(const mip_sizes& s) {
    scratch_layout layout;
    layout.add<std::byte>(s.row_bytes)
        .add<float>(s.directions, s.terms)
        .add<float>(s.directions, s.terms)
        .add<float>(s.held, s.terms);
    layout.add<std::uint32_t>(s.directions, reduce_detail::bins).add<match_scratch>(std::size_t(s.slots));
    for (int i = 0; i < s.slots; ++i)
        layout.add<reduce_detail::tie>(std::size_t(reduce_detail::bins))
            .add<std::uint16_t>(s.first_level)
            .add<float>((std::max)(s.first_level, std::size_t(s.width)))
            .add<float>(saturated_sum(s.terms, 1), chunk);
    return layout.bytes();
}

}  // namespace fourier_detail

// Bytes of scratch that make_fourier_mips takes, at the most: O(coefficients * texels of level 1), and 16 KiB a
// direction.
[[nodiscard]] inline std::size_t fourier_mip_scratch_size(glm::ivec2 extent, std::size_t directions,
                                                          const fourier& encoding, int concurrency = 1) {
    using namespace fourier_detail;
    return scratch_bytes(sizes_of_mips(extent, directions, encoding, concurrency));
}

// make_mips for pack_fourier: what the truncated series decodes to gets the distributions that it has at level 0. The
// levels' horizons are moved by the differences that are found there, round by round, from plain averages.
//   map, directions: as for pack_fourier; all directions are matched, and there may be more than slices of a texture
//   encoding: its scale and number of coefficients; ranges are tightened afterwards, to all levels
//   levels: as for make_mips; written. Their horizons are of use to pack_fourier only
// Accuracy: the mean of the hard shadow factor over a level is within 1 percentage point of level 0's (9 coefficients:
// 1.2) for lights of 10 to 60 degrees, in levels of 32 texels or more of nine maps; by make_mips within 8.0. On a
// tenth, a floor that is flat for the most part, it is off by up to 2.8 and 4.9 points at levels 3 and 4, at 10 degrees
// (by make_mips 4.7 and 7.6).
// Errors: sizes; those of fit_series; scratch.
template <executor Executor = serial>
[[nodiscard]] status make_fourier_mips(const horizon_map& map, std::span<const glm::dvec2> directions,
                                       const fourier& encoding, std::span<const horizon_map> levels,
                                       const mip_options& options = {}, Executor&& execute = {}) {
    using namespace fourier_detail;
    fourier free = encoding;
    free.ranges.fill({0.0f, 0.0f});
    if (status s = check(free); !s) return s;
    if (status s = check_horizons(map, directions); !s) return s;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const glm::ivec2 extent{mip_extent(map.extent.x, int(i) + 1), mip_extent(map.extent.y, int(i) + 1)};
        if (status s = check_output(levels[i], extent, std::size_t(map.bearings)); !s) return s;
    }
    if (levels.empty()) return {};
    const mip_sizes sizes = sizes_of_mips(map.extent, directions.size(), encoding, execute.concurrency());
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    scratch_block block;
    if (status s = block.allocate(where, scratch_bytes(sizes), "the scratch of mips"); !s) return s;
    where.scratch = {block.carve<std::byte>(sizes.row_bytes), sizes.row_bytes};
    float* const weights = block.carve<float>(sizes.directions * sizes.terms);
    float* const basis = block.carve<float>(sizes.directions * sizes.terms);
    float* const held = block.carve<float>(sizes.held * sizes.terms);
    std::uint32_t* const counts = block.carve<std::uint32_t>(sizes.directions * reduce_detail::bins);
    match_scratch* const scratch = block.carve<match_scratch>(std::size_t(sizes.slots));
    for (int i = 0; i < sizes.slots; ++i)
        scratch[i] = {block.carve<reduce_detail::tie>(std::size_t(reduce_detail::bins)),
                      block.carve<std::uint16_t>(sizes.first_level),
                      block.carve<float>((std::max)(sizes.first_level, std::size_t(sizes.width))),
                      block.carve<float>((sizes.terms + 1) * chunk)};
    if (status s = fit_series(directions, encoding.coefficients, {weights, sizes.directions * sizes.terms}); !s)
        return s;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const horizon_map& above = i == 0 ? map : levels[i - 1];
        if (status s = reduce_detail::average(above, encoding.scale, levels[i], where, execute); !s) return s;
    }
    if (!options.keep_distribution) return {};

    for (std::size_t d = 0; d < sizes.directions; ++d) {
        const fourier_terms terms = terms_of(directions[d]);
        for (std::size_t i = 0; i < sizes.terms; ++i)
            basis[d * sizes.terms + i] = float(terms[i] * (i == 0 ? 1.0 : 2.0));
    }

    slot_pool pool(sizes.slots);
    const int bearings = map.bearings;
    std::fill_n(counts, sizes.directions * reduce_detail::bins, 0u);
    for (int first = 0; first < map.extent.y; first += counted_rows) {
        const int rows = (std::min)(counted_rows, map.extent.y - first);
        const series_rows series{encoding, weights, basis, held, required_size({map.extent.x, rows}, 1), map.extent.x};
        for_rows(rows, pool, execute,
                 [&](int r, int slot) { series.hold(map, first + r, r, scratch[slot].coefficients); });
        execute(std::size_t(bearings), [&](std::size_t bearing) {
            const auto lease = pool.acquire();
            float* const row = scratch[lease.index()].plane;
            std::uint32_t* const of_bearing = counts + bearing * reduce_detail::bins;
            for (int r = 0; r < rows; ++r) {
                series.decode(int(bearing), r, row);
                for (int x = 0; x < map.extent.x; ++x) ++of_bearing[reduce_detail::bin_of(row[x])];
            }
        });
    }

    fourier stored = encoding;  // of values that are stored ones already
    stored.scale = {quantity::slope, 1.0f};
    for (int n = 1; n <= int(levels.size()); ++n) {
        const horizon_map& level = levels[std::size_t(n) - 1];
        reduce_detail::convert_all(level, encoding.scale, false, execute);
        const int width = level.extent.x, height = level.extent.y;
        const series_rows series{stored, weights, basis, held, required_size(level.extent, 1), width};
        for (int round = 0; round < mip_rounds(n); ++round) {
            for_rows(height, pool, execute,
                     [&](int y, int slot) { series.hold(level, y, y, scratch[slot].coefficients); });
            execute(std::size_t(bearings), [&](std::size_t bearing) {
                const auto lease = pool.acquire();
                const match_scratch& own = scratch[lease.index()];
                const horizon_map plane{
                    .values = {own.plane, required_size(level.extent, 1)}, .extent = level.extent, .bearings = 1};
                for (int y = 0; y < height; ++y) {
                    float* const row = plane.row(0, y);
                    series.decode(int(bearing), y, row);
                    float* const to = level.row(int(bearing), y);
                    for (int x = 0; x < width; ++x) to[x] -= mip_step * row[x];
                }
                reduce_detail::match({plane, 0, 0, 0.0f}, counts + bearing * reduce_detail::bins,
                                     required_size(map.extent, 1), 1.0f, own.ties, own.bin_of_rank);
                for (int y = 0; y < height; ++y) {
                    const float* const row = plane.row(0, y);
                    float* const to = level.row(int(bearing), y);
                    for (int x = 0; x < width; ++x) {
                        const float moved = to[x] + mip_step * row[x];
                        to[x] = moved > 0.0f ? (moved < 1.0f ? moved : 1.0f) : 0.0f;
                    }
                }
            });
        }
        reduce_detail::convert_all(level, encoding.scale, true, execute);
    }
    return {};
}

}  // namespace bumpshadow
