#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/status.hpp>

// Truncated Fourier series over the bearing, fitted to values in given directions.

namespace bumpshadow {

// Of a series: the constant, and sine and cosine of four bands.
inline constexpr std::size_t most_coefficients = 9;

// The terms of a series in one direction; no units.
using fourier_terms = std::array<double, most_coefficients>;

// 1, sin t, cos t, sin 2t, cos 2t ... of a direction of any length but 0, with x = sin t and y = cos t.
[[nodiscard]] inline fourier_terms terms_of(glm::dvec2 direction) {
    const glm::dvec2 d = unit_direction(direction);
    fourier_terms terms{1.0, d.x, d.y};
    for (std::size_t i = 3; i < most_coefficients; i += 2) {
        terms[i] = terms[i - 2] * d.y + terms[i - 1] * d.x;
        terms[i + 1] = terms[i - 1] * d.y - terms[i - 2] * d.x;
    }
    return terms;
}

// Weights of the values at `directions` in each coefficient of the series of `count` terms that fits them best (least
// squares): coefficient i is the sum over m of weights[i * directions.size() + m] * value m. For evenly spaced
// directions, more than count of them or as many, that is the projection: the mean of value times term, and twice that
// for all but the constant. The weights are for this mean, so the series is constant + 2 (...).
//   weights: count * directions.size()
// Errors: too_small for fewer directions than terms, out_of_range where they do not determine a term (equal
// directions).
[[nodiscard]] inline status fit_series(std::span<const glm::dvec2> directions, int count, std::span<float> weights) {
    const std::size_t n = std::size_t(count), m = directions.size();
    if (m < n) return {error::too_small, "directions", double(m), double(n)};
    // Normal matrix, by its Cholesky factor below the diagonal.
    std::array<fourier_terms, most_coefficients> normal{};
    for (const glm::dvec2& direction : directions) {
        const fourier_terms terms = terms_of(direction);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j) normal[i][j] += terms[i] * terms[j] / double(m);
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = normal[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= normal[i][k] * normal[j][k];
            if (i == j && !(sum > 1e-6))
                return {error::out_of_range, "directions (too few different ones), terms determined", double(i),
                        double(n)};
            normal[i][j] = i == j ? std::sqrt(sum) : sum / normal[j][j];
        }
    for (std::size_t d = 0; d < m; ++d) {
        fourier_terms x = terms_of(directions[d]);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= normal[i][k] * x[k];
            x[i] /= normal[i][i];
        }
        for (std::size_t i = n; i-- > 0;) {
            for (std::size_t k = i + 1; k < n; ++k) x[i] -= normal[k][i] * x[k];
            x[i] /= normal[i][i];
        }
        for (std::size_t i = 0; i < n; ++i)
            weights[i * m + d] = static_cast<float>(x[i] / double(m) * (i == 0 ? 1.0 : 0.5));
    }
    return {};
}

}  // namespace bumpshadow
