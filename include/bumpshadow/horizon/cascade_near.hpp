#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/simd.hpp>

// Level 0 of the cascade: where texels look at the map itself, and the loop that looks. Part of horizon/cascade.hpp.
namespace bumpshadow::cascade_detail {

inline constexpr int packs = 4;                    // a chunk of a row, worked on together in registers
inline constexpr int chunk = packs * simd::width;  // texels or cells

// A ray in one frame: the map, or its transpose, whichever makes it cross more rows than columns.
struct ray {
    glm::dvec2 step{0.0, 1.0};  // texels a unit of length
    double bend = 0.0;          // half the curvature of the base: it falls by bend * t^2
    double farthest = 0.0;      // radius, or where looking on is of no use

    [[nodiscard]] double tangent() const { return step.x / step.y; }  // columns a row
};

// One look at the surface, from any texel alike: at the corners of a cell, or two of them, weighted. The slope to it is
//   sum of weight * height there - own * own height + bend
// where the weights add up to `own`, which is 1 / distance unless the texel itself is one of the corners.
template <int Corners>
struct look {
    std::ptrdiff_t offset[Corners];
    float weight[Corners];
    float own;
    float bend;
    float inverse;  // 1 / distance
};

// Where a ray crosses a row, the surface lies between two neighbors on it.
struct crossing {
    std::ptrdiff_t offset;
    float weight[2];
    float inverse;
    float bend;
};

inline constexpr float inverse_of_zero = 1e30f;  // for the surface beside the texel, whose distance is 0

struct looks {
    crossing* corners = nullptr;  // crossings at texels: the second weight is 0
    crossing* crossings = nullptr;
    look<2>* columns = nullptr;  // crossings of columns, and the surface beside the texel
    look<4>* insides = nullptr;
    int corner_count = 0, crossing_count = 0, column_count = 0, inside_count = 0;
};

// The looks of a ray, at most `most` of each kind.
[[nodiscard]] constexpr int most_looks(int steps) { return (std::max)(steps, 4096) + 2; }

// The whole and the fractional part of a place between texels. Within rounding of a texel it is that texel, since a
// hole beside it would count otherwise.
struct place {
    std::int64_t cell;
    double part;
};
[[nodiscard]] inline place place_of(double at) {
    const double nearest = std::round(at);
    if (std::abs(at - nearest) < 1e-9) return {std::int64_t(nearest), 0.0};
    return {std::int64_t(std::floor(at)), at - std::floor(at)};
}

// An offset that may lie beyond the halo, brought back to where the same height is found.
[[nodiscard]] inline std::int64_t fold(std::int64_t offset, int texels, int halo, edge_mode edge) {
    if (std::abs(offset) + border <= halo + 1) return offset;
    const std::int64_t p = period(texels, edge);
    if (edge == edge_mode::repeat || edge == edge_mode::mirror) return resolve_edge(offset, p, edge_mode::repeat);
    return std::clamp(offset, -p, p);
}

// Chooses the looks of a ray up to the distance `to`.
//   lines_up_to: columns are looked at as well, where the ray crosses them, up to this distance
//   between_up_to: so is the surface half way between lines, since inside a cell it may be higher than on its edges
inline void choose_looks(const ray& r, const ground& g, edge_mode edge, double to, double lines_up_to,
                         double between_up_to, bool holes, int most, looks& out) {
    out.corner_count = out.crossing_count = out.column_count = out.inside_count = 0;
    if (r.step == glm::dvec2(0.0)) return;
    const double row_step = std::abs(r.step.y), column_step = std::abs(r.step.x);
    const std::int64_t down = r.step.y < 0.0 ? -1 : 1, across = r.step.x < 0.0 ? -1 : 1;
    const auto offset = [&](std::int64_t x, std::int64_t y) {
        return std::ptrdiff_t(fold(y, g.texels.y, g.halo.y, edge) * g.row_step + fold(x, g.texels.x, g.halo.x, edge));
    };
    const double last_row = (std::min)(std::floor(to * row_step + 1e-9), double(most));
    for (std::int64_t n = 1; double(n) <= last_row; ++n) {
        const double t = double(n) / row_step;
        const place at = place_of(t * r.step.x);
        crossing& c = at.part == 0.0 ? out.corners[out.corner_count++] : out.crossings[out.crossing_count++];
        c = {offset(at.cell, down * n),
             {float((1.0 - at.part) / t), float(at.part / t)},
             float(1.0 / t),
             float(-r.bend * t)};
    }
    // The surface beside the texel. The far corner of the cell has no part in its slope, but if it is a hole, so is the
    // cell.
    const float beside[2] = {float(column_step), float(row_step)}, almost_nothing = 1e-12f;
    out.columns[out.column_count++] = {
        {offset(across, 0), offset(0, down)}, {beside[0], beside[1]}, beside[0] + beside[1], 0.0f, inverse_of_zero};
    if (holes) {
        out.insides[out.inside_count++] = {{offset(across, 0), offset(0, down), offset(across, down), 0},
                                           {beside[0], beside[1], almost_nothing, 0.0f},
                                           beside[0] + beside[1],
                                           0.0f,
                                           inverse_of_zero};
        out.column_count = 0;
    }
    const bool has_columns = column_step > 1e-6 * row_step && column_step < (1.0 - 1e-9) * row_step;
    for (std::int64_t n = 1; has_columns && out.column_count < most; ++n) {
        const double t = double(n) / column_step;
        if (t > (std::min)(lines_up_to, to)) break;
        const place at = place_of(t * r.step.y);
        out.columns[out.column_count++] = {{offset(across * n, at.cell), offset(across * n, at.cell + 1)},
                                           {float((1.0 - at.part) / t), float(at.part / t)},
                                           float(1.0 / t),
                                           float(-r.bend * t),
                                           float(1.0 / t)};
    }
    const auto look_inside = [&](double t) {
        const place x = place_of(t * r.step.x), y = place_of(t * r.step.y);
        look<4>& l = out.insides[out.inside_count++];
        for (int i = 0; i < 4; ++i) {
            l.offset[i] = offset(x.cell + (i & 1), y.cell + (i >> 1));
            l.weight[i] = float(((i & 1) != 0 ? x.part : 1.0 - x.part) * ((i >> 1) != 0 ? y.part : 1.0 - y.part) / t);
        }
        l.own = l.inverse = float(1.0 / t);
        l.bend = float(-r.bend * t);
    };
    // In the texel's own cell, with what cancels left out, so that a radius may be as small as it likes.
    const auto look_close = [&](double t) {
        const double both = column_step * row_step * t;
        out.insides[out.inside_count++] = {{offset(across, 0), offset(0, down), offset(across, down), 0},
                                           {float(column_step - both), float(row_step - both), float(both), 0.0f},
                                           float(column_step + row_step - both),
                                           float(-r.bend * t),
                                           float(1.0 / t)};
    };
    double here = 0.0;
    for (double row = 1.0, column = 1.0; out.inside_count < most - 1;) {
        const double to_row = row / row_step, to_column = has_columns ? column / column_step : to_row;
        const double next = (std::min)(to_row, to_column);
        if (next > (std::min)(between_up_to, to)) break;
        // In the first cell the slope is linear, and where lines are close together there is little between them.
        if (here > 0.0 && (next - here) * row_step > 0.25) look_inside(0.5 * (here + next));
        if (to_row <= next) row += 1.0;
        if (to_column <= next && has_columns) column += 1.0;
        here = next;
    }
    if (r.farthest > to) return;
    if (r.farthest * (std::max)(row_step, column_step) < 1.0)
        look_close(r.farthest);
    else
        look_inside(r.farthest);
}

// The highest slope that each of Packs packs of texels sees and, with Track, the inverse distance of what makes it.
//   heights: the first texel's place in level 0
//   floor: slope where nothing is seen, with inverse distance 0
template <int Packs, bool Track>
inline void look_around(const looks& l, const float* heights, float floor, float* slopes, float* inverses) {
    using simd::pack;
    pack depth[Packs], best[Packs], best_inverse[Packs];
    for (int u = 0; u < Packs; ++u) {
        depth[u] = simd::subtract(simd::splat(0.0f), simd::load(heights + u * simd::width));
        best[u] = simd::splat(floor);
        best_inverse[u] = simd::splat(0.0f);
    }
    const auto take = [&](int u, pack slope, float inverse) {
        if constexpr (Track)
            best_inverse[u] = simd::select_greater(slope, best[u], simd::splat(inverse), best_inverse[u]);
        best[u] = simd::larger(slope, best[u]);
    };
    for (const crossing* c = l.corners; c != l.corners + l.corner_count; ++c) {
        const float* from = heights + c->offset;
        for (int u = 0; u < Packs; ++u) {
            const pack below = simd::multiply_add(depth[u], simd::splat(c->inverse), simd::splat(c->bend));
            take(u, simd::multiply_add(simd::load(from + u * simd::width), simd::splat(c->weight[0]), below),
                 c->inverse);
        }
    }
    for (const crossing* c = l.crossings; c != l.crossings + l.crossing_count; ++c) {
        const float* from = heights + c->offset;
        pack here = simd::load(from);
        for (int u = 0; u < Packs; ++u, from += simd::width) {
            const pack after = simd::load(from + simd::width), next = simd::next(here, after);
            pack slope = simd::multiply_add(depth[u], simd::splat(c->inverse), simd::splat(c->bend));
            slope = simd::multiply_add(here, simd::splat(c->weight[0]), slope);
            slope = simd::multiply_add(next, simd::splat(c->weight[1]), slope);
            take(u, slope, c->inverse);
            here = after;
        }
    }
    const auto look_at = [&](const auto& c) {
        for (int u = 0; u < Packs; ++u) {
            pack slope = simd::multiply_add(depth[u], simd::splat(c.own), simd::splat(c.bend));
            for (std::size_t i = 0; i < std::size(c.offset); ++i)
                slope = simd::multiply_add(simd::load(heights + c.offset[i] + u * simd::width),
                                           simd::splat(c.weight[i]), slope);
            take(u, slope, c.inverse);
        }
    };
    for (int i = 0; i < l.column_count; ++i) look_at(l.columns[i]);
    for (int i = 0; i < l.inside_count; ++i) look_at(l.insides[i]);
    for (int u = 0; u < Packs; ++u) {
        simd::store(slopes + u * simd::width, best[u]);
        if constexpr (Track) simd::store(inverses + u * simd::width, best_inverse[u]);
    }
}

}  // namespace bumpshadow::cascade_detail
