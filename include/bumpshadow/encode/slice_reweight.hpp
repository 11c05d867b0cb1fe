#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slice_fit.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/sizes.hpp>

// From the least squares of stored values towards the least mean error of the elevation.
//
// Light is judged wrong over as many degrees as the horizon is off: what counts is the plain error of the elevation,
// where squares are ruled by a few large misses. So each direction gets the weight w = d^2 / (d |r| + 0.02), where r is
// its miss after the first fit and d the elevation that a stored value of 1 more would add, in radians, so that w r^2
// is d |r| but for misses of about a degree and less. One round has most of the gain, and two sweeps of Gauss-Seidel
// from the first fit solve it: neighbors hold each other weakly. Source: iteratively reweighted least squares
// (Schlossmacher, An Iterative Technique for Absolute Deviations Curve Fitting, 1973).

namespace bumpshadow::slice_detail {

inline constexpr float small_miss = 0.02f;  // radians

// Rows that a slice takes: its line of the normal equations, and what the steps have changed.
enum slice_row { diagonal, pull, change, beside, rows_of_slice };

// Floats of work for a chunk.
[[nodiscard]] constexpr std::size_t reweight_size(std::size_t directions, std::size_t slices) {
    return saturated_product(saturated_sum(directions, saturated_product(rows_of_slice, slices)), work_step);
}

// change(bits) of the numbers in a pack.
template <class Change>
[[nodiscard]] simd::pack change_bits(simd::pack x, const Change& change) {
#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_VECTOR_EXTENSIONS
    typedef std::uint32_t bits __attribute__((vector_size(sizeof(simd::pack))));
    return std::bit_cast<simd::pack>(change(std::bit_cast<bits>(x)));
#else
    float lanes[simd::width];
    simd::store(lanes, x);
    for (float& lane : lanes) lane = std::bit_cast<float>(change(std::bit_cast<std::uint32_t>(lane)));
    return simd::load(lanes);
#endif
}

// 1 / x within 6 % and the root of x within 4 %, of normal numbers above 0, by halving or negating the exponent.
// Weights need no more, and divisions would take most of the time.
[[nodiscard]] inline simd::pack rough_inverse(simd::pack x) {
    return change_bits(x, [](auto bits) { return 0x7ef311c7u - bits; });
}
[[nodiscard]] inline simd::pack rough_root(simd::pack x) {
    return change_bits(x, [](auto bits) { return (bits >> 1) + 0x1fbd1df6u; });
}

// 1 / d of a horizon, times what makes it 1 on the ground.
struct slope_steps {
    float unit;
    [[nodiscard]] simd::pack operator()(simd::pack h) const {
        const simd::pack slope = simd::multiply(simd::splat(unit), h);
        return simd::multiply_add(slope, slope, simd::splat(1.0f));
    }
};
struct sine_steps {
    float unit;
    [[nodiscard]] simd::pack operator()(simd::pack h) const {
        const simd::pack sine = simd::multiply(simd::splat(unit), h), one = simd::splat(1.0f);
        const simd::pack square = simd::subtract(one, simd::multiply(sine, sine));
        return rough_root(simd::larger(square, simd::splat(0.01f)));  // not 0 at 90 degrees
    }
};
struct angle_steps {
    [[nodiscard]] simd::pack operator()(simd::pack) const { return simd::splat(1.0f); }
};

// Adds the weighted normal equations of directions between slice `here` and the next to their sums.
//   miss: one so small that it counts as this on the ground
template <class Steps>
void add_weighted(std::span<const contribution> directions, const float* horizons, const float* here, const float* next,
                  float miss, Steps steps, float* here_sums, float* next_sums, std::size_t count) {
    using namespace simd;
    const pack zero = splat(0.0f), one = splat(1.0f), least = splat(miss);
    for (std::size_t x = 0; x < count; x += std::size_t(width)) {
        const pack here_value = load(here + x), next_value = load(next + x);
        pack own = zero, mixed = zero, other = zero, own_pull = zero, other_pull = zero;
        const float* row = horizons + x;
        for (const contribution& c : directions) {
            const pack a = splat(c.weight), b = splat(c.next_weight), h = load(row);
            const pack r = subtract(subtract(h, multiply(a, here_value)), multiply(b, next_value));
            const pack step = steps(h), size = change_bits(r, [](auto bits) { return bits & 0x7fffffffu; });
            const pack w = rough_inverse(multiply(step, multiply_add(least, step, size)));
            const pack wa = multiply(w, a), wb = multiply(w, b);
            own = multiply_add(wa, a, own);
            mixed = multiply_add(wa, b, mixed);
            other = multiply_add(wb, b, other);
            own_pull = multiply_add(wa, r, own_pull);
            other_pull = multiply_add(wb, r, other_pull);
            row += work_step;
        }
        const auto add_to = [&](float* sum, pack value) { store(sum + x, multiply_add(one, load(sum + x), value)); };
        add_to(here_sums + diagonal * work_step, own);
        store(here_sums + beside * work_step + x, mixed);
        add_to(here_sums + pull * work_step, own_pull);
        add_to(next_sums + diagonal * work_step, other);
        add_to(next_sums + pull * work_step, other_pull);
    }
}

// A step of Gauss-Seidel: the change of a slice that is best with those of its neighbors and keeps it in [0, 1].
//   final: the value becomes what it was plus the change
inline void relax(const float* before, const float* after, float* own, float* values, bool final, std::size_t count) {
    using namespace simd;
    const pack zero = splat(0.0f), one = splat(1.0f), two = splat(2.0f);
    for (std::size_t x = 0; x < count; x += std::size_t(width)) {
        const auto sum = [&](const float* rows, slice_row which) { return load(rows + which * work_step + x); };
        const pack left = subtract(subtract(sum(own, pull), multiply(sum(before, beside), sum(before, change))),
                                   multiply(sum(own, beside), sum(after, change)));
        const pack weight = sum(own, diagonal), rough = rough_inverse(weight);
        const pack inverse = multiply(rough, subtract(two, multiply(weight, rough)));  // within 0.3 %
        const pack was = load(values + x), best = multiply_add(left, inverse, was);
        const pack above = select_greater(best, zero, best, zero), value = select_greater(above, one, one, above);
        store(own + change * work_step + x, subtract(value, was));
        if (final) store(values + x, value);
    }
}

template <class Steps>
void reweight(const plan& p, const Steps& steps, const float* horizons, float* values, std::size_t slice_step,
              float* sums, std::size_t count) {
    const float miss = (std::min)(small_miss / p.unit, 1.0f);  // above 1 it would exceed all misses anyway
    const std::span<const contribution> all = p.contributions;
    const std::size_t n = std::size_t(p.slices.count), last = n - 1;
    const auto rows = [&](std::size_t i) { return sums + i * rows_of_slice * work_step; };
    const auto clear = [&](std::size_t i) { std::fill_n(rows(i), beside * work_step, 0.0f); };
    // Takes the directions between slice i and the next one, the first of which is contribution `from`.
    const auto gather = [&](std::size_t i, std::size_t from) {
        std::size_t to = from;
        while (to < all.size() && std::size_t(all[to].slice) == i) ++to;
        const std::size_t next = (i + 1) % n;
        add_weighted(all.subspan(from, to - from), horizons + from * work_step, values + i * slice_step,
                     values + next * slice_step, miss, steps, rows(i), rows(next), count);
        return to;
    };
    const auto step = [&](std::size_t i, bool final) {
        relax(rows((i + last) % n), rows((i + 1) % n), rows(i), values + i * slice_step, final, count);
    };
    // What follows the last slice adds to the first one, whose sums have to be complete before its step.
    std::size_t from = all.size();
    while (from > 0 && std::size_t(all[from - 1].slice) == last) --from;
    clear(last);
    clear(0);
    gather(last, from);
    from = 0;
    for (std::size_t i = 0; i < last; ++i) {
        if (i + 1 < last) clear(i + 1);
        from = gather(i, from);
        step(i, false);
    }
    step(last, false);
    for (std::size_t i = 0; i < n; ++i) step(i, true);
}

// Moves the values of slices, which least squares gave, for the least mean error of the elevation.
//   horizons: stored values, a row for each contribution, work_step apart
//   values: [slice] at slice_step; sums: rows_of_slice rows a slice
inline void reweight(const plan& p, const float* horizons, float* values, std::size_t slice_step, float* sums,
                     std::size_t count) {
    switch (p.stored) {
        case quantity::slope:
            return reweight(p, slope_steps{(std::min)(p.unit, 1e4f)}, horizons, values, slice_step, sums, count);
        case quantity::sine: return reweight(p, sine_steps{p.unit}, horizons, values, slice_step, sums, count);
        case quantity::angle: return reweight(p, angle_steps{}, horizons, values, slice_step, sums, count);
    }
}

}  // namespace bumpshadow::slice_detail
