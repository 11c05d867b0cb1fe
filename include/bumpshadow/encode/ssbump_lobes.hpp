#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/status.hpp>

// What is visible of the upper hemisphere above horizons, weighted by a clamped cosine around some vector.
//
// Along a bearing whose unit vector is d, a direction of elevation e is w = (d cos e, sin e), and takes cos e de of
// solid angle for each radian of bearing. A vector b has the cosine b . w = q cos e + b.z sin e with q = b.xy . d.
// Above a horizon of slope s >= 0 its integral over elevation is
//     q A(s) + b.z B(s),   A(s) = (acot s - s / (1 + s^2)) / 2,   B(s) = 1 / (2 (1 + s^2))
// since A and B are the integrals of cos^2 e and sin e cos e from atan s to 90 degrees. The cosine is positive from the
// slope -q / b.z on (b.z > 0), so clamping it at 0 means to start at max(s, -q / b.z). A and B alone are, summed over
// bearings as (A d, B), the integral of w itself: the mean unblocked direction. All that is left is a sum over
// bearings.

namespace bumpshadow {

// Directions of a horizon map that masks are made of, at the most.
inline constexpr int most_lobe_bearings = 256;

namespace lobe_detail {

struct open_integrals {
    float across, up;  // A and B
};

// slope: 0 or more, at most 1e18. Absolute error of A and B below 3e-7.
[[nodiscard]] inline open_integrals above(float slope) {
    const float low = slope < 1.0f ? slope : 1.0f, high = slope < 1.0f ? 1.0f : slope;
    // atan on [0, 1], Remez exchange, within 2.5e-7.
    const float u = low / high, q = u * u;
    const float atan_u =
        u * (0.9999961f +
             q * (-0.33317368f +
                  q * (0.19807816f + q * (-0.13233342f + q * (0.07962367f + q * (-0.03360422f + q * 0.006811793f))))));
    const float acot = slope < 1.0f ? 1.57079633f - atan_u : atan_u;
    const float up = 0.5f / (1.0f + slope * slope);
    return {0.5f * acot - slope * up, up};
}

// Horizons as the integrals want them: below the surface nothing is visible anyway, and NaN blocks nothing.
[[nodiscard]] inline float clamped(float slope) {
    const float positive = slope > 0.0f ? slope : 0.0f;
    return positive < 1e9f ? positive : 1e9f;
}

}  // namespace lobe_detail

// Bearings of a horizon map with their shares of the full turn: half the way to either neighbor.
struct lobe_bearings {
    int count = 0;                                         // bearings; what follows has more room
    std::array<glm::dvec2, most_lobe_bearings> direction;  // unit length
    std::array<double, most_lobe_bearings> share;          // of a turn; they add up to 1
};

// Directions in any order. Errors: fewer than 3 or more than most_lobe_bearings, and two that are the same.
[[nodiscard]] inline status place(std::span<const glm::dvec2> directions, lobe_bearings& out) {
    if (directions.size() < 3) return {error::too_small, "directions", double(directions.size()), 3.0};
    if (directions.size() > std::size_t(most_lobe_bearings))
        return {error::out_of_range, "directions", double(directions.size()), double(most_lobe_bearings)};
    out.count = int(directions.size());
    std::array<double, most_lobe_bearings> turn;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        out.direction[i] = unit_direction(directions[i]);
        turn[i] = std::atan2(out.direction[i].y, out.direction[i].x) / (2.0 * std::numbers::pi);
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
        double ahead = 1.0, behind = 1.0;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (k == i) continue;
            const double gap = turn[k] - turn[i] - std::floor(turn[k] - turn[i]);
            if (gap < 1e-12 || gap > 1.0 - 1e-12) return {error::not_positive, "angle between two directions", 0.0};
            ahead = gap < ahead ? gap : ahead;
            behind = 1.0 - gap < behind ? 1.0 - gap : behind;
        }
        out.share[i] = 0.5 * (ahead + behind);
    }
    return {};
}

// The visible share of the clamped cosine around one vector, ready to be summed over bearings.
class cosine_lobe {
public:
    // axis: unit length, z above 0
    cosine_lobe(const lobe_bearings& bearings, glm::dvec3 axis) : count_(bearings.count) {
        double all = 0.0;
        std::array<double, most_lobe_bearings> whole;
        const auto exact = [](double slope) {
            const double up = 0.5 / (1.0 + slope * slope);
            return glm::dvec2(0.5 * std::atan2(1.0, slope) - slope * up, up);
        };
        for (std::size_t i = 0; i < std::size_t(count_); ++i) {
            const double across = axis.x * bearings.direction[i].x + axis.y * bearings.direction[i].y;
            const double least = across < 0.0 ? -across / axis.z : 0.0;
            const glm::dvec2 integrals = exact(least);
            whole[i] = bearings.share[i] * (across * integrals.x + axis.z * integrals.y);
            all += whole[i];
            term_[i] = {float(bearings.share[i] * across), float(bearings.share[i] * axis.z), float(least), 0.0f};
        }
        for (std::size_t i = 0; i < std::size_t(count_); ++i) {
            term_[i].across /= float(all);
            term_[i].up /= float(all);
            term_[i].whole = float(whole[i] / all);
        }
    }

    // Adds what bearing i contributes to the shares of `count` texels. slopes: tangents, at least 0; across, up: A and
    // B of them; shares: 0 to 1 when all bearings are in.
    void add(int i, const float* slopes, const float* across, const float* up, int count, float* shares) const {
        const term t = term_[std::size_t(i)];
        for (int x = 0; x < count; ++x) {
            const float cut = t.across * across[x] + t.up * up[x];
            shares[x] += slopes[x] > t.least ? cut : t.whole;
        }
    }

private:
    struct term {
        float across, up;  // weights of A and B
        float least;       // slope from which the cosine is positive
        float whole;       // contribution of a horizon that is not higher than that
    };
    int count_;
    std::array<term, most_lobe_bearings> term_;
};

}  // namespace bumpshadow
