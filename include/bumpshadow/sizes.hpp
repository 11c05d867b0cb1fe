#pragma once

#include <cstddef>
#include <limits>

#include <bumpshadow/config.hpp>

// Sizes of buffers from extents and strides that may be anything. One too large for std::size_t becomes the largest
// there is, which no buffer has, in place of a small one that any buffer has.
namespace bumpshadow {

// a + b, at most the largest std::size_t.
[[nodiscard]] constexpr std::size_t saturated_sum(std::size_t a, std::size_t b) {
    constexpr std::size_t most = (std::numeric_limits<std::size_t>::max)();
    return a > most - b ? most : a + b;
}

// a * b, at most the largest std::size_t.
[[nodiscard]] constexpr std::size_t saturated_product(std::size_t a, std::size_t b) {
    constexpr std::size_t most = (std::numeric_limits<std::size_t>::max)();
    // Of usual sizes there is no division.
    constexpr int half = std::numeric_limits<std::size_t>::digits / 2;
    if (((a | b) >> half) == 0) return a * b;
    return b != 0 && a > most / b ? most : a * b;
}

// Parts of `each` that make up `count`, the last one perhaps smaller; 0 for a count that is not positive. each: at
// least 1.
[[nodiscard]] constexpr int part_count(int count, int each) { return count > 0 ? (count - 1) / each + 1 : 0; }

}  // namespace bumpshadow
