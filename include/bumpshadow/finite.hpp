#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <bumpshadow/config.hpp>

// Questions about NaN and infinity that are answered from the bits of a number, so that a user's -ffast-math, under
// which compilers take all numbers for finite, does not change the answer. In constant expressions, too. They take
// references, since such a compiler may take what is passed by value for finite as well.
namespace bumpshadow {

namespace finite_detail {

template <std::floating_point T>
using bits_of = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

// Without the sign; infinity is the largest number that is not NaN.
template <std::floating_point T>
[[nodiscard]] constexpr bits_of<T> magnitude(const T& value) {
    static_assert(std::numeric_limits<T>::is_iec559 && sizeof(T) == sizeof(bits_of<T>));
    return std::bit_cast<bits_of<T>>(value) & (~bits_of<T>(0) >> 1);
}

template <std::floating_point T>
inline constexpr bits_of<T> infinity_bits = ((bits_of<T>(1) << (sizeof(T) == 4 ? 8 : 11)) - 1)
                                            << (std::numeric_limits<T>::digits - 1);

}  // namespace finite_detail

// Neither NaN nor infinite.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_finite(const T& value) {
    return finite_detail::magnitude(value) < finite_detail::infinity_bits<T>;
}
// Infinite, of either sign.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_infinite(const T& value) {
    return finite_detail::magnitude(value) == finite_detail::infinity_bits<T>;
}
// Not a number, of either sign.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_nan(const T& value) {
    return finite_detail::magnitude(value) > finite_detail::infinity_bits<T>;
}

// True where the compiler was told that there is neither NaN nor infinity: -ffast-math, -ffinite-math-only, /fp:fast.
// What needs NaN on its way refuses to run then.
#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
inline constexpr bool finite_math_only = true;
#else
inline constexpr bool finite_math_only = false;
#endif

}  // namespace bumpshadow
