#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/cascade_near.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// The levels above 0 of the cascade. Part of horizon/cascade.hpp.
//
// Their cells stand on a lattice that is sheared along the ray: lane i of row Y stands at column i + tangent * (Y -
// middle), where middle is that of the map, so that a mirrored map has a mirrored lattice. All rays of one lane are
// then one line, so that each row of heights is interpolated onto the lanes once, and looking at it costs one aligned
// load.
namespace bumpshadow::cascade_detail {

inline constexpr int most_rows = 4096;  // that a level looks at

// Rows of a lattice, each of `count` lanes from a multiple of the pack width on.
struct lattice {
    double tangent = 0.0;  // columns a row
    double middle = 0.0;   // the row where lane i is column i
    double left = 0.0;     // first column that is wanted of every row
    int first_row = 0, rows = 0;
    int count = 0;  // lanes, a multiple of the pack width

    [[nodiscard]] std::int64_t first_lane(std::int64_t row) const {
        // Fused, so that it is the same number wherever a compiler inlines this.
        const auto lane = std::int64_t(std::floor(std::fma(-tangent, double(row) - middle, left)));
        return lane - ((lane % simd::width) + simd::width) % simd::width;
    }
};

// Lanes that hold `columns` columns from the first one on, whatever the row.
[[nodiscard]] constexpr int lanes_for(double columns) {
    return (int(columns) + 2 + 2 * simd::width - 1) / simd::width * simd::width;
}

// What cells see, as pairs: a occluder of height H at distance t is (a, b) = (H / t, 1 / t), and its slope for a height
// h is a - b h.
struct pairs {
    float* a = nullptr;
    float* b = nullptr;
    lattice at;

    [[nodiscard]] std::ptrdiff_t offset(std::int64_t lane, std::int64_t row) const {
        return (row - at.first_row) * at.count + (lane - at.first_lane(row));
    }
};

// Heights of a row of a plane at `count` lanes (a multiple of the pack width), Stride cells apart, the first at x +
// shift. Writes up to a pack more. Only the shift is rounded, so that a lane is the same whichever is the first.
template <int Stride>
inline void sample_row(const plane& p, edge_mode edge, std::int64_t y, std::int64_t x, double shift, int count,
                       float* to) {
    const std::int64_t row = resolve_edge(y, p.cells.y, edge);
    if (row < 0) {
        std::fill_n(to, count, hole);
        return;
    }
    const float* const cells = p.row(row);
    const std::int64_t width = p.cells.x;
    const place at = place_of(shift);
    const simd::pack part = simd::splat(float(at.part));
    const auto blend = [&](const float* from, int i) {
        simd::pack left, right;
        if constexpr (Stride == 1) {
            left = simd::load(from);
            right = simd::load(from + 1);
        } else {
            const simd::pack low = simd::load(from), high = simd::load(from + simd::width);
            left = simd::even(low, high);
            right = simd::odd(low, high);
        }
        simd::store(to + i, simd::multiply_add(simd::subtract(right, left), part, left));
    };
    for (int i = 0; i < count;) {
        const std::int64_t cell = x + at.cell + Stride * std::int64_t(i);
        const std::int64_t begin = edge == edge_mode::repeat ? resolve_edge(cell, width, edge) : cell;
        if (begin >= 0 && begin < width) {
            // What a pack reads and writes beyond the row's last cell is done again.
            const int run = int((std::min)((width - 1 - begin) / Stride + 1, std::int64_t(count - i)));
            for (int k = 0; k < run; k += simd::width) blend(cells + begin + Stride * k, i + k);
            i += run;
        } else {
            float around[overhang];
            for (int k = 0; k <= Stride * simd::width; ++k) {
                const std::int64_t from = resolve_column(cell + k, width, edge);
                around[k] = from < 0 ? hole : cells[from];
            }
            blend(around, i);
            i += simd::width;
        }
    }
}

// How a lattice's lanes lie between the parent's: lane i of row Y at scale * i + shift(Y).
struct parent_lanes {
    double scale = 0.5;
    double constant = 0.0;
    double per_row = 0.0;

    [[nodiscard]] double shift(std::int64_t row) const { return constant + per_row * double(row); }
};

// Brings the parent's pairs to `count` lanes of a row.
//   rows: row Y lies at (Y - start) / ratio between the parent's rows
struct interpolation {
    const pairs* parent = nullptr;
    parent_lanes lanes;
    double row_scale = 0.5, row_start = 0.5;
    float* line = nullptr;  // scratch: twice line_floats, each as many as a row of the parent has, and two chunks
    std::size_t line_floats = 0;

