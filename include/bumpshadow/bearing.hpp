#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/glm.hpp>

namespace bumpshadow {

// A bearing is a direction in the surface as a fraction of a turn, in [0, 1): 0 along +x, 0.25 along +y.
//
//   function             max. error   cost besides choosing the quadrant     inverse
//   exact_bearing        rounding     division, arc tangent                  sine, cosine
//   quintic_bearing        0.012 deg  reciprocal square root, 4 multiplies   sine, 3 Newton steps
//   cubic_bearing          0.12 deg   reciprocal square root, 3 multiplies   sine, 3 Newton steps
//   octant_bearing         1.90 deg   division, reciprocal square root       closed form
//   diamond_bearing        4.07 deg   2 divisions                            closed form
//
// All take vectors of any length, whose squares may overflow or vanish; the zero vector has bearing 0. All are
// continuous and grow with the true angle, agree at the multiples of 1/8 turn and have the symmetry of the square.
// The error is the largest angle between a vector and what exact_direction makes of its bearing. The inverses,
// X_direction, take any finite bearing and return the unit vector whose X_bearing it is. Horizons that a shader looks
// up through X_bearing are baked in the directions of X_direction. Vectors and bearings have to be finite.

// Largest errors in degrees, measured over all directions.
inline constexpr double quintic_max_error = 0.01153;  // degrees
inline constexpr double cubic_max_error = 0.1221;     // degrees
inline constexpr double octant_max_error = 1.8967;    // degrees
inline constexpr double diamond_max_error = 4.0749;   // degrees

// Numbers that bearings are computed in.
template <class T>
concept bearing_scalar = std::same_as<T, float> || std::same_as<T, double>;

namespace bearing_detail {

// A vector relative to the nearest axis: bearing of that axis, and tangent of the angle from there, in [-1, 1].
template <bearing_scalar T>
struct quadrant_position {
    T axis;
    T ratio;
};

template <bearing_scalar T>
[[nodiscard]] inline quadrant_position<T> fold(glm::vec<2, T> v) {
    if (std::abs(v.y) > std::abs(v.x)) return {v.y > T(0) ? T(0.25) : T(0.75), -v.x / v.y};
    return {v.x >= T(0) ? T(0) : T(0.5), v.x != T(0) ? v.y / v.x : T(0)};
}

// Into [0, 1). A fraction just below 0 would round to 1, so it ends at the last number before.
template <bearing_scalar T>
[[nodiscard]] inline T wrap_bearing(T bearing) {
    const T fraction = bearing - std::floor(bearing);
    constexpr T last = T(1) - std::numeric_limits<T>::epsilon() / T(2);
    return fraction < last ? fraction : last;
}

template <bearing_scalar T>
struct bearing_position {
    int quarter;  // nearest axis in quarter turns, 0 to 4
    T offset;     // turns from there, in [-1/8, 1/8]
};

template <bearing_scalar T>
[[nodiscard]] inline bearing_position<T> split(T bearing) {
    const T fraction = bearing - std::floor(bearing);
    const T quarter = std::floor(T(4) * fraction + T(0.5));
    return {static_cast<int>(quarter), fraction - T(0.25) * quarter};
}

template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> quarter_turns(int quarters, glm::vec<2, T> v) {
    // Adding 0 makes +0 of -0.
    switch (quarters & 3) {
        case 0: return {v.x, v.y};
        case 1: return {T(0) - v.y, v.x};
        case 2: return {T(0) - v.x, T(0) - v.y};
        default: return {v.y, T(0) - v.x};
    }
}

template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> unfold(int quarters, T ratio) {
    const T x = std::sqrt(T(1) / (T(1) + ratio * ratio));
    return quarter_turns(quarters, glm::vec<2, T>(x, x * ratio));
}

// Turns from an axis are nearly its sine s times a polynomial in s^2: minimax fits of asin(s) / (2 pi) that are exact
// at 0 and at 1/8 turn (Remez exchange on the form as it is written, in double).
template <bearing_scalar T>
inline constexpr T cubic_coefficients[2] = {T(0.15703793423093532), T(0.039477522131403084)};
template <bearing_scalar T>
inline constexpr T quintic_coefficients[3] = {T(0.1594458615850114), T(0.022631394397676197), T(0.024060546051149476)};

template <bearing_scalar T, int N>
[[nodiscard]] constexpr T odd_polynomial(const T (&c)[N], T s) {
    T sum = c[N - 1];
    for (int i = N - 1; i-- > 0;) sum = c[i] + s * s * sum;
    return s * sum;
}

template <bearing_scalar T, int N>
[[nodiscard]] inline T sine_bearing(const T (&c)[N], glm::vec<2, T> v) {
    const auto [axis, ratio] = fold(v);
    // Diagonals are exact.
    if (std::abs(ratio) == T(1)) return wrap_bearing(axis + T(0.125) * ratio);
    return wrap_bearing(axis + odd_polynomial(c, ratio / std::sqrt(T(1) + ratio * ratio)));
}

// Direction whose odd polynomial is that of a bearing. The sine of the offset is within 0.13 degrees of the answer, and
// each Newton step squares the error.
template <bearing_scalar T, int N>
[[nodiscard]] inline glm::vec<2, T> solve_odd_polynomial(const T (&c)[N], T bearing) {
    const auto [quarter, offset] = split(bearing);
    if (std::abs(offset) == T(0.125)) return unfold(quarter, T(8) * offset);
    T s = std::sin(offset * T(6.28318530717958647693));
    for (int step = 0; step < 3; ++step) {
        T derivative = T(0);
        for (int i = N; i-- > 0;) derivative = T(2 * i + 1) * c[i] + s * s * derivative;
        s -= (odd_polynomial(c, s) - offset) / derivative;
    }
    return quarter_turns(quarter, glm::vec<2, T>(std::sqrt((T(1) - s) * (T(1) + s)), s));
}

}  // namespace bearing_detail

// The true angle, in turns.
template <bearing_scalar T>
[[nodiscard]] inline T exact_bearing(glm::vec<2, T> v) {
    const auto [axis, ratio] = bearing_detail::fold(v);
    return bearing_detail::wrap_bearing(axis + std::atan(ratio) * T(0.15915494309189533577));
}

// The unit vector of a bearing. Multiples of 1/8 turn give exactly (1, 0), (s, s), (0, 1) and so on; bearings that
// mirror each other at one of these directions, as far as they can be written exactly, give exact mirror images.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> exact_direction(T bearing) {
    const auto [quarter, offset] = bearing_detail::split(bearing);
    if (std::abs(offset) == T(0.125)) return bearing_detail::unfold(quarter, T(8) * offset);
    const T angle = offset * T(6.28318530717958647693);
    return bearing_detail::quarter_turns(quarter, glm::vec<2, T>(std::cos(angle), std::sin(angle)));
}

