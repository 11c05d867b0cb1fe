#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// The pyramid of heights that horizon/cascade.hpp looks at. Part of that header; nothing here is public.
//
// Level 0 is the map itself, with a halo in which the edge mode has been carried out, so that its loops need not ask
// where the border is. At level j >= 1 horizons are found for cells of 2^j texels, looking at heights of the level
// below.
namespace bumpshadow::cascade_detail {

inline constexpr int most_levels = 32;
inline constexpr int border = 8;  // texels that level 0 has beyond its halo
inline constexpr int overhang = 2 * simd::width + 2;
inline constexpr float hole = -1e37f;           // height of a hole; far enough below to never occlude
inline constexpr float hole_limit = -1e20f;     // what is below has a hole in it
inline constexpr float occluder_bias = 0.6f;    // a coarse occluder is its mean and this part of the way to its maximum
inline constexpr float resampled_bias = 0.25f;  // the same of a height that is resampled between two

// With so many steps cells of level 1 are one column wide instead of two. That takes the place of half of the steps.
inline constexpr int narrow_from = 32;
[[nodiscard]] constexpr bool is_narrow(int steps) { return steps >= narrow_from; }

// Rows that level 0 looks at; more on maps that only level 0 sees as they are.
[[nodiscard]] constexpr int near_rows(int steps, bool resampled) {
    return !is_narrow(steps) ? steps : resampled ? steps / 4 * 3 : steps / 2;
}

// How much farther a level reaches than the one below. Level 1 has to see some way even with few steps, since the
// levels above it stand too far apart to tell what is that near.
[[nodiscard]] constexpr double growth(int level, int near, bool narrow) {
    return level == 1 ? (std::max)(80.0 / near, narrow ? 4.0 : 3.0) : level == 2 ? 3.5 : 2.5;
}

// Heights without a border; but each row goes on for `overhang` cells as the edge says, so that packs may begin
// anywhere.
struct plane {
    float* values = nullptr;
    glm::ivec2 cells{0};
    std::ptrdiff_t row_step = 0;

    [[nodiscard]] float* row(std::int64_t y) const { return values + y * row_step; }
};

// Level 0: texel (0, 0) lies at `origin`.
struct ground {
    float* values = nullptr;
    glm::ivec2 texels{0};
    glm::ivec2 halo{0};
    std::ptrdiff_t row_step = 0;

    [[nodiscard]] std::ptrdiff_t offset(std::int64_t x, std::int64_t y) const {
        return (y + halo.y) * row_step + x + halo.x;
    }
    [[nodiscard]] std::size_t size() const { return std::size_t(row_step) * std::size_t(texels.y + 2 * halo.y); }
};

// Cells are twice as high as they are wide: what is seen changes faster across rays than along them.
struct level {
    plane occluders;        // what its cells look at: squares, raised towards their maxima
    plane origins;          // the cells' own heights: means
    int width = 1;          // of a cell, in columns of the base grid, a power of two
    int stride = 1;         // the same in columns of occluders, 1 or 2
    glm::ivec2 squares{0};  // as wide as cells
    glm::ivec2 ratio{1};    // squares of the level below in one of this along x and y, 1 or 2

    [[nodiscard]] int rows_a_cell() const { return 2 * stride; }  // of occluders
    [[nodiscard]] int occluder_size() const { return width / stride; }
};

// How the levels of a map lie in memory; the same for all directions. Lengths are in units of `unit`.
struct pyramid {
    edge_mode edge = edge_mode::repeat;
    double unit = 1.0;        // length that counts as 1 inside: the smaller texel size
    glm::dvec2 spacing{1.0};  // between texels
    glm::dvec2 base{1.0};     // cells of the finest grid that can be halved, over texels; 1 but for odd maps that tile
    bool narrow = false;      // level 1 looks at the map as it is, and no other level does
    bool copied = false;      // that grid is not level 0 itself
    int near = 1;             // rows that level 0 looks at
    int count = 1;            // levels
    ground texels;
    std::array<level, most_levels> levels{};  // from 1 on

