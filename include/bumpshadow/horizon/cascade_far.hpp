#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <bumpshadow/glm.hpp>
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
    double columns = 0.0;  // how many are
    int first_row = 0, rows = 0;
    int count = 0;  // lanes, a multiple of the pack width

    // Columns that the lanes of a row stand beside those of the same number.
    [[nodiscard]] double shift(std::int64_t row) const { return tangent * (double(row) - middle); }
    [[nodiscard]] std::int64_t first_wanted(std::int64_t row) const {
        // Fused, so that it is the same number wherever a compiler inlines this.
        return std::int64_t(std::floor(std::fma(-tangent, double(row) - middle, left)));
    }
    [[nodiscard]] std::int64_t first_lane(std::int64_t row) const {
        const std::int64_t lane = first_wanted(row);
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
        return std::ptrdiff_t((row - at.first_row) * at.count + (lane - at.first_lane(row)));
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
    double spacing = 1.0;   // how far a ray goes from a row of the parent's to the next, less than 0 if upwards
    double nearest = 1.0;   // distance from which on the parent looked
    double bend = 0.0;      // of the ray
    float* line = nullptr;  // scratch: twice line_floats, each as many as a row of the parent has, and two chunks
    std::size_t line_floats = 0;

    [[nodiscard]] double place_of_row(std::int64_t row) const { return (double(row) - row_start) * row_scale; }

    // Calls visit(i, a, b) for each pack of lanes from lane + i on.
    template <bool Holes, class Visit>
    void operator()(std::int64_t lane, std::int64_t row, int count, Visit&& visit) const {
        const double y = place_of_row(row), above = std::floor(y);
        // Rounding must not depend on which lane is the first.
        const double shift = lanes.shift(row), part = shift - std::floor(shift);
        const int half = part < 0.5 ? 0 : 1;
        const bool twice = !Holes && lanes.scale == 0.5, once = !Holes && lanes.scale == 1.0;
        const std::int64_t left = once    ? std::int64_t(std::floor(shift)) + lane
                                  : twice ? std::int64_t(std::floor(shift)) + (lane >> 1) + ((lane & 1) != 0 ? half : 0)
                                          : place_under(lane, shift).cell;
        const std::ptrdiff_t upper = parent->offset(left, std::int64_t(above));
        const std::ptrdiff_t lower = parent->offset(left, std::int64_t(above) + 1);
        const rows_between rows(*this, y - above);
        if constexpr (Holes) {
            with_holes(std::ptrdiff_t(upper - left), std::ptrdiff_t(lower - left), rows, lane, shift, count, visit);
            return;
        }
        const auto blend_rows = [&](int i) { return rows.blend(*parent, upper + i, lower + i); };
        const float even_part = float(part), odd_part = float(part + 0.5 - half);
        if (once)
            move(blend_rows, float(part), count, visit);
        else if (!twice)
            stretch(blend_rows, left, lane, shift, count, visit);
        else if ((lane & 1) == 0)
            (half == 0 ? double_up<0>(blend_rows, even_part, odd_part, count, visit)
                       : double_up<1>(blend_rows, even_part, odd_part, count, visit));
        else
            (half == 0 ? double_up<1>(blend_rows, odd_part, even_part, count, visit)
                       : double_up<0>(blend_rows, odd_part, even_part, count, visit));
    }

    struct pair {
        simd::pack a, b;
    };

    // A row between two of the parent's, and what their occluders are there: at t - u if they are at t, so that a pair
    // is to be multiplied by t / (t - u), or nearly 1 + x + x^2 + x^3 where x = u b. The part of a that comes from the
    // bend is another, by bend * u as much on top of that.
    struct rows_between {
        float weight[2], ahead[2], bent[2], rest = 0.0f;  // of the row above and the row below

        rows_between(const interpolation& i, double below) {
            for (int k = 0; k < 2; ++k) {
                const double way = k == 0 ? below : below - 1.0, most = 0.5 * i.nearest;
                const double u = std::clamp(way * i.spacing, -most, most), w = k == 0 ? 1.0 - below : below;
                weight[k] = float(w);
                ahead[k] = float(u);
                bent[k] = float(u * i.bend);
                rest += weight[k] * bent[k];
            }
        }
        [[nodiscard]] static simd::pack factor(simd::pack x) {
            const simd::pack one = simd::splat(1.0f);
            return simd::multiply_add(x, simd::multiply_add(x, simd::multiply_add(x, one, one), one), one);
        }
        [[nodiscard]] pair blend(const pairs& from, std::ptrdiff_t upper, std::ptrdiff_t lower) const {
            const simd::pack b0 = simd::load(from.b + upper), b1 = simd::load(from.b + lower);
            const simd::pack f0 =
                simd::multiply(factor(simd::multiply(b0, simd::splat(ahead[0]))), simd::splat(weight[0]));
            const simd::pack f1 =
                simd::multiply(factor(simd::multiply(b1, simd::splat(ahead[1]))), simd::splat(weight[1]));
            simd::pack a = simd::multiply_add(f0, simd::splat(bent[0]), simd::splat(rest));
            a = simd::multiply_add(f1, simd::splat(bent[1]), a);
            a = simd::multiply_add(simd::load(from.a + upper), f0, a);
            return {simd::multiply_add(simd::load(from.a + lower), f1, a),
                    simd::multiply_add(b1, f1, simd::multiply(b0, f0))};
        }
    };

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
    void double_up(const Blend& blend_rows, float first, float second, int count, const Visit& visit) const {
        const simd::pack even_part = simd::splat(first), odd_part = simd::splat(second);
        auto [a, b] = blend_rows(0);
        for (int i = 0; 2 * i < count; i += simd::width) {
            const auto [after_a, after_b] = blend_rows(i + simd::width);
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

    // A lane to each of the parent's, so far after it.
    template <class Blend, class Visit>
    void move(const Blend& blend_rows, float after, int count, const Visit& visit) const {
        const simd::pack part = simd::splat(after);
        auto [a, b] = blend_rows(0);
        for (int i = 0; i < count; i += simd::width) {
            const auto [after_a, after_b] = blend_rows(i + simd::width);
            visit(i, between(a, simd::next(a, after_a), part), between(b, simd::next(b, after_b), part));
            a = after_a;
            b = after_b;
        }
    }

    template <class Blend, class Visit>
    void stretch(const Blend& blend_rows, std::int64_t left, std::int64_t lane, double shift, int count,
                 const Visit& visit) const {
        const int wanted = int(lanes.scale * count) + 3;
        float *const line_a = line, *const line_b = line + line_floats;
        for (int i = 0; i < wanted; i += simd::width) {
            const auto [a, b] = blend_rows(i);
            simd::store(line_a + i, a);
            simd::store(line_b + i, b);
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
    void with_holes(std::ptrdiff_t upper, std::ptrdiff_t lower, const rows_between& rows, std::int64_t lane,
                    double shift, int count, const Visit& visit) const {
        for (int i = 0; i < count; i += simd::width) {
            float a[simd::width], b[simd::width];
            for (int k = 0; k < simd::width; ++k) {
                const place between_lanes = place_under(lane + i + k, shift);
                const std::int64_t cell = between_lanes.cell;
                const float right = float(between_lanes.part);
                float sum = 0.0f, sum_a = 0.0f, sum_b = 0.0f;
                for (int corner = 0; corner < 4; ++corner) {
                    const auto at = std::ptrdiff_t((corner < 2 ? upper : lower) + cell + (corner & 1));
                    const int r = corner / 2;
                    const float weight = ((corner & 1) != 0 ? right : 1.0f - right) * rows.weight[r];
                    if (parent->a[at] < hole_limit || weight == 0.0f) continue;
                    const float x = parent->b[at] * rows.ahead[r], factor = 1.0f + x * (1.0f + x * (1.0f + x));
                    sum += weight;
                    sum_a += weight * (parent->a[at] * factor + rows.bent[r] * (1.0f + factor));
                    sum_b += weight * parent->b[at] * factor;
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
[[nodiscard]] constexpr int group_of(std::int64_t row, std::int64_t rows_left) {
    const int size = row < alone_before ? 1 : row < in_pairs_before ? 2 : 4;
    return rows_left < size ? 1 : size;
}

// Rows of heights on the same lanes, one after the other.
struct sampled_rows {
    const float* values;
    const std::ptrdiff_t* lane_zero;  // of the n-th row at n * step
    int step;
    std::int64_t lane;

    [[nodiscard]] const float* row(int n) const { return values + (lane_zero[step * n] + lane); }
};

// Looks from Packs packs of cells at rows of heights on the same lanes. heights: the cells' own; first: n of the first
// row
template <int Packs>
inline void look_far_from(const sampled_rows& rows, const far_row* beyond, std::int64_t first, int count,
                          const float* heights, float* slopes, float* inverses) {
    using simd::pack;
    pack own[Packs], best[Packs], best_inverse[Packs];
    for (int u = 0; u < Packs; ++u) {
        own[u] = simd::load(heights + u * simd::width);
        best[u] = simd::splat(hole);
        best_inverse[u] = simd::splat(0.0f);
    }
    int n = 0;
    const auto slope = [&](int i, int u) {
        // The difference first, so that all of a plateau makes the same slope: the nearest is taken, fused or not.
        const pack rise = simd::subtract(simd::load(rows.row(i) + u * simd::width), own[u]);
        return simd::multiply_add(rise, simd::splat(beyond[i].inverse), simd::splat(beyond[i].bend));
    };
    const auto look_in_groups = [&]<int Size>(std::int64_t before) {
        for (; n + Size <= count && first + n < before; n += Size) {
            pack highest[Packs];
            for (int u = 0; u < Packs; ++u) highest[u] = slope(n, u);
            for (int i = 1; i < Size; ++i)
                for (int u = 0; u < Packs; ++u) highest[u] = simd::larger(slope(n + i, u), highest[u]);
            const pack inverse = simd::splat(0.5f * (beyond[n].inverse + beyond[n + Size - 1].inverse));
            for (int u = 0; u < Packs; ++u) {
                best_inverse[u] = simd::select_greater(highest[u], best[u], inverse, best_inverse[u]);
                best[u] = simd::larger(highest[u], best[u]);
            }
        }
    };
    constexpr std::int64_t for_ever = (std::numeric_limits<std::int64_t>::max)();
    look_in_groups.template operator()<1>(alone_before);
    look_in_groups.template operator()<2>(in_pairs_before);
    look_in_groups.template operator()<4>(for_ever);
    look_in_groups.template operator()<1>(for_ever);
    for (int u = 0; u < Packs; ++u) {
        simd::store(slopes + u * simd::width, best[u]);
        simd::store(inverses + u * simd::width, best_inverse[u]);
    }
}

// The same from a chunk or less.
inline void look_far(const sampled_rows& rows, const far_row* beyond, std::int64_t first, int count, int packs_there,
                     const float* heights, float* slopes, float* inverses) {
    switch (packs_there) {
        case 4: return look_far_from<4>(rows, beyond, first, count, heights, slopes, inverses);
        case 3: return look_far_from<3>(rows, beyond, first, count, heights, slopes, inverses);
        case 2: return look_far_from<2>(rows, beyond, first, count, heights, slopes, inverses);
        default: return look_far_from<1>(rows, beyond, first, count, heights, slopes, inverses);
    }
}

}  // namespace bumpshadow::cascade_detail