// Phase of the published octant function, in turns.
inline constexpr double octant_published_phase = 0.125;

// Forsyth's piecewise linear function: in each quadrant around an axis, the component of the unit vector across that
// axis. phase: the bearing that comes out as 0. The published listing starts at 45 degrees, octant_published_phase;
// its rounded constants (0.707 and 0.25 / 1.414) return slightly more than 1 at (0.7071, 0.7071), which this does not.
// Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, section 4.1.
template <bearing_scalar T>
[[nodiscard]] inline T octant_bearing(glm::vec<2, T> v, std::type_identity_t<T> phase = T(0)) {
    const auto [axis, ratio] = bearing_detail::fold(v);
    const T offset = T(0.125) * ratio / std::sqrt(T(0.5) + T(0.5) * ratio * ratio);
    return bearing_detail::wrap_bearing(axis + offset - phase);
}

// The unit vector whose octant_bearing, with the same phase, is this.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> octant_direction(T bearing, std::type_identity_t<T> phase = T(0)) {
    const auto [quarter, offset] = bearing_detail::split(bearing + phase);
    const T twice_square = T(64) * offset * offset;  // 2 sin^2
    return bearing_detail::unfold(quarter, T(8) * offset / std::sqrt(T(2) - twice_square));
}

// The perimeter of the diamond |x| + |y| = 1. No square root, and twice the octant's error.
template <bearing_scalar T>
[[nodiscard]] inline T diamond_bearing(glm::vec<2, T> v) {
    const auto [axis, ratio] = bearing_detail::fold(v);
    return bearing_detail::wrap_bearing(axis + T(0.25) * ratio / (T(1) + std::abs(ratio)));
}

// The unit vector whose diamond_bearing is this.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> diamond_direction(T bearing) {
    const auto [quarter, offset] = bearing_detail::split(bearing);
    return bearing_detail::unfold(quarter, T(4) * offset / (T(1) - T(4) * std::abs(offset)));
}

// s (c0 + c1 s^2), s being the sine of the angle from the nearest axis. Where a shader has 1 / |v| anyway, for the
// slope of the light, it costs less than the octant and has a fifteenth of its error.
template <bearing_scalar T>
[[nodiscard]] inline T cubic_bearing(glm::vec<2, T> v) {
    return bearing_detail::sine_bearing(bearing_detail::cubic_coefficients<T>, v);
}