    // Calls visit(i, a, b) for each pack of lanes from lane + i on.
    template <bool Holes, class Visit>
    void operator()(std::int64_t lane, std::int64_t row, int count, Visit&& visit) const {
        const double y = (double(row) - row_start) * row_scale, above = std::floor(y);
        // Rounding must not depend on which lane is the first.
        const double shift = lanes.shift(row), part = shift - std::floor(shift);
        const int half = part < 0.5 ? 0 : 1;
        const bool twice = !Holes && lanes.scale == 0.5;
        const std::int64_t left = twice ? std::int64_t(std::floor(shift)) + (lane >> 1) + ((lane & 1) != 0 ? half : 0)
                                        : place_under(lane, shift).cell;
        const std::ptrdiff_t upper = parent->offset(left, std::int64_t(above));
        const std::ptrdiff_t lower = parent->offset(left, std::int64_t(above) + 1);
        const float below = float(y - above);
        if constexpr (Holes) {
            with_holes(upper - left, lower - left, below, lane, shift, count, visit);
            return;
        }
        const simd::pack v = simd::splat(below), w = simd::splat(1.0f - below);
        const auto blend_rows = [&](const float* from, int i) {
            return simd::multiply_add(simd::load(from + lower + i), v, simd::multiply(simd::load(from + upper + i), w));
        };
        const float even_part = float(part), odd_part = float(part + 0.5 - half);
        if (!twice)
            stretch(blend_rows, left, lane, shift, count, visit);
        else if ((lane & 1) == 0)
            (half == 0 ? double_up<0>(blend_rows, even_part, odd_part, count, visit)
                       : double_up<1>(blend_rows, even_part, odd_part, count, visit));
        else
            (half == 0 ? double_up<1>(blend_rows, odd_part, even_part, count, visit)
                       : double_up<0>(blend_rows, odd_part, even_part, count, visit));
    }

private:
    // Where a lane lies between the parent's.
    [[nodiscard]] place place_under(std::int64_t lane, double shift) const {
        const double x = lanes.scale * double(lane) + shift;
        auto cell = std::int64_t(x);
        if (x < double(cell)) --cell;
        return {cell, x - double(cell)};
    }

    [[nodiscard]] static simd::pack between(simd::pack left, simd::pack right, simd::pack part) {
        return simd::multiply_add(simd::subtract(right, left), part, left);
    }

    // Two lanes to each of the parent's: lane 2 i lies `first` after parent i, and lane 2 i + 1 half a cell on, which
    // is `second` after parent i + Step.
    template <int Step, class Blend, class Visit>
    void double_up(const Blend& blend_rows, float first, float second, int count, Visit& visit) const {
        const simd::pack even_part = simd::splat(first), odd_part = simd::splat(second);
        simd::pack a = blend_rows(parent->a, 0), b = blend_rows(parent->b, 0);
        for (int i = 0; 2 * i < count; i += simd::width) {
            const simd::pack after_a = blend_rows(parent->a, i + simd::width),
                             after_b = blend_rows(parent->b, i + simd::width);
            const auto odd = [&](simd::pack here, simd::pack next, simd::pack after) {
                return Step == 0 ? between(here, next, odd_part) : between(next, simd::next<2>(here, after), odd_part);
            };
            const simd::pack next_a = simd::next(a, after_a), next_b = simd::next(b, after_b);
            const simd::pack even_a = between(a, next_a, even_part), odd_a = odd(a, next_a, after_a);
            const simd::pack even_b = between(b, next_b, even_part), odd_b = odd(b, next_b, after_b);
            visit(2 * i, simd::zip_low(even_a, odd_a), simd::zip_low(even_b, odd_b));
            if (2 * i + simd::width < count)
                visit(2 * i + simd::width, simd::zip_high(even_a, odd_a), simd::zip_high(even_b, odd_b));
            a = after_a;
            b = after_b;
        }
    }

    template <class Blend, class Visit>
    void stretch(const Blend& blend_rows, std::int64_t left, std::int64_t lane, double shift, int count,
                 Visit& visit) const {
        const int wanted = int(lanes.scale * count) + 3;
        float *const line_a = line, *const line_b = line + line_floats;
        for (int i = 0; i < wanted; i += simd::width) {
            simd::store(line_a + i, blend_rows(parent->a, i));
            simd::store(line_b + i, blend_rows(parent->b, i));
        }
        for (int i = 0; i < count; i += simd::width) {
            float left_a[simd::width], right_a[simd::width], left_b[simd::width], right_b[simd::width],
                parts[simd::width];
            for (int k = 0; k < simd::width; ++k) {
                const place at = place_under(lane + i + k, shift);
                const std::int64_t cell = at.cell - left;
                left_a[k] = line_a[cell], right_a[k] = line_a[cell + 1];
                left_b[k] = line_b[cell], right_b[k] = line_b[cell + 1];
                parts[k] = float(at.part);
            }
            const simd::pack p = simd::load(parts);
            visit(i, between(simd::load(left_a), simd::load(right_a), p),
                  between(simd::load(left_b), simd::load(right_b), p));
        }
    }

