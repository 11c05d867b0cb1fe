#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/simd.hpp>

// The filters of flip.hpp, one axis at a time. A Gaussian is the product of itself along x and along y, and so is its
// derivative along one axis; a sum of two Gaussians takes two pairs of passes. The weights are those of the filters
// over the square of 2 radius + 1 pixels, each normalized to a sum of 1, or to 1 and -1 where they have both signs.

namespace bumpshadow::flip_detail {

inline constexpr int most_radius = 72;

struct filter {
    int radius = 0;
    float weights[2 * most_radius + 1] = {};  // from -radius on

    [[nodiscard]] double sum() const {
        double total = 0.0;
        for (int i = 0; i <= 2 * radius; ++i) total += double(weights[i]);
        return total;
    }
};

// value(i) for i from -radius to radius, brought to sums of 1 and -1 and times `scale`. What is left out at the ends is
// smaller than floats can add.
template <class Value>
[[nodiscard]] filter make_filter(int radius, const Value& value, double scale = 1.0) {
    double above = 0.0, below = 0.0, largest = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        const double v = value(i);
        (v < 0.0 ? below : above) += std::abs(v);
        largest = (std::max)(largest, std::abs(v));
    }
    filter result;
    result.radius = radius;
    while (result.radius > 1 && std::abs(value(result.radius)) < 1e-10 * largest) --result.radius;
    for (int i = -result.radius; i <= result.radius; ++i) {
        const double v = value(i);
        result.weights[i + result.radius] = static_cast<float>(scale * v / (v < 0.0 ? below : above));
    }
    return result;
}

// Filters for a number of pixels a degree of visual angle.
struct filters {
    // The paper's color pipeline: contrast sensitivity (after Johnson and Fairchild 2003) of luminance, red-green and,
    // in two parts, blue-yellow.
    filter luminance, red_green, blue_yellow[2];
    // Blue-yellow along the other axis, with the part's share of the sum.
    filter blue_yellow_share[2];
    // Its feature pipeline: the Gaussian of edge detection, its first and its second derivative.
    filter smooth, edge, point;
    int radius = 0;  // no filter has a larger one

    explicit filters(double pixels_per_degree) {
        constexpr double pi = std::numbers::pi;
        // a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees.
        struct gaussian {
            double a, b;
        };
        constexpr gaussian achromatic{1.0, 0.0047}, red_greens{1.0, 0.0053},
            blue_yellows[2]{{34.1, 0.04}, {13.5, 0.025}};
        const int spatial = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * pixels_per_degree));
        const auto curve = [&](const gaussian& g) {
            return [b = g.b, pixels_per_degree](int i) {
                const double d = double(i) / pixels_per_degree;
                return std::exp(-pi * pi * d * d / b);
            };
        };
        luminance = make_filter(spatial, curve(achromatic));
        red_green = make_filter(spatial, curve(red_greens));
        double volumes[2];
        for (int part = 0; part < 2; ++part) {
            const gaussian& g = blue_yellows[part];
            const auto value = curve(g);
            double along = 0.0;
            for (int i = -spatial; i <= spatial; ++i) along += value(i);
            volumes[part] = g.a * std::sqrt(pi / g.b) * along * along;
        }
        for (int part = 0; part < 2; ++part) {
            const auto value = curve(blue_yellows[part]);
            blue_yellow[part] = make_filter(spatial, value);
            blue_yellow_share[part] = make_filter(spatial, value, volumes[part] / (volumes[0] + volumes[1]));
        }

        // An edge is seen best where it is 0.082 degrees wide, from trough to peak: two standard deviations.
        const double deviation = 0.5 * 0.082 * pixels_per_degree;
        const int around = int(std::ceil(3.0 * deviation));
        const auto bell = [&](int i) { return std::exp(-0.5 * double(i * i) / (deviation * deviation)); };
        smooth = make_filter(around, bell);
        edge = make_filter(around, [&](int i) { return -double(i) * bell(i); });
        point = make_filter(around, [&](int i) { return (double(i * i) / (deviation * deviation) - 1.0) * bell(i); });
        radius = (std::max)(spatial, around);
    }
};

// Values that filtered() works on at a time: rows have to be as long as a multiple of it.
inline constexpr int group = 4 * simd::width;

// to[x] = sum over i of weights[i] * from[x + (i - radius) * step] for x from 0 to count - 1, which is a multiple of
// `group`; plus to[x] where Add. step: 1 along a row, or from one row to the next.
// Not inlined, or compilers would fuse products and sums in one place and not in another: both pictures have to go
// through the same instructions.
template <bool Add = false>
[[gnu::noinline]] void filtered(const float* from, std::ptrdiff_t step, const filter& f, float* to, int count) {
    const float* const first = from - f.radius * step;
    const int taps = 2 * f.radius + 1;
    // Four sums at a time, since each waits for its last addition.
    for (int x = 0; x < count; x += group) {
        const float* at = first + x;
        simd::pack sums[4];
        for (int k = 0; k < 4; ++k) sums[k] = Add ? simd::load(to + x + k * simd::width) : simd::splat(0.0f);
        for (int i = 0; i < taps; ++i, at += step) {
            const simd::pack weight = simd::splat(f.weights[i]);
            for (int k = 0; k < 4; ++k) sums[k] = simd::multiply_add(weight, simd::load(at + k * simd::width), sums[k]);
        }
        for (int k = 0; k < 4; ++k) simd::store(to + x + k * simd::width, sums[k]);
    }
}

}  // namespace bumpshadow::flip_detail
