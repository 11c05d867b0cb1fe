#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/status.hpp>

// The slices of an encoding, and how they are fitted to horizons in more directions.

namespace bumpshadow {

// Bearings that are stored, in turns, as `function` measures them. Between two slices the stored quantity is
// interpolated linearly.
//   arc 1        the whole turn: slice i at phase + i / count, and after the last one comes the first
//   arc below 1  for lights that do not come from everywhere: slice i at phase + arc * i / (count - 1), so that the
//                first and last are the ends of the arc. Light from beyond gets the horizon of the nearer end. Half a
//                turn takes 5 slices for the spacing of 8 around it
//   one slice    for all bearings of the arc alike; with arc 0 for a light whose bearing is fixed
// Fits do not look at horizons in directions beyond the arc.
struct slice_set {
    int count = 8;                                        // slices, 1 to most_slices
    double phase = 0.0;                                   // bearing of the first one, up to largest_phase turns
    bearing_function function = bearing_function::cubic;  // that the shader looks them up by
    double arc = 1.0;                                     // in turns, smallest_arc to 1; of one slice 0 to 1
};

// Slices of an encoding, at the most.
inline constexpr int most_slices = 4096;
// Turns. Bearings are floats in shaders.
inline constexpr double smallest_arc = 1e-6;

// Turns, either way. Shaders subtract it in floats, which are off by up to 2e-6 there.
inline constexpr double largest_phase = 16.0;

// How the slices that are stored come of the horizons that were baked.
enum class slice_fit : unsigned char {
    point,          // the horizon in the slice's own direction, which has to be among those baked
    least_squares,  // what interpolates closest to all horizons baked; 32 directions or more are worth having
    // The least mean error of the elevation, found by reweighting the least squares once: 4 % fewer wrong answers of 8
    // to 32 slices of slopes, for about twice the time. halve_slices fits by least squares instead.
    least_angle,
};

// Checks count, phase and arc.
[[nodiscard]] inline status check(const slice_set& slices) {
    if (slices.count <= 0) return {error::not_positive, "slices", double(slices.count)};
    if (slices.count > most_slices) return {error::out_of_range, "slices", double(slices.count), double(most_slices)};
    if (!is_finite(slices.phase)) return {error::not_finite, "phase", slices.phase};
    if (std::abs(slices.phase) > largest_phase) return {error::out_of_range, "phase", slices.phase, largest_phase};
    if (!is_finite(slices.arc)) return {error::not_finite, "arc", slices.arc};
    if (slices.arc < 0.0 || (slices.arc == 0.0 && slices.count > 1)) return {error::not_positive, "arc", slices.arc};
    if (slices.arc > 1.0) return {error::out_of_range, "arc", slices.arc, 1.0};
    if (slices.arc < smallest_arc && slices.count > 1) return {error::out_of_range, "arc", slices.arc, smallest_arc};
    return {};
}

// True where the slices stand over a part of the turn.
[[nodiscard]] constexpr bool is_arc(const slice_set& slices) { return slices.arc < 1.0; }

// Bearing of slice i in turns: not brought into [0, 1).
[[nodiscard]] constexpr double bearing_of(const slice_set& slices, int i) {
    if (!is_arc(slices)) return slices.phase + double(i) / slices.count;
    return slices.count > 1 ? slices.phase + slices.arc * i / (slices.count - 1) : slices.phase;
}

// Directions of the slices, one each.
inline void fill_directions(std::span<glm::dvec2> out, const slice_set& slices) {
    if (!is_arc(slices)) return fill_directions(out, slices.phase, slices.function);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = to_direction(slices.function, bearing_of(slices, int(i)));
}

namespace slice_detail {

inline constexpr int chunk = 512;      // texels of a row that are worked on at a time: they stay in the first cache
inline constexpr int fit_chunk = 128;  // the same while fitting, which takes rows of all directions
inline constexpr std::size_t work_step = fit_chunk + 16;  // floats from row to row: no power of 2, for the cache's sake
inline constexpr std::size_t work_rows = 4;               // that are added at a time

[[nodiscard]] constexpr std::size_t padded(int texels) { return (std::size_t(texels) + 15) / 16 * 16; }

// A direction adds to two neighboring slices.
struct contribution {
    int source;  // bearing of the horizon map
    int slice, next;
    float weight, next_weight;
};

// Column i of the factors L D L^T of the normal matrix. It is cyclic tridiagonal: below the diagonal L has one entry
// next to it and one in the last row.
struct column {
    float below, last, inverse;
};

struct plan {
    slice_set slices;
    bool fitted = false;
    std::span<contribution> contributions;  // by slice
    std::span<column> columns;
    bool reweighted = false;
    // Of a reweighted one: what the stored values are, and how much of it 1 stands for.
    quantity stored = quantity::slope;
    float unit = 1.0f;
};

// From the first slice to a bearing: [0, 1), or over an arc [-g, arc + g), 2 g being what the arc leaves of a turn.
[[nodiscard]] inline double turns_from_first(const slice_set& slices, double bearing) {
    const double beyond = 0.5 * (1.0 - slices.arc), turns = bearing - slices.phase + beyond;
    return turns - std::floor(turns) - beyond;
}

// Whether a bearing lies in the arc, but for rounding.
[[nodiscard]] inline bool is_within(const slice_set& slices, double bearing) {
    constexpr double rounding = 1e-6;  // of floats, and as much as the point fit allows
    if (!is_arc(slices)) return true;
    const double turns = turns_from_first(slices, bearing);
    return turns >= -rounding && turns <= slices.arc + rounding;
}

// Where a bearing lies among the slices; what is a slice but for rounding is that slice.
[[nodiscard]] inline contribution locate(const slice_set& slices, double bearing) {
    if (slices.count == 1) return {0, 0, 0, 1.0f, 0.0f};
    const double turns = turns_from_first(slices, bearing), last = slices.count - 1;
    // The next slice of the last one is the first here, too, where it has no part: the sums of both kinds are cyclic.
    double position = is_arc(slices) ? (std::clamp)(turns * (last / slices.arc), 0.0, last) : turns * slices.count;
    if (std::abs(position - std::round(position)) < 1e-9) position = std::round(position);
    const double below = std::floor(position);
    const int slice = int(below) % slices.count;
    const double part = position - below;
    return {0, slice, (slice + 1) % slices.count, float(1.0 - part), float(part)};
}

// Normal equations of the fit, factored; work: 3 * count doubles.
[[nodiscard]] inline status factor(plan& p, double* work) {
    const int n = p.slices.count;
    double* const diagonal = work;
    double* const beside = work + n;  // between i and i + 1
    double* const last = work + 2 * n;
    std::fill(work, work + 3 * n, 0.0);
    for (const contribution& c : p.contributions) {
        const double w = double(c.weight), v = double(c.next_weight);
        diagonal[c.slice] += w * w;
        diagonal[c.next] += v * v;
        beside[c.slice] += w * v;
    }
    if (n > 1) last[0] = beside[n - 1];
    if (n > 1) last[n - 2] += beside[n - 2];
    for (int i = 0; i < n; ++i) {
        // Without directions near it, or with all of them half way, a slice is not determined.
        const double least = 1e-6 * double(p.contributions.size()) / n;
        if (!(diagonal[i] > least)) return {error::out_of_range, "directions (too few near a slice), slice", double(i)};
        column& c = p.columns[std::size_t(i)];
        c = {0.0f, 0.0f, float(1.0 / diagonal[i])};
        if (i + 1 < n) {
            c.last = float(last[i] / diagonal[i]);
            diagonal[n - 1] -= last[i] * last[i] / diagonal[i];
        }
        if (i + 2 < n) {
            c.below = float(beside[i] / diagonal[i]);
            diagonal[i + 1] -= beside[i] * beside[i] / diagonal[i];
            last[i + 1] -= last[i] * beside[i] / diagonal[i];
        }
    }
    return {};
}

// Plans a fit to sources at these bearings: bearing(i) in turns, as the slices' function measures it. The plan's arrays
// are there already: as many contributions as sources, as many columns as slices.
template <class Bearing>
[[nodiscard]] status plan_fit(plan& p, std::size_t sources, const Bearing& bearing, double* work) {
    p.fitted = true;
    std::size_t within = 0;
    for (std::size_t j = 0; j < sources; ++j) {
        const double at = bearing(j);
        if (!is_within(p.slices, at)) continue;
        p.contributions[within] = locate(p.slices, at);
        p.contributions[within++].source = int(j);
    }
    p.contributions = p.contributions.first(within);
    std::sort(p.contributions.begin(), p.contributions.end(), [](const contribution& a, const contribution& b) {
        return a.slice != b.slice ? a.slice < b.slice : a.source < b.source;
    });
    return factor(p, work);
}

// Plans to take the sources that stand in the slices' own directions.
[[nodiscard]] inline status plan_point(plan& p, std::span<const glm::dvec2> directions, std::span<glm::dvec2> own) {
    p.fitted = false;
    fill_directions(own, p.slices);
    p.contributions = p.contributions.first(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        std::size_t j = 0;
        for (; j < directions.size(); ++j) {
            const glm::dvec2 d = unit_direction(directions[j]);
            if (std::hypot(d.x - own[i].x, d.y - own[i].y) <= 1e-6) break;
        }
        if (j == directions.size())
            return {error::mismatch, "directions (a slice's own is missing), slices found", double(i),
                    double(own.size())};
        p.contributions[i] = {int(j), int(i), int(i), 1.0f, 0.0f};
    }
    return {};
}

// slice += weight * row and next += next_weight * row for `rows` of them, which lie work_step apart.
inline void add_rows(const contribution* c, int rows, const float* row, float* slice, float* next, std::size_t count) {
    using namespace simd;
    for (std::size_t x = 0; x < count; x += std::size_t(width)) {
        pack here = load(slice + x), there = load(next + x);
        for (int r = 0; r < rows; ++r) {
            const pack value = load(row + std::size_t(r) * work_step + x);
            here = multiply_add(splat(c[r].weight), value, here);
            there = multiply_add(splat(c[r].next_weight), value, there);
        }
        store(next + x, there);  // before the other: the next slice of a single one is itself
        store(slice + x, here);
    }
}

// to += weight * from
inline void add(float* to, const float* from, float weight, std::size_t count) {
    const simd::pack w = simd::splat(weight);
    for (std::size_t x = 0; x < count; x += std::size_t(simd::width))
        simd::store(to + x, simd::multiply_add(w, simd::load(from + x), simd::load(to + x)));
}

// x = L^-T D^-1 L^-1 x for `count` right-hand sides side by side, clamped to [0, 1].
inline void solve(std::span<const column> columns, float* values, std::size_t step, std::size_t count) {
    using namespace simd;
    const std::size_t n = columns.size();
    float* const end = values + (n - 1) * step;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const float* const here = values + i * step;
        add(end, here, -columns[i].last, count);
        if (i + 2 < n) add(values + (i + 1) * step, here, -columns[i].below, count);
    }
    const pack zero = splat(0.0f), one = splat(1.0f);
    const auto bounded = [&](pack v) {
        const pack above = select_greater(v, zero, v, zero);
        return select_greater(above, one, one, above);
    };
    // The clamped value of a slice is final, but those before it need what it was: hence the order of the two loops.
    for (std::size_t i = n; i-- > 0;) {
        float* const here = values + i * step;
        const pack inverse = splat(columns[i].inverse), last = splat(-columns[i].last),
                   below = splat(-columns[i].below);
        for (std::size_t x = 0; x < count; x += std::size_t(width)) {
            pack v = multiply(inverse, load(here + x));
            if (i + 1 < n) v = multiply_add(last, load(end + x), v);
            if (i + 2 < n) v = multiply_add(below, load(here + step + x), v);
            store(here + x, v);
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t x = 0; x < count; x += std::size_t(width))
            store(values + i * step + x, bounded(load(values + i * step + x)));
}

}  // namespace slice_detail

}  // namespace bumpshadow