    [[nodiscard]] bool resampled() const { return base.x != 1.0 || base.y != 1.0; }
    // Where a place on the base grid lies between columns or rows of cells that are so many of its own wide or high.
    [[nodiscard]] static double in_cells(double place, int size) { return (place - 0.5 * (size - 1)) / size; }
    // The row in the middle of the map, counted in rows of cells so many rows of the base grid high.
    [[nodiscard]] double middle(int height) const {
        return in_cells(0.5 * (double(texels.texels.y) * base.y - 1.0), height);
    }
};

// After so many cells a row repeats itself or, for clamp and open, changes no more.
[[nodiscard]] constexpr std::int64_t period(int cells, edge_mode edge) {
    return edge == edge_mode::mirror   ? 2 * std::int64_t(cells)
           : edge == edge_mode::repeat ? std::int64_t(cells)
                                       : std::int64_t(cells) + border;
}

[[nodiscard]] inline pyramid shape_pyramid(glm::ivec2 extent, glm::dvec2 texel_size, edge_mode edge, int steps) {
    pyramid p;
    p.edge = edge;
    p.unit = (std::min)(texel_size.x, texel_size.y);
    p.spacing = texel_size / p.unit;
    int halvings = 0;
    while (((std::max)(extent.x, extent.y) >> halvings) >= 16) ++halvings;
    p.narrow = is_narrow(steps);
    p.count = halvings <= 1 ? 1 : halvings + (p.narrow ? 1 : 0);

    const auto base_cells = [&](int texels) {
        const unsigned block = (std::min)(1u << halvings, std::bit_ceil(unsigned(texels)));
        return int((unsigned(texels) + block - 1) / block * block);
    };
    const glm::ivec2 cells(base_cells(extent.x), base_cells(extent.y));
    p.copied = cells.x != extent.x || cells.y != extent.y || edge == edge_mode::open;
    if (edge == edge_mode::repeat || edge == edge_mode::mirror) p.base = glm::dvec2(cells) / glm::dvec2(extent);

    p.near = near_rows(steps, p.resampled());
    const auto halo = [&](int texels) {
        const std::int64_t most = period(texels, edge);
        return int(p.count == 1 ? most : (std::min)(std::int64_t(p.near) + 1, most)) + border;
    };
    p.texels.texels = extent;
    // Rows begin at a multiple of the pack width, as far as the map's first column goes.
    const auto whole_packs = [](int n) { return (n + simd::width - 1) / simd::width * simd::width; };
    p.texels.halo = {whole_packs((std::max)(halo(extent.x), overhang)), halo(extent.y)};
    p.texels.row_step = whole_packs(extent.x) + 2 * p.texels.halo.x + 4 * simd::width;

    glm::ivec2 fine = cells;
    for (int j = 1; j < p.count; ++j) {
        level& l = p.levels[std::size_t(j)];
        l.width = p.narrow ? 1 << (j - 1) : 1 << j;
        l.stride = l.width == 2 && j == 1 ? 2 : 1;
        if (l.width > 1) l.ratio = {fine.x > 1 ? 2 : 1, fine.y > 1 ? 2 : 1};
        l.squares = fine / l.ratio;
        const glm::ivec2 seen = j == 1 ? fine : l.squares;
        l.occluders = {nullptr, seen, seen.x + overhang};
        l.origins = {nullptr, {l.squares.x, (l.squares.y + 1) / 2}, l.squares.x + overhang};
        fine = l.squares;
    }
    return p;
}

[[nodiscard]] inline std::size_t plane_floats(const plane& p) {
    return std::size_t(p.row_step) * std::size_t(p.cells.y);
}

// Column of a plane that stands in for column x, or -1. Beside the border of an open map the surface is taken to go on
// for two cells, since a cell there stands for texels that see along the border; what a texel itself cannot see is left
// out at the end.
[[nodiscard]] inline std::int64_t resolve_column(std::int64_t x, std::int64_t cells, edge_mode edge) {
    if (edge == edge_mode::open && x >= -2 && x < cells + 2) edge = edge_mode::clamp;
    return resolve_edge(x, cells, edge);
}

inline void fill_overhang(const plane& p, edge_mode edge) {
    for (int y = 0; y < p.cells.y; ++y)
        for (int x = p.cells.x; x < p.cells.x + overhang; ++x) {
            const std::int64_t from = resolve_column(x, p.cells.x, edge);
            p.row(y)[x] = from < 0 ? hole : p.row(y)[from];
        }
}

// Means or maxima of a level's squares, while the next is built from them.
[[nodiscard]] inline plane squares(const level& l, float* values) {
    return {values, l.squares, l.squares.x + overhang};
}
// There are two of both: those of a level are in the place of those two levels below.
[[nodiscard]] inline bool has_own_squares(const level& l) { return l.width == 2 || l.width == 4; }

// Scratch of a pyramid: its planes, and the squares of two levels while it is built.
inline void add_pyramid(const pyramid& p, scratch_layout& layout) {
    layout.add<float>(p.texels.size());
    for (int j = 1; j < p.count; ++j) {
        const level& l = p.levels[std::size_t(j)];
        if (j > 1 || p.copied) layout.add<float>(plane_floats(l.occluders));
        layout.add<float>(plane_floats(l.origins));
        for (int i = 0; has_own_squares(l) && i < 2; ++i) layout.add<float>(plane_floats(squares(l, nullptr)));
    }
    layout.add<float>(std::size_t(p.texels.texels.x) + 2);
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

struct height_range {
    float lowest = std::numeric_limits<float>::max();
    float highest = std::numeric_limits<float>::lowest();
};

// Copies rows of the heights into level 0, in units of length.
template <height_sample Sample>
[[nodiscard]] height_range fill_rows(const height_map<Sample>& heights, const pyramid& p, int first, int end) {
    height_range range;
    const double scale = unit_height(heights) / p.unit, datum = heights.datum / p.unit;
    for (int y = first; y < end; ++y) {
        const Sample* from = heights.samples + y * heights.row_stride;
        float* to = p.texels.values + p.texels.offset(0, y);
        float lowest = range.lowest, highest = range.highest;
        for (int x = 0; x < p.texels.texels.x; ++x) {
            const float h = float(double(from[x]) * scale - datum);
            to[x] = h;
            lowest = h < lowest ? h : lowest;
            highest = h > highest ? h : highest;
        }
        if (heights.no_data) {
            lowest = range.lowest, highest = range.highest;
            for (int x = 0; x < p.texels.texels.x; ++x) {
                if (is_no_data(heights, from[x])) {
                    to[x] = hole;
                } else {
                    lowest = (std::min)(lowest, to[x]);
                    highest = (std::max)(highest, to[x]);
                }
            }
        }
        range.lowest = lowest;
        range.highest = highest;
    }
    return range;
}

// Copies all of them, in bands.
template <height_sample Sample, class Executor>
[[nodiscard]] height_range fill_ground(const height_map<Sample>& heights, const pyramid& p, Executor&& execute) {
    std::array<height_range, 16> ranges;
    const int rows = p.texels.texels.y,
              bands = std::clamp(execute.concurrency(), 1, (std::min)(rows, int(ranges.size())));
    execute(std::size_t(bands), [&](std::size_t i) {
        const auto edge_of = [&](std::size_t band) { return int(std::int64_t(rows) * std::int64_t(band) / bands); };
        ranges[i] = fill_rows(heights, p, edge_of(i), edge_of(i + 1));
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
[[nodiscard]] inline float resample(float a, float b, float part) {
    if (part == 0.0f) return a;
    if (a < hole_limit || b < hole_limit) return hole;
    const float mean = a + (b - a) * part;
    return mean + resampled_bias * ((std::max)(a, b) - mean);
}

// The finest grid that can be halved, where level 0 cannot: maps that end are continued to an even size, and maps that
// tile are resampled to one, so that they still tile.
inline void copy_base(const pyramid& p, const plane& to, float* blended) {
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
            blended[x] = resample(texels[x], texels[x + g.row_step], float(v - above));
        for (int x = 0; x < to.cells.x; ++x) {
            const double u = (x + 0.5) / p.base.x - 0.5, left = std::floor(u);
            row[x] = resample(blended[int(left) + 1], blended[int(left) + 2], float(u - left));
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
            if (p.copied) copy_base(p, l.occluders, scratch.row);
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
