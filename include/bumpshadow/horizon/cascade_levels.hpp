#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// The pyramid of heights that horizon/cascade.hpp looks at. Part of that header; nothing here is public.
//
// Level 0 is the map itself, with a halo in which the edge mode has been carried out, so that its loops need not ask
// where the border is. At the levels from 1 on horizons are found for cells, whose size doubles from level to level;
// the first looks at texels, the others at squares as wide as their cells.
namespace bumpshadow::cascade_detail {

inline constexpr int most_levels = 32;
inline constexpr int border = 8;  // texels that level 0 has beyond its halo
inline constexpr int overhang = 2 * simd::width + 2;
inline constexpr float hole = -1e37f;           // height of a hole; far enough below to never occlude
inline constexpr float hole_limit = -1e20f;     // what is below has a hole in it
inline constexpr float occluder_bias = 0.6f;    // a coarse occluder is its mean and this part of the way to its maximum
inline constexpr float resampled_bias = 0.25f;  // the same of a height that is resampled between two

// With so many steps cells of level 1 are one column wide instead of two. That takes the place of many of the steps.
inline constexpr int narrow_from = 32;
[[nodiscard]] constexpr bool is_narrow(int steps) { return steps >= narrow_from; }

// Rows that level 0 looks at; more on maps that only level 0 sees as they are.
[[nodiscard]] constexpr int near_rows(int steps, bool resampled) {
    return !is_narrow(steps) ? steps : resampled ? steps / 4 * 3 : steps * 7 / 12;
}

// How much farther a level reaches than the one below. Level 1 has to see some way even with few steps, since the
// levels above it stand too far apart to tell what is that near.
[[nodiscard]] constexpr double growth(int level, int ground_rows, bool narrow) {
    return level == 1 ? (std::max)(80.0 / ground_rows, narrow ? 3.3 : 3.0) : level == 2 ? 3.5 : 2.5;
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
        return std::ptrdiff_t((y + halo.y) * row_step + x + halo.x);
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
    bool narrow = false;      // cells of level 1 are one column wide instead of two
    bool copied = false;      // that grid is not level 0 itself
    int ground_rows = 1;      // rows that level 0 looks at
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

    p.ground_rows = near_rows(steps, p.resampled());
    const auto halo = [&](int texels) {
        const std::int64_t most = period(texels, edge);
        return int(p.count == 1 ? most : (std::min)(std::int64_t(p.ground_rows) + 1, most)) + border;
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
        l.stride = j == 1 ? l.width : 1;  // level 1 looks at the base grid itself
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

}  // namespace bumpshadow::cascade_detail