    // Parents that saw nothing do not take part, and where none is left nothing is seen.
    //   upper, lower: where the parent's lane 0 lies, or would
    template <class Visit>
    void with_holes(std::ptrdiff_t upper, std::ptrdiff_t lower, float below, std::int64_t lane, double shift, int count,
                    Visit& visit) const {
        for (int i = 0; i < count; i += simd::width) {
            float a[simd::width], b[simd::width];
            for (int k = 0; k < simd::width; ++k) {
                const place between_lanes = place_under(lane + i + k, shift);
                const std::int64_t cell = between_lanes.cell;
                const float right = float(between_lanes.part);
                float sum = 0.0f, sum_a = 0.0f, sum_b = 0.0f;
                for (int corner = 0; corner < 4; ++corner) {
                    const std::ptrdiff_t at = (corner < 2 ? upper : lower) + cell + (corner & 1);
                    const float weight =
                        ((corner & 1) != 0 ? right : 1.0f - right) * (corner < 2 ? 1.0f - below : below);
                    if (parent->a[at] < hole_limit || weight == 0.0f) continue;
                    sum += weight;
                    sum_a += weight * parent->a[at];
                    sum_b += weight * parent->b[at];
                }
                a[k] = sum > 0.0f ? sum_a / sum : hole;
                b[k] = sum > 0.0f ? sum_b / sum : 0.0f;
            }
            visit(i, simd::load(a), simd::load(b));
        }
    }
};

// The slope of an occluder (a, b) for a height.
[[nodiscard]] inline simd::pack slope_of(simd::pack a, simd::pack b, simd::pack height) {
    return simd::multiply_add(b, simd::subtract(simd::splat(0.0f), height), a);
}

// Rows that a level looks at: the n-th is n rows on, at a distance of 1 / inverse.
struct far_row {
    float inverse;
    float bend;
};

// The n-th row is so far away that `group_of` rows may share a distance, since that is only used to bring their slope
// from a cell's height to those of its texels.
inline constexpr int alone_before = 16, in_pairs_before = 32;

// Looks from Packs packs of cells at rows of heights on the same lanes. heights: the cells' own; first: n of the first
// row
template <int Packs>
inline void look_far_from(const float* const* rows, const far_row* far, std::int64_t first, int count,
                          std::ptrdiff_t lane, const float* heights, float* slopes, float* inverses) {
    using simd::pack;
    pack depth[Packs], best[Packs], best_inverse[Packs];
    for (int u = 0; u < Packs; ++u) {
        depth[u] = simd::subtract(simd::splat(0.0f), simd::load(heights + u * simd::width));
        best[u] = simd::splat(hole);
        best_inverse[u] = simd::splat(0.0f);
    }
    int n = 0;
    const auto slope = [&](int i, int u) {
        const pack inverse = simd::splat(far[i].inverse);
        const pack below = simd::multiply_add(depth[u], inverse, simd::splat(far[i].bend));
        return simd::multiply_add(simd::load(rows[i] + lane + u * simd::width), inverse, below);
    };
    const auto look_in_groups = [&]<int Size>(std::int64_t before) {
        for (; n + Size <= count && first + n < before; n += Size) {
            pack highest[Packs];
            for (int u = 0; u < Packs; ++u) highest[u] = slope(n, u);
            for (int i = 1; i < Size; ++i)
                for (int u = 0; u < Packs; ++u) highest[u] = simd::max(slope(n + i, u), highest[u]);
            const pack inverse = simd::splat(0.5f * (far[n].inverse + far[n + Size - 1].inverse));
            for (int u = 0; u < Packs; ++u) {
                best_inverse[u] = simd::select_greater(highest[u], best[u], inverse, best_inverse[u]);
                best[u] = simd::max(highest[u], best[u]);
            }
        }
    };
    constexpr std::int64_t for_ever = std::numeric_limits<std::int64_t>::max();
    look_in_groups.template operator()<1>(alone_before);
    look_in_groups.template operator()<2>(in_pairs_before);
    look_in_groups.template operator()<4>(for_ever);
    look_in_groups.template operator()<1>(for_ever);
    for (int u = 0; u < Packs; ++u) {
        simd::store(slopes + u * simd::width, best[u]);
        simd::store(inverses + u * simd::width, best_inverse[u]);
    }
}

// The same from `lanes` lanes, a multiple of the pack width.
inline void look_far(const float* const* rows, const far_row* far, std::int64_t first, int count, int lanes,
                     const float* heights, float* slopes, float* inverses) {
    int lane = 0;
    const auto look = [&]<int Packs>() {
        look_far_from<Packs>(rows, far, first, count, lane, heights + lane, slopes + lane, inverses + lane);
        lane += Packs * simd::width;
    };
    while (lane + chunk <= lanes) look.template operator()<packs>();
    switch ((lanes - lane) / simd::width) {
        case 3: return look.template operator()<3>();
        case 2: return look.template operator()<2>();
        case 1: return look.template operator()<1>();
        default: return;
    }
}

}  // namespace bumpshadow::cascade_detail
