#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>

#include <bumpshadow/config.hpp>

namespace bumpshadow {

// Times of several runs of the same.
struct time_figures {
    double median = 0.0, least = 0.0, most = 0.0;  // seconds
    int repeats = 0;                               // runs that count
};

// Two bodies against each other.
struct time_ratio {
    time_figures first, second;  // of one of the two bodies
    double ratio = 0.0;          // time of the first over that of the second: the median over pairs of neighboring runs
};

// Runs that are timed, at the most.
inline constexpr int most_repeats = 1000;

namespace measure_detail {

template <class Body>
[[nodiscard]] double seconds_of(Body& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The middle one, or the mean of both; the order of the values changes.
[[nodiscard]] inline double median_of(std::span<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

[[nodiscard]] inline time_figures times_of(std::span<double> seconds) {
    const double median = median_of(seconds);
    return {median, seconds.front(), seconds.back(), int(seconds.size())};
}

}  // namespace measure_detail

// Times a body, wall clock, on an otherwise idle machine if that can be had. It is run once more before, so that caches
// and memory are as in the runs that count.
//   repeats  1 to most_repeats, clamped
template <class Body>
[[nodiscard]] time_figures measure_time(int repeats, Body&& body) {
    const auto count = std::size_t((std::clamp)(repeats, 1, most_repeats));
    double seconds[most_repeats];
    body();
    for (std::size_t i = 0; i < count; ++i) seconds[i] = measure_detail::seconds_of(body);
    return measure_detail::times_of({seconds, count});
}

// Times two bodies by turns, a b, b a, a b and so on, so that a machine that becomes slower or faster meanwhile does
// not matter to the ratio. Absolute times are not comparable between machines, nor between runs on a busy one; ratios
// are.
//   repeats  pairs, 1 to most_repeats, clamped
template <class First, class Second>
[[nodiscard]] time_ratio measure_time_ratio(int repeats, First&& first, Second&& second) {
    const auto count = std::size_t((std::clamp)(repeats, 1, most_repeats));
    double seconds[2][most_repeats], ratios[most_repeats];
    first();
    second();
    for (std::size_t i = 0; i < count; ++i) {
        const bool turned = i % 2 != 0;
        if (turned) seconds[1][i] = measure_detail::seconds_of(second);
        seconds[0][i] = measure_detail::seconds_of(first);
        if (!turned) seconds[1][i] = measure_detail::seconds_of(second);
        // A clock that did not tick says nothing but that both were short.
        ratios[i] = seconds[1][i] > 0.0 ? seconds[0][i] / seconds[1][i] : 1.0;
    }
    return {measure_detail::times_of({seconds[0], count}), measure_detail::times_of({seconds[1], count}),
            measure_detail::median_of({ratios, count})};
}

}  // namespace bumpshadow
