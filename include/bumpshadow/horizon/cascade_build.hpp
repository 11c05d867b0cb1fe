#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/relief.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// Fills the pyramid of heights. Part of horizon/cascade.hpp.
namespace bumpshadow::cascade_detail {

inline void fill_overhang(const plane& p, edge_mode edge) {
    for (int y = 0; y < p.cells.y; ++y)
        for (int x = p.cells.x; x < p.cells.x + overhang; ++x) {
            const std::int64_t from = resolve_column(x, p.cells.x, edge);
            p.row(y)[x] = from < 0 ? hole : p.row(y)[from];
        }
}

inline void fill_halo(const ground& g, edge_mode edge) {
    const int columns = g.texels.x + 2 * g.halo.x;
    for (int y = 0; y < g.texels.y; ++y) {
        float* row = g.values + g.offset(0, y);
        for (int i = 1; i <= g.halo.x; ++i) {
            const std::int64_t left = resolve_edge(-i, g.texels.x, edge);
            const std::int64_t right = resolve_edge(g.texels.x - 1 + i, g.texels.x, edge);
            row[-i] = left < 0 ? hole : row[left];
            row[g.texels.x - 1 + i] = right < 0 ? hole : row[right];
        }
        // The last pack of a row reads these without using them.
        std::fill(row - g.halo.x + columns, row - g.halo.x + g.row_step, 0.0f);
    }
    const auto row = [&](std::int64_t y) { return g.values + (y + g.halo.y) * g.row_step; };
    for (int i = 1; i <= g.halo.y; ++i)
        for (const int y : {-i, g.texels.y - 1 + i}) {
            const std::int64_t from = resolve_edge(y, g.texels.y, edge);
            if (from < 0)
                std::fill_n(row(y), g.row_step, hole);
            else
                std::copy_n(row(from), g.row_step, row(y));
        }
}

using relief_detail::height_range;

// Copies rows of the heights into level 0.
template <height_sample Sample>
[[nodiscard]] height_range fill_rows(const height_map<Sample>& heights, const pyramid& p, double reference, int first,
                                     int end) {
    height_range range;
    const double scale = relief_detail::height_in_texels(heights);
    for (int y = first; y < end; ++y)
        (void)relief_detail::copy_row(heights, y, reference, scale, hole, p.texels.values + p.texels.offset(0, y),
                                      range);
    return range;
}

// Copies all of them, in bands.
template <height_sample Sample, class Executor>
[[nodiscard]] height_range fill_ground(const height_map<Sample>& heights, const pyramid& p, Executor&& execute) {
    std::array<height_range, 16> ranges;
    const double reference = reference_sample(heights);
    const int rows = p.texels.texels.y,
              bands = (std::clamp)(int(execute.concurrency()), 1, (std::min)(rows, int(ranges.size())));
    execute(std::size_t(bands), [&](std::size_t i) {
        const auto edge_of = [&](std::size_t band) { return int(std::int64_t(rows) * std::int64_t(band) / bands); };
        ranges[i] = fill_rows(heights, p, reference, edge_of(i), edge_of(i + 1));
    });
    for (const height_range& r : ranges) {
        ranges[0].lowest = (std::min)(ranges[0].lowest, r.lowest);
        ranges[0].highest = (std::max)(ranges[0].highest, r.highest);
    }
    fill_halo(p.texels, p.edge);
    return ranges[0];
}

// Level 0 of the transposed map.
inline void transpose_ground(const pyramid& from, const pyramid& to) {
    constexpr int block = 32;
    const glm::ivec2 n = to.texels.texels;
    for (int y0 = 0; y0 < n.y; y0 += block)
        for (int x0 = 0; x0 < n.x; x0 += block)
            for (int y = y0; y < (std::min)(y0 + block, n.y); ++y) {
                float* row = to.texels.values + to.texels.offset(0, y);
                const float* column = from.texels.values + from.texels.offset(y, 0);
                for (int x = x0; x < (std::min)(x0 + block, n.x); ++x) row[x] = column[x * from.texels.row_step];
            }
    fill_halo(to.texels, to.edge);
}

// Interpolated height, raised towards the higher of the two, since a ridge between two samples would be lost. A hole on
// either side makes a hole.
[[nodiscard]] inline float resample(float a, float b, float part, bool holes) {
    if (part == 0.0f) return a;
    if (holes && (a < hole_limit || b < hole_limit)) return hole;
    const float mean = a + (b - a) * part;
    return mean + resampled_bias * ((std::max)(a, b) - mean);
}

// The finest grid that can be halved, where level 0 cannot: maps that end are continued to an even size, and maps that
// tile are resampled to one, so that they still tile.
inline void copy_base(const pyramid& p, const plane& to, float* blended, bool holes) {
    const ground& g = p.texels;
    for (int y = 0; y < to.cells.y; ++y) {
        float* row = to.row(y);
        if (!p.resampled()) {
            const std::int64_t from = resolve_edge(y, g.texels.y, p.edge);
            for (int x = 0; x < to.cells.x; ++x) {
                const std::int64_t at = resolve_edge(x, g.texels.x, p.edge);
                row[x] = from < 0 || at < 0 ? hole : g.values[g.offset(at, from)];
            }
            continue;
        }
        const double v = (y + 0.5) / p.base.y - 0.5, above = std::floor(v);
        const float* texels = g.values + g.offset(-1, std::int64_t(above));
        for (int x = 0; x < g.texels.x + 2; ++x)
            blended[x] = resample(texels[x], texels[x + g.row_step], float(v - above), holes);
        for (int x = 0; x < to.cells.x; ++x) {
            const double u = (x + 0.5) / p.base.x - 0.5, left = std::floor(u);
            row[x] = resample(blended[int(left) + 1], blended[int(left) + 2], float(u - left), holes);
        }
    }
}

// Cells of a level from those of the one below: mean and maximum of those that are not holes.
template <bool Holes>
void halve(const plane& mean, const plane& top, glm::ivec2 ratio, const plane& to_mean, const plane& to_top) {
    for (int y = 0; y < to_mean.cells.y; ++y) {
        const float* m0 = mean.row(y * ratio.y);
        const float* m1 = mean.row(y * ratio.y + ratio.y - 1);
        const float* t0 = top.row(y * ratio.y);
        const float* t1 = top.row(y * ratio.y + ratio.y - 1);
        float* to_m = to_mean.row(y);
        float* to_t = to_top.row(y);
        if constexpr (!Holes)
            if (ratio.x == 2) {  // beyond the last cell is the overhang
                const auto columns = [](const float* from, int i) {
                    const simd::pack low = simd::load(from + 2 * i), high = simd::load(from + 2 * i + simd::width);
                    return std::pair(simd::even(low, high), simd::odd(low, high));
                };
                for (int i = 0; i < to_mean.cells.x; i += simd::width) {
                    const auto [a, b] = columns(m0, i);
                    const auto [c, d] = columns(m1, i);
                    const simd::pack quarter = simd::splat(0.25f);
                    simd::pack sum = simd::multiply_add(b, quarter, simd::multiply(a, quarter));
                    sum = simd::multiply_add(c, quarter, sum);
                    simd::store(to_m + i, simd::multiply_add(d, quarter, sum));
                    const auto [e, f] = columns(t0, i);
                    const auto [g, h] = columns(t1, i);
                    simd::store(to_t + i, simd::larger(simd::larger(e, f), simd::larger(g, h)));
                }
                continue;
            }
        const int next = ratio.x - 1;
        for (int i = 0; i < to_mean.cells.x; ++i) {
            if constexpr (!Holes) {
                const int a = ratio.x * i, b = a + next;
                to_m[i] = ((m0[a] + m0[b]) + (m1[a] + m1[b])) * 0.25f;
                const float h0 = t0[a] > t0[b] ? t0[a] : t0[b], h1 = t1[a] > t1[b] ? t1[a] : t1[b];
                to_t[i] = h0 > h1 ? h0 : h1;
            } else {
                float sum = 0.0f, highest = hole;
                int valid = 0;
                for (const auto& [m, t] : {std::pair(m0, t0), std::pair(m1, t1)})
                    for (int a = ratio.x * i; a <= ratio.x * i + next; ++a) {
                        if (m[a] < hole_limit) continue;
                        sum += m[a];
                        ++valid;
                        highest = (std::max)(highest, t[a]);
                    }
                to_m[i] = valid > 0 ? sum / float(valid) : hole;
                to_t[i] = highest;
            }
        }
    }
}

// Means of cells two rows high and one column wide, of those that are not holes.
template <bool Holes>
void halve_rows(const plane& mean, const plane& to) {
    for (int y = 0; y < to.cells.y; ++y) {
        const float* upper = mean.row(2 * y);
        const float* lower = mean.row((std::min)(2 * y + 1, mean.cells.y - 1));
        float* row = to.row(y);
        for (int x = 0; x < to.cells.x; ++x) {
            row[x] = (upper[x] + lower[x]) * 0.5f;
            if constexpr (Holes)
                if (row[x] < hole_limit) row[x] = (std::max)(upper[x], lower[x]);
        }
    }
}

// Takes the memory of a pyramid, as add_pyramid counted it.
struct pyramid_scratch {
    std::array<float*, 2> means{}, maxima{};
    float* row = nullptr;
};
[[nodiscard]] inline pyramid_scratch carve_pyramid(pyramid& p, scratch_block& block) {
    pyramid_scratch s;
    p.texels.values = block.carve<float>(p.texels.size());
    for (int j = 1; j < p.count; ++j) {
        level& l = p.levels[std::size_t(j)];
        if (j == 1 && !p.copied)
            l.occluders = {p.texels.values + p.texels.offset(0, 0), p.texels.texels, p.texels.row_step};
        else
            l.occluders.values = block.carve<float>(plane_floats(l.occluders));
        l.origins.values = block.carve<float>(plane_floats(l.origins));
        if (!has_own_squares(l)) continue;
        s.means[std::size_t(j & 1)] = block.carve<float>(plane_floats(squares(l, nullptr)));
        s.maxima[std::size_t(j & 1)] = block.carve<float>(plane_floats(squares(l, nullptr)));
    }
    s.row = block.carve<float>(std::size_t(p.texels.texels.x) + 2);
    return s;
}

// Builds the levels from 1 on; level 0 has to be filled.
inline void build_pyramid(const pyramid& p, bool holes, const pyramid_scratch& scratch) {
    plane mean, top;
    for (int j = 1; j < p.count; ++j) {
        const level& l = p.levels[std::size_t(j)];
        if (j == 1) {
            if (p.copied) copy_base(p, l.occluders, scratch.row, holes);
            mean = top = l.occluders;
        }
        if (l.width > 1) {
            const plane to_mean = squares(l, scratch.means[std::size_t(j & 1)]),
                        to_top = squares(l, scratch.maxima[std::size_t(j & 1)]);
            (holes ? halve<true> : halve<false>)(mean, top, l.ratio, to_mean, to_top);
            mean = to_mean;
            top = to_top;
        }
        (holes ? halve_rows<true> : halve_rows<false>)(mean, l.origins);
        fill_overhang(l.origins, p.edge);
        for (int y = 0; j > 1 && y < l.occluders.cells.y; ++y) {
            float* to = l.occluders.row(y);
            const float* m = mean.row(y);
            const float* t = top.row(y);
            for (int x = 0; x < l.occluders.cells.x; ++x) to[x] = m[x] + occluder_bias * (t[x] - m[x]);
        }
        if (j > 1 || p.copied) fill_overhang(l.occluders, p.edge);
    }
}

}  // namespace bumpshadow::cascade_detail
