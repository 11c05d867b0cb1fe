#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// How far a picture is from another, over all pixels and their color channels.
struct image_figures {
    double rmse = 0.0;     // root of the mean square difference: 8-bit levels, or the unit of the floats
    double psnr = 0.0;     // 20 log10(peak / rmse), decibels; infinite where the pictures are equal
    double largest = 0.0;  // difference, in the unit of rmse
};

namespace measure_detail {

// Differences a channel at a time.
struct difference_sum {
    double squares = 0.0, largest = 0.0, count = 0.0;

    void add(double difference) {
        squares += difference * difference;
        largest = (std::max)(largest, std::abs(difference));
        count += 1.0;
    }
    [[nodiscard]] image_figures figures(double peak) const {
        const double rmse = std::sqrt(squares / count);
        return {rmse, rmse > 0.0 ? 20.0 * std::log10(peak / rmse) : std::numeric_limits<double>::infinity(), largest};
    }
};

}  // namespace measure_detail

// Two pictures of the same extent, 8 bits a channel, peak 255. The color channels that both have are compared: a fourth
// one is not, nor the second one of two.
// Errors: sizes. Then `figures` stays as it was.
[[nodiscard]] inline status image_error(const const_pixels& truth, const const_pixels& result, image_figures& figures) {
    if (status s = check(truth, truth.extent, 1); !s) return s;
    if (status s = check(result, truth.extent, 1); !s) return s;
    const auto colors = [](int channels) { return channels >= 3 ? 3 : 1; };
    if (colors(truth.channels) != colors(result.channels))
        return {error::mismatch, "picture channels", double(result.channels), double(truth.channels)};
    measure_detail::difference_sum sum;
    for (int y = 0; y < truth.extent.y; ++y)
        for (int x = 0; x < truth.extent.x; ++x)
            for (int c = 0; c < colors(truth.channels); ++c)
                sum.add(double(std::to_integer<int>(result.at(x, y)[c]) - std::to_integer<int>(truth.at(x, y)[c])));
    figures = sum.figures(255.0);
    return {};
}

// Two pictures in floats.
//   peak  the value that psnr is for: 1 for linear light up to white
// Errors: sizes; a value that is not finite, with its place; a peak that is not positive.
[[nodiscard]] inline status image_error(const rgb_image& truth, const rgb_image& result, image_figures& figures,
                                        double peak = 1.0) {
    if (status s = check(truth); !s) return s;
    if (status s = check(result); !s) return s;
    if (result.extent.x != truth.extent.x)
        return {error::mismatch, "image extent.x", double(result.extent.x), double(truth.extent.x)};
    if (result.extent.y != truth.extent.y)
        return {error::mismatch, "image extent.y", double(result.extent.y), double(truth.extent.y)};
    if (!(peak > 0.0)) return {error::not_positive, "peak", peak};
    measure_detail::difference_sum sum;
    for (int y = 0; y < truth.extent.y; ++y) {
        const float *a = truth.row(y), *b = result.row(y);
        for (int i = 0; i < 3 * truth.extent.x; ++i) {
            const double difference = double(b[i]) - double(a[i]);
            if (!is_finite(difference))
                return {error::not_finite, "image", is_finite(a[i]) ? double(b[i]) : double(a[i]), 0.0, {i / 3, y}};
            sum.add(difference);
        }
    }
    figures = sum.figures(peak);
    return {};
}

// Two lists of values of any meaning, for example shadow factors.
[[nodiscard]] inline status image_error(std::span<const float> truth, std::span<const float> result,
                                        image_figures& figures, double peak = 1.0) {
    if (truth.empty()) return {error::missing, "truth"};
    if (result.size() != truth.size())
        return {error::mismatch, "result size", double(result.size()), double(truth.size())};
    if (!(peak > 0.0)) return {error::not_positive, "peak", peak};
    measure_detail::difference_sum sum;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = double(result[i]) - double(truth[i]);
        if (!is_finite(difference))
            return {error::not_finite, "image", is_finite(truth[i]) ? double(result[i]) : double(truth[i])};
        sum.add(difference);
    }
    figures = sum.figures(peak);
    return {};
}

}  // namespace bumpshadow