// The unit vector whose cubic_bearing is this.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> cubic_direction(T bearing) {
    return bearing_detail::solve_odd_polynomial(bearing_detail::cubic_coefficients<T>, bearing);
}

// s (c0 + c1 s^2 + c2 s^4): one multiply-add more, and the error no longer matters beside anything else.
template <bearing_scalar T>
[[nodiscard]] inline T quintic_bearing(glm::vec<2, T> v) {
    return bearing_detail::sine_bearing(bearing_detail::quintic_coefficients<T>, v);
}

// The unit vector whose quintic_bearing is this.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> quintic_direction(T bearing) {
    return bearing_detail::solve_odd_polynomial(bearing_detail::quintic_coefficients<T>, bearing);
}

// Bearing of a vector by the function of that name, in turns; octant with phase 0.
template <bearing_scalar T>
[[nodiscard]] inline T to_bearing(bearing_function function, glm::vec<2, T> v) {
    switch (function) {
        case bearing_function::quintic: return quintic_bearing(v);
        case bearing_function::cubic: return cubic_bearing(v);
        case bearing_function::octant: return octant_bearing(v);
        case bearing_function::diamond: return diamond_bearing(v);
        case bearing_function::exact: break;
    }
    return exact_bearing(v);
}

// Its inverse: the unit vector of a bearing.
template <bearing_scalar T>
[[nodiscard]] inline glm::vec<2, T> to_direction(bearing_function function, T bearing) {
    switch (function) {
        case bearing_function::quintic: return quintic_direction(bearing);
        case bearing_function::cubic: return cubic_direction(bearing);
        case bearing_function::octant: return octant_direction(bearing);
        case bearing_function::diamond: return diamond_direction(bearing);
        case bearing_function::exact: break;
    }
    return exact_direction(bearing);
}

// The vector of length 1 along one of any finite length but 0.
[[nodiscard]] inline glm::dvec2 unit_direction(glm::dvec2 direction) {
    // By a power of two, which rounds nothing: the length of the largest overflows, that of the least has no digits.
    const double largest = (std::max)(std::abs(direction.x), std::abs(direction.y));
    direction *= largest > 0x1p500 ? 0x1p-600 : largest < 0x1p-500 ? 0x1p600 : 1.0;
    return direction / std::hypot(direction.x, direction.y);
}

// Directions of evenly spaced slices: out[i] = direction(phase + i / out.size()), direction being one of the inverses
// above (as a lambda) or any function of a bearing in double that has the symmetry of the square.
// Where phase is a multiple of half a slice, directions that mirror each other are exact mirror images.
template <class Direction>
void fill_directions(std::span<glm::dvec2> out, double phase, const Direction& direction) {
    const double first = phase - std::floor(phase);
    const auto slices = static_cast<std::int64_t>(out.size());
    // In units of half a slice bearings are whole numbers, and are brought into the first octant without rounding.
    const std::int64_t turn = 2 * slices;
    const double half_slices = first * double(turn);
    const double whole = std::floor(half_slices + 0.5);
    const bool symmetric = std::abs(half_slices - whole) < 1e-9;
    for (std::int64_t i = 0; i < slices; ++i) {
        glm::dvec2& d = out[std::size_t(i)];
        if (!symmetric) {
            d = direction(bearing_detail::wrap_bearing(first + double(i) / double(slices)));
            continue;
        }
        const std::int64_t position = (2 * i + static_cast<std::int64_t>(whole)) % turn;
        const std::int64_t quarter = (8 * position + turn) / (2 * turn);
        const std::int64_t offset = 4 * position - quarter * turn;
        const glm::dvec2 v = direction(double(offset < 0 ? -offset : offset) / double(4 * turn));
        d = bearing_detail::quarter_turns(static_cast<int>(quarter), offset < 0 ? glm::dvec2(v.x, 0.0 - v.y) : v);
    }
}

// The same by the inverse of a bearing function; phase in turns.
inline void fill_directions(std::span<glm::dvec2> out, double phase, bearing_function function) {
    fill_directions(out, phase, [function](double bearing) { return to_direction(function, bearing); });
}

// The same in true angles; phase in turns.
inline void fill_directions(std::span<glm::dvec2> out, double phase = 0.0) {
    fill_directions(out, phase, [](double bearing) { return exact_direction(bearing); });
}

}  // namespace bumpshadow
