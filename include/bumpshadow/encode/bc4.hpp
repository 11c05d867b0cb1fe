#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <bumpshadow/simd.hpp>

// BC4 (RGTC1, ATI1): 4 x 4 texels of one channel in 8 bytes. Two ends of 8 bits, and for each texel 3 bits that pick
// one of eight values: the ends and six evenly between them where the first end is larger; else the ends, four between
// them, 0 and 1. Values of a block are [y][x], row by row.

namespace bumpshadow {

// How blocks are encoded. Once each value has a step between the ends, the best ends for these steps come from a
// straight line through them, by least squares; so what has to be found is the steps. They are tried as even divisions
// of the range of the values, a few ways for all values and a few without those near 0 and 1, which are free in the
// second form, and the line that leaves the smallest error wins.
//
// Blocks lie side by side, one a lane. The bytes do not depend on how many, nor on whether a product and a sum are
// rounded once or twice: what is added up is whole numbers, exact in floats, and where a product is not exact a bound
// stands between it and the sum.
namespace bc4_detail {

using simd::pack;

inline constexpr float byte = 32.0f, most = 255.0f * byte;  // values are in 32nds of a byte
inline constexpr float grid = 1024.0f;                      // places in the range of a block's values

// The step of a value at place p of the range, 0 to 1: first + steps * p, rounded.
struct division {
    float steps, first;  // multiples of 1/16
};

// Chosen one after the other, each as the one that lowered the error of fitted slices of six maps most.
inline constexpr division all_inside[] = {{7.375f, -0.1875f}, {7.375f, -0.375f}, {7.375f, 0.0f},
                                          {6.0f, 0.0f},       {6.5f, 0.5f},      {5.0f, 0.0f}};
inline constexpr division without_near[] = {{5.375f, -0.1875f}, {4.0f, 0.0f}};
inline constexpr division without_far[] = {{5.25f, -0.1875f}, {5.0f, 0.0f}};
inline constexpr float close_ends = 4.0f * byte;
inline constexpr float near_edge = 6.0f * byte, far_edge = 16.0f * byte;

struct ends {
    pack low, high;  // whole bytes
    pack error;      // squared, before they were
};

[[nodiscard]] inline pack rounded(pack positive) { return simd::whole(simd::add(positive, simd::splat(0.5f))); }

// Ends of the form with so many steps, 7 or 5. For 5 without the values whose `edge`, the distance to 0 or to `most`,
// is not above the margin.
template <int Steps, std::size_t Count>
[[nodiscard]] ends fit(const pack (&values)[16], const pack (&edges)[16], float margin,
                       const division (&divisions)[Count]) {
    using namespace simd;
    const pack zero = splat(0.0f), one = splat(1.0f), above_all = splat(most), steps = splat(float(Steps));
    const pack limit = splat(margin);
    const auto inside = [&](int t, pack yes, pack no) {
        return Steps == 7 ? yes : select_greater(edges[t], limit, yes, no);
    };
    pack low = above_all, high = zero, count = splat(16.0f), outside = zero;
    for (int t = 0; t < 16; ++t) {
        low = smaller(low, inside(t, values[t], above_all));
        high = larger(high, inside(t, values[t], zero));
    }
    if constexpr (Steps == 5) {
        count = zero;
        for (int t = 0; t < 16; ++t) {
            const pack edge = inside(t, zero, edges[t]);
            outside = multiply_add(edge, edge, outside);
            count = add(count, inside(t, one, zero));
        }
        count = larger(count, one);
        high = larger(high, low);
    }
    const pack range = subtract(high, low), to_grid = divide(splat(grid), larger(range, one));
    const pack from_grid = multiply(range, splat(1.0f / grid)), share = divide(one, count);
    pack places[16], sum = zero, squares = zero;
    for (int t = 0; t < 16; ++t) {
        // What is outside has place and step 0, and is not felt.
        places[t] = inside(t, rounded(larger(multiply(subtract(values[t], low), to_grid), zero)), zero);
        sum = add(sum, places[t]);
        squares = multiply_add(places[t], places[t], squares);
    }

    // Lines that lead beyond 0 or 1 by more than two bytes are of no use.
    const pack least = subtract(splat(-2.0f * byte), low), greatest = subtract(splat(most + 2.0f * byte), low);
    pack gain = zero, first = zero, last = splat(grid), step_sum = zero, step_squares = zero;
    if constexpr (Steps == 7) {
        // Where all do, what is left are ends at the extremes.
        pack misses = zero;
        for (int t = 0; t < 16; ++t) {
            const pack step = rounded(multiply(places[t], splat(7.0f / grid)));
            const pack miss = subtract(multiply(steps, places[t]), multiply(step, splat(grid)));
            misses = multiply_add(miss, miss, misses);
            step_sum = add(step_sum, step);
            step_squares = multiply_add(step, step, step_squares);
        }
        const pack hit = subtract(squares, divide(misses, splat(49.0f)));
        gain = larger(subtract(larger(multiply(count, hit), zero), larger(multiply(sum, sum), zero)), zero);
    }
    for (const division& d : divisions) {
        const pack scale = splat(d.steps / grid), offset = splat(d.first + 0.5f);
        pack s = zero, ss = zero, sp = zero;
        for (int t = 0; t < 16; ++t) {
            const pack step = whole(multiply_add(places[t], scale, offset));
            s = add(s, step);
            ss = multiply_add(step, step, ss);
            sp = multiply_add(step, places[t], sp);
        }
        const pack spread = subtract(multiply(count, ss), multiply(s, s));
        const pack common = subtract(multiply(count, sp), multiply(s, sum)),
                   slope = divide(common, larger(spread, one));
        const pack start = multiply(subtract(sum, larger(multiply(slope, s), zero)), share);
        const pack end = add(start, larger(multiply(slope, steps), zero));
        pack g = multiply(common, slope);
        g = select_greater(least, multiply(start, from_grid), zero, g);
        g = select_greater(multiply(end, from_grid), greatest, zero, g);
        first = select_greater(g, gain, start, first);
        last = select_greater(g, gain, end, last);
        step_sum = select_greater(g, gain, s, step_sum);
        step_squares = select_greater(g, gain, ss, step_squares);
        gain = larger(gain, g);
    }

    ends result;
    const pack line = larger(multiply(gain, share), zero), mean = larger(multiply(multiply(sum, sum), share), zero);
    const pack missed = subtract(subtract(squares, mean), line);
    result.error = add(larger(multiply(multiply(missed, from_grid), from_grid), zero), outside);
    const pack at_low = add(low, larger(multiply(first, from_grid), subtract(zero, low)));
    const pack at_high = add(low, smaller(multiply(last, from_grid), subtract(above_all, low)));
    // A low end that is rounded moves the high end that is best with it. Where ends are close they are rounded
    // outwards, since the steps between them are finer than bytes; those that are bytes all but a tenth stay.
    const pack unit = splat(byte), bytes = splat(1.0f / byte), distance = subtract(at_high, at_low);
    const pack close = splat(close_ends), half = splat(0.5f);
    result.low =
        multiply(whole(add(multiply(at_low, bytes), select_greater(close, distance, splat(0.1f), half))), unit);
    const pack pull = divide(subtract(multiply(steps, step_sum), step_squares), larger(step_squares, one));
    const pack moved =
        select_greater(close, distance, zero, smaller(multiply(pull, subtract(result.low, at_low)), above_all));
    const pack best_high = larger(smaller(subtract(at_high, moved), above_all), result.low);
    result.high =
        multiply(whole(add(multiply(best_high, bytes), select_greater(close, distance, splat(0.9f), half))), unit);
    return result;
}

// Blocks of values in [0, 1], one a lane; texel t of all of them is at [t].
inline void encode(const pack (&texels)[16], std::byte* to, int blocks) {
    using namespace simd;
    const pack zero = splat(0.0f), one = splat(1.0f), above_all = splat(most);
    pack values[16], edges[16], nearest = above_all;
    for (int t = 0; t < 16; ++t) {
        const pack scaled = multiply(texels[t], above_all), positive = select_greater(scaled, zero, scaled, zero);
        values[t] = rounded(smaller(positive, above_all));
        edges[t] = smaller(values[t], subtract(above_all, values[t]));
        nearest = smaller(nearest, edges[t]);
    }
    ends best = fit<7>(values, edges, 0.0f, all_inside);
    pack steps = splat(7.0f);
    // Free extremes help only where there are values next to them; 1.3 is what rounding to 8 bits makes.
    const pack close = select_greater(splat(24.0f * byte), nearest, best.error, zero), fine = splat(1.3f * byte * byte);
    float lanes[width];
    store(lanes, close);
    if (*std::max_element(lanes, lanes + width) > 1.3f * byte * byte) {
        const auto try_ends = [&](const ends& e) {
            const pack error = select_greater(close, fine, e.error, splat(1e12f));
            best.low = select_greater(best.error, error, e.low, best.low);
            best.high = select_greater(best.error, error, e.high, best.high);
            steps = select_greater(best.error, error, splat(5.0f), steps);
            best.error = smaller(best.error, error);
        };
        try_ends(fit<5>(values, edges, near_edge, without_near));
        try_ends(fit<5>(values, edges, far_edge, without_far));
    }

    // Equal ends make the second form, too. Codes count from the first end: 0 is it, 1 the second one.
    const pack range = subtract(best.high, best.low), six = splat(6.0f);
    steps = select_greater(range, zero, steps, splat(5.0f));
    const pack first = select_greater(steps, six, best.high, best.low);
    const pack second = select_greater(steps, six, best.low, best.high), span = subtract(second, first);
    const pack scale = select_greater(range, zero, divide(steps, select_greater(range, zero, span, one)), zero);
    const pack before_last = subtract(steps, splat(0.5f)), free = select_greater(steps, six, splat(1e12f), zero);
    pack codes[2];
    for (int half = 0; half < 2; ++half) {
        pack sum = zero;
        for (int t = 8 * half + 7; t >= 8 * half; --t) {
            const pack beyond = subtract(values[t], first);
            const pack step = rounded(smaller(larger(multiply(beyond, scale), zero), steps));
            const pack miss = subtract(multiply(steps, beyond), multiply(step, span));
            const pack edge = multiply(steps, edges[t]);
            const pack between =
                select_greater(step, before_last, one, add(step, select_greater(step, zero, one, zero)));
            const pack extreme = select_greater(values[t], splat(0.5f * most), splat(7.0f), six);
            const pack code =
                select_greater(multiply(miss, miss), larger(multiply(edge, edge), free), extreme, between);
            sum = multiply_add(sum, splat(8.0f), code);  // 24 bits: exact
        }
        codes[half] = sum;
    }

    const pack bytes = splat(1.0f / byte);
    float numbers[4][width];
    store(numbers[0], multiply(first, bytes));
    store(numbers[1], multiply(second, bytes));
    store(numbers[2], codes[0]);
    store(numbers[3], codes[1]);
    for (int i = 0; i < blocks; ++i, to += 8) {
        const auto bits = [&](int n) { return std::uint64_t(std::uint32_t(numbers[n][i])); };
        const std::uint64_t block = bits(0) | bits(1) << 8 | bits(2) << 16 | bits(3) << 40;
        for (int j = 0; j < 8; ++j) to[j] = static_cast<std::byte>((block >> (8 * j)) & 0xffu);
    }
}

}  // namespace bc4_detail

// The 16 values of a block, in [0, 1], interpolated exactly as D3D and Vulkan state it.
inline void decode_bc4(const std::byte* block, float* values) {
    const int first = std::to_integer<int>(block[0]), second = std::to_integer<int>(block[1]);
    float palette[8];
    for (int i = 0; i < 8; ++i) {
        const int part = i == 0 ? 0 : i == 1 ? 7 : i - 1;
        if (first > second) {
            palette[i] = float(first * (7 - part) + second * part) / (7.0f * 255.0f);
        } else {
            const int fifth = i == 0 ? 0 : i == 1 ? 5 : i - 1;
            palette[i] = float(first * (5 - fifth) + second * fifth) / (5.0f * 255.0f);
        }
    }
    if (first <= second) {
        palette[6] = 0.0f;
        palette[7] = 1.0f;
    }
    std::uint64_t codes = 0;
    for (int i = 0; i < 6; ++i) codes |= std::to_integer<std::uint64_t>(block[2 + i]) << (8 * i);
    for (int t = 0; t < 16; ++t) values[t] = palette[(codes >> (3 * t)) & 7u];
}

// A row of blocks from up to four rows of values in [0, 1]; NaN counts as 0. Rows that are missing repeat the last one,
// as do texels beyond `width`. row(r): values of row r, `width` of them.
//
// A block depends on its own values alone, and its bytes are the same on all machines. Blocks of one value hold it
// within an eighth of a byte, and exactly where it is one. Accuracy, on fitted slices of six maps: in squares 5 % above
// trying all ends (3 to 8 % a map), where ends at the extremes are 50 to 130 % above; none of 18000 blocks was above
// those by more than 8 % and a square byte a value. 8 and 16 fitted slices are wrong (lit or shadowed) for 2.98 and
// 1.61 % of lights (mean of six maps), by stb_dxt for 3.10 and 1.76 %. Takes 2.8 ns a value on one core with 512-bit
// vectors, 4 with 256 and 8 with 128: 16 slices 0.8 of the bake of 16 bearings.
template <class Row>
void encode_bc4_row(const Row& row, int rows, int width, std::byte* to) {
    using namespace simd;
    constexpr int blocks = simd::width, texels = 4 * blocks;
    for (int x = 0; x < width; x += texels, to += 8 * blocks) {
        const int count = (std::min)(texels, width - x);
        pack values[16];
        for (int r = 0; r < 4; ++r) {
            float line[texels];
            const float* const from = row((std::min)(r, rows - 1)) + x;
            std::copy_n(from, count, line);
            std::fill(line + count, line + texels, from[count - 1]);
            const pack a = load(line), b = load(line + blocks), c = load(line + 2 * blocks),
                       d = load(line + 3 * blocks);
            const pack even_low = even(a, b), even_high = even(c, d), odd_low = odd(a, b), odd_high = odd(c, d);
            values[4 * r] = even(even_low, even_high);
            values[4 * r + 1] = even(odd_low, odd_high);
            values[4 * r + 2] = odd(even_low, even_high);
            values[4 * r + 3] = odd(odd_low, odd_high);
        }
        bc4_detail::encode(values, to, (count + 3) / 4);
    }
}

// One block of 16 values. A row of them takes hardly longer.
inline void encode_bc4(const float* values, std::byte* block) {
    encode_bc4_row([&](int r) { return values + 4 * r; }, 4, 4, block);
}

}  // namespace bumpshadow
