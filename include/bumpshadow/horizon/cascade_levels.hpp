#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// The pyramid of heights that horizon/cascade.hpp looks at. Part of that header; nothing here is public.
//
// Level 0 is the map itself. At level j >= 1 horizons are found for cells of 2^j texels, looking at heights on a grid
// twice as fine: the grid of level j - 1. Its columns are stored apart, even ones first, so that what neighboring cells
// look at is contiguous again. All grids carry a halo in which the edge mode has been carried out, so that no loop asks
// where the border is.
namespace bumpshadow::cascade_detail {

inline constexpr int most_levels = 32;
inline constexpr int smallest_axis = 32;       // cells; an axis is halved as long as it has at least as many
inline constexpr int border = 8;               // cells a grid has beyond its halo, for cells next to the map
inline constexpr int chunk = 4 * simd::width;  // cells of a row that are worked on together
inline constexpr float hole = -1e37f;          // height of a hole; far enough below to never occlude
inline constexpr float hole_limit = -1e20f;    // what is below has a hole in it
inline constexpr float occluder_bias = 0.35f;  // a coarse occluder is its mean plus this part of the way to its maximum
inline constexpr double growth = 4.0;          // a level reaches so much farther than the one before

// Cells along one axis: of the map, and of the base grid of the pyramid, which can be halved `halvings` times.
struct axis_shape {
    int texels = 0;
    int cells = 0;
    int halvings = 0;
};

[[nodiscard]] constexpr axis_shape shape_axis(int texels) {
    axis_shape a{texels, texels, 0};
    while ((texels >> a.halvings) >= smallest_axis) ++a.halvings;
    const int block = 1 << a.halvings;
    a.cells = (texels + block - 1) / block * block;
    return a;
}

// Heights with a halo. Row-major; where columns are split, a row is its even columns and then its odd ones.
struct grid {
    float* values = nullptr;
    glm::ivec2 cells{0};
    glm::ivec2 halo{0};
    glm::dvec2 spacing{1.0};  // units of length between cells
    std::ptrdiff_t row_step = 0;
    std::ptrdiff_t plane = 0;  // from the even columns of a row to the odd ones; 0: not split

    [[nodiscard]] std::ptrdiff_t offset(std::int64_t x, std::int64_t y) const {
        const std::ptrdiff_t row = std::ptrdiff_t(y + halo.y) * row_step, column = std::ptrdiff_t(x + halo.x);
        return plane == 0 ? row + column : row + (column & 1) * plane + (column >> 1);
    }
    [[nodiscard]] std::size_t size() const { return std::size_t(row_step) * std::size_t(cells.y + 2 * halo.y); }
};

[[nodiscard]] inline grid shape_grid(glm::ivec2 cells, glm::ivec2 halo, glm::dvec2 spacing, bool split) {
    grid g{.cells = cells, .halo = halo, .spacing = spacing};
    g.halo.x += g.halo.x & 1;
    const std::ptrdiff_t columns = cells.x + 2 * g.halo.x;
    if (split) {
        g.plane = columns / 2 + chunk;  // split grids have an even number of cells
        g.row_step = 2 * g.plane;
    } else {
        g.row_step = columns + chunk;
    }
    return g;
}

struct level {
    grid origins;         // heights of the cells that horizons are found for; level 0: the same grid as occluders
    grid occluders;       // heights they look at
    glm::ivec2 ratio{1};  // occluder cells in an origin cell, 1 or 2
};

// How the levels of a map lie in memory; the same for all directions.
struct levels_shape {
    edge_mode edge = edge_mode::repeat;
    axis_shape x, y;
    double unit = 1.0;       // length that counts as 1 inside: the smaller texel size
    bool resampled = false;  // the base grid has other cells than the map, because those could not be halved seamlessly
    int count = 1;
    std::array<level, most_levels> levels{};

    [[nodiscard]] glm::ivec2 base_cells() const { return {x.cells, y.cells}; }
};

// Cells after which a row of cells and its continuation begin again; for clamp and open: after which nothing changes.
[[nodiscard]] constexpr std::int64_t period(int cells, edge_mode edge) {
    return edge == edge_mode::mirror   ? 2 * std::int64_t(cells)
           : edge == edge_mode::repeat ? cells
                                       : std::int64_t(cells) + border;
}

[[nodiscard]] inline levels_shape shape_levels(glm::ivec2 extent, glm::dvec2 texel_size, edge_mode edge, int steps) {
    levels_shape s;
    s.edge = edge;
    s.x = shape_axis(extent.x);
    s.y = shape_axis(extent.y);
    s.count = 1 + (std::max)(s.x.halvings, s.y.halvings);
    s.unit = (std::min)(texel_size.x, texel_size.y);
    const bool tiles = edge == edge_mode::repeat || edge == edge_mode::mirror;
    const glm::dvec2 size = texel_size / s.unit;
    glm::dvec2 base = size;
    if (tiles) {
        base.x *= double(extent.x) / double(s.x.cells);
        base.y *= double(extent.y) / double(s.y.cells);
        s.resampled = s.x.cells != extent.x || s.y.cells != extent.y;
    }
    const auto halo = [&](int cells, double reach, bool last) {
        const double most = double(period(cells, edge));
        return int(last ? most : (std::min)(std::ceil(reach) + 1.0, most)) + border;
    };
    for (int j = 0; j < s.count; ++j) {
        level& l = s.levels[std::size_t(j)];
        const bool last = j == s.count - 1;
        if (j == 0) {
            const double reach = steps;
            l.occluders = shape_grid(extent, {halo(extent.x, reach, last), halo(extent.y, reach, last)}, size, false);
            l.origins = l.occluders;
            continue;
        }
        const auto at = [](const axis_shape& a, int i) { return a.cells >> (std::min)(i, a.halvings); };
        const auto scale = [](const axis_shape& a, int i) { return double(1 << (std::min)(i, a.halvings)); };
        const glm::ivec2 fine(at(s.x, j - 1), at(s.y, j - 1)), coarse(at(s.x, j), at(s.y, j));
        const double reach = steps * std::pow(growth, j);
        l.ratio = fine / coarse;
        l.occluders = shape_grid(fine,
                                 {halo(fine.x, reach / scale(s.x, j - 1) * s.x.cells / s.x.texels, last),
                                  halo(fine.y, reach / scale(s.y, j - 1) * s.y.cells / s.y.texels, last)},
                                 base * glm::dvec2(scale(s.x, j - 1), scale(s.y, j - 1)), l.ratio.x == 2);
        l.origins = shape_grid(coarse, {border, border}, base * glm::dvec2(scale(s.x, j), scale(s.y, j)), false);
    }
    return s;
}

// Scratch: every grid, and the maxima of two levels while the pyramid is built.
inline void add_levels(const levels_shape& s, scratch_layout& layout) {
    for (int j = 0; j < s.count; ++j) {
        const level& l = s.levels[std::size_t(j)];
        layout.add<float>(l.occluders.size());
        if (j > 0) layout.add<float>(l.origins.size());
    }
    const std::size_t base = std::size_t(s.x.cells) * std::size_t(s.y.cells);
    layout.add<float>(base).add<float>(base).add<float>(2 * std::size_t(s.x.cells) + 4 * std::size_t(chunk));
}

// Fills what lies around the cells of a grid. Holes where there is nothing.
inline void fill_halo(const grid& g, edge_mode edge) {
    const auto row = [&](std::int64_t y) { return g.values + (y + g.halo.y) * g.row_step; };
    const auto column = [&](std::int64_t x) { return g.offset(x, -g.halo.y); };
    const int columns = g.cells.x + 2 * g.halo.x;
    for (int y = 0; y < g.cells.y; ++y) {
        float* r = row(y);
        for (int i = 1; i <= g.halo.x; ++i) {
            const std::int64_t left = resolve_edge(-i, g.cells.x, edge);
            const std::int64_t right = resolve_edge(g.cells.x - 1 + i, g.cells.x, edge);
            r[column(-i)] = left < 0 ? hole : r[column(left)];
            r[column(g.cells.x - 1 + i)] = right < 0 ? hole : r[column(right)];
        }
        // The last chunk of a row reads these without using them.
        if (g.plane == 0)
            std::fill(r + columns, r + g.row_step, 0.0f);
        else
            for (float* odd : {r, r + g.plane}) std::fill(odd + columns / 2, odd + g.plane, 0.0f);
    }
    for (int i = 1; i <= g.halo.y; ++i)
        for (const int y : {-i, g.cells.y - 1 + i}) {
            const std::int64_t from = resolve_edge(y, g.cells.y, edge);
            if (from < 0)
                std::fill_n(row(y), g.row_step, hole);
            else
                std::copy_n(row(from), g.row_step, row(y));
        }
}

// Copies the heights into level 0, in units of `unit`, and tells the lowest and the highest and whether there are
// holes.
struct height_range {
    float lowest = std::numeric_limits<float>::max();
    float highest = std::numeric_limits<float>::lowest();
    bool holes = false;
};

template <height_sample Sample>
[[nodiscard]] height_range fill_base(const height_map<Sample>& heights, double unit, const grid& g) {
    height_range range;
    // Integers and floats need no more than float has; the datum has to be taken off in double.
    const double scale = unit_height(heights) / unit, datum = heights.datum / unit;
    for (int y = 0; y < g.cells.y; ++y) {
        const Sample* from = heights.samples + y * heights.row_stride;
        float* to = g.values + g.offset(0, y);
        float lowest = range.lowest, highest = range.highest;
        if (!heights.no_data) {
            for (int x = 0; x < g.cells.x; ++x) {
                const float h = float(double(from[x]) * scale - datum);
                to[x] = h;
                lowest = h < lowest ? h : lowest;
                highest = h > highest ? h : highest;
            }
        } else {
            for (int x = 0; x < g.cells.x; ++x) {
                if (is_no_data(heights, from[x])) {
                    to[x] = hole;
                    range.holes = true;
                    continue;
                }
                to[x] = float(double(from[x]) * scale - datum);
                lowest = (std::min)(lowest, to[x]);
                highest = (std::max)(highest, to[x]);
            }
        }
        range.lowest = lowest;
        range.highest = highest;
    }
    return range;
}

// Where cell i of the base grid lies between texels: between `first` and `first + 1`, `part` of the way.
struct between {
    int first;
    float part;
};
[[nodiscard]] inline between place_between(const axis_shape& a, int i) {
    const double at = (i + 0.5) * a.texels / a.cells - 0.5, floor = std::floor(at);
    return {int(floor), float(at - floor)};
}

// Interpolated height of the base grid, raised towards the higher of the two as coarse occluders are, since a ridge
// between two samples would be lost. A hole on either side makes a hole.
[[nodiscard]] inline float resample(float a, float b, float part) {
    if (part == 0.0f) return a;
    if (a < hole_limit || b < hole_limit) return hole;
    const float mean = a + (b - a) * part;
    return mean + occluder_bias * ((std::max)(a, b) - mean);
}

// Row y of the base grid, x.cells wide. `row` has to hold 2 x.cells + chunk floats.
[[nodiscard]] inline const float* base_row(const levels_shape& s, int y, float* row) {
    const grid& g = s.levels[0].occluders;
    if (!s.resampled) {
        const std::int64_t from = resolve_edge(y, g.cells.y, s.edge);
        if (from < 0) {
            std::fill_n(row, s.x.cells, hole);
            return row;
        }
        const float* texels = g.values + g.offset(0, from);
        if (s.x.cells <= g.cells.x + g.halo.x) return texels;  // the halo continues the row
        for (int x = 0; x < s.x.cells; ++x) {
            const std::int64_t at = resolve_edge(x, g.cells.x, s.edge);
            row[x] = at < 0 ? hole : texels[at];
        }
        return row;
    }
    float* const blended = row + s.x.cells;  // a row of texels, and one more on either side
    const between v = place_between(s.y, y);
    const float* above = g.values + g.offset(-1, v.first);
    const float* below = above + g.row_step;
    for (int x = 0; x < s.x.texels + 2; ++x) blended[x] = resample(above[x], below[x], v.part);
    for (int x = 0; x < s.x.cells; ++x) {
        const between u = place_between(s.x, x);
        row[x] = resample(blended[u.first + 1], blended[u.first + 2], u.part);
    }
    return row;
}

// One cell from up to 2 x 2: mean and maximum of those that are not holes.
template <bool Holes>
void halve_row(const float* mean0, const float* mean1, const float* max0, const float* max1, glm::ivec2 ratio,
               int count, float* mean, float* top) {
    if constexpr (!Holes) {
        if (ratio.x == 2) {
            for (int i = 0; i < count; ++i) {
                mean[i] = ((mean0[2 * i] + mean0[2 * i + 1]) + (mean1[2 * i] + mean1[2 * i + 1])) * 0.25f;
                const float a = max0[2 * i] > max0[2 * i + 1] ? max0[2 * i] : max0[2 * i + 1];
                const float b = max1[2 * i] > max1[2 * i + 1] ? max1[2 * i] : max1[2 * i + 1];
                top[i] = a > b ? a : b;
            }
        } else {
            for (int i = 0; i < count; ++i) {
                mean[i] = (mean0[i] + mean1[i]) * 0.5f;
                top[i] = max0[i] > max1[i] ? max0[i] : max1[i];
            }
        }
    } else {
        for (int i = 0; i < count; ++i) {
            float sum = 0.0f, highest = hole;
            int valid = 0;
            for (int k = 0; k < ratio.x; ++k)
                for (const auto& [m, t] : {std::pair(mean0, max0), std::pair(mean1, max1)}) {
                    const int at = ratio.x * i + k;
                    if (m[at] < hole_limit) continue;
                    sum += m[at];
                    ++valid;
                    highest = (std::max)(highest, t[at]);
                }
            mean[i] = valid > 0 ? sum / float(valid) : hole;
            top[i] = highest;
        }
    }
}

// Builds all levels above 0, whose grid has to be filled, halo included. maxima: two arrays of base cells.
template <bool Holes>
void build_levels(const levels_shape& s, std::array<float*, 2> maxima, float* row_memory) {
    for (int j = 1; j < s.count; ++j) {
        const level& below = s.levels[std::size_t(j - 1)];
        const level& l = s.levels[std::size_t(j)];
        const grid& fine = l.occluders;
        float* const max_from = maxima[std::size_t(j & 1)];
        float* const max_to = maxima[std::size_t(~j & 1)];
        for (int y = 0; y < fine.cells.y; ++y) {
            const float* mean;
            const float* top;
            float* max_row = max_from + std::size_t(y) * std::size_t(fine.cells.x);
            if (j == 1) {
                mean = base_row(s, y, row_memory);
                std::copy_n(mean, fine.cells.x, max_row);
                top = max_row;
            } else {
                mean = below.origins.values + below.origins.offset(0, y);
                top = max_row;
            }
            if (fine.plane == 0) {
                float* to = fine.values + fine.offset(0, y);
                for (int x = 0; x < fine.cells.x; ++x) to[x] = mean[x] + occluder_bias * (top[x] - mean[x]);
            } else {
                float* even = fine.values + fine.offset(0, y);
                float* odd = even + fine.plane;
                for (int x = 0; x < fine.cells.x / 2; ++x) {
                    even[x] = mean[2 * x] + occluder_bias * (top[2 * x] - mean[2 * x]);
                    odd[x] = mean[2 * x + 1] + occluder_bias * (top[2 * x + 1] - mean[2 * x + 1]);
                }
            }
        }
        fill_halo(fine, s.edge);
        const grid& coarse = l.origins;
        for (int y = 0; y < coarse.cells.y; ++y) {
            const int y0 = y * l.ratio.y, y1 = y0 + l.ratio.y - 1;
            const auto max_row = [&](int r) { return max_from + std::size_t(r) * std::size_t(fine.cells.x); };
            const auto mean_row = [&](int r) {
                return j == 1 ? max_row(r) : below.origins.values + below.origins.offset(0, r);
            };
            halve_row<Holes>(mean_row(y0), mean_row(y1), max_row(y0), max_row(y1), l.ratio, coarse.cells.x,
                             coarse.values + coarse.offset(0, y),
                             max_to + std::size_t(y) * std::size_t(coarse.cells.x));
        }
        fill_halo(coarse, s.edge);
    }
}

}  // namespace bumpshadow::cascade_detail
