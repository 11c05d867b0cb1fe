#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/relief.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

// A sample of a map's texels and their exact horizons, to judge by.

namespace bumpshadow {

namespace measure_detail {

// SplitMix64 (Steele, Lea and Flood 2014): the same numbers with every standard library.
class generator {
public:
    explicit generator(std::uint64_t seed) : state_(seed) {}

    // 0 to count - 1.
    [[nodiscard]] int below(int count) {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return int(((z >> 32) * std::uint64_t(count)) >> 32);
    }

private:
    std::uint64_t state_;
};

[[nodiscard]] inline status check_texels(std::span<const glm::ivec2> texels, glm::ivec2 extent) {
    if (texels.empty()) return {error::missing, "texels"};
    for (const glm::ivec2& t : texels) {
        if (t.x < 0 || t.x >= extent.x) return {error::out_of_range, "texels x", double(t.x), double(extent.x - 1), t};
        if (t.y < 0 || t.y >= extent.y) return {error::out_of_range, "texels y", double(t.y), double(extent.y - 1), t};
    }
    return {};
}

}  // namespace measure_detail

// Draws texels that are spread over a map: the map is cut into as many cells as texels are wanted, in rows of cells
// that are about square, and one place is drawn in each. The grid begins at a place that is drawn too, and wraps, so
// that every texel is equally likely and the mean over the sample is unbiased.
//   texels: filled, row of cells by row of cells; all distinct as long as the map has as many
// The same for the same extent, seed and number, on every platform.
// Errors: extent not positive; no texels wanted.
[[nodiscard]] inline status sample_texels(glm::ivec2 extent, std::uint32_t seed, std::span<glm::ivec2> texels) {
    if (extent.x <= 0) return {error::not_positive, "extent.x", double(extent.x)};
    if (extent.y <= 0) return {error::not_positive, "extent.y", double(extent.y)};
    if (texels.empty()) return {error::missing, "texels"};

    const auto count = std::int64_t(texels.size()), width = std::int64_t(extent.x), height = std::int64_t(extent.y);
    // Enough rows that each has at most as many cells as the map has columns, where that can be.
    const auto square = std::int64_t(std::sqrt(double(count) * double(height) / double(width)) + 0.5);
    const std::int64_t rows =
        (std::clamp)((std::max)(square, (count + width - 1) / width), std::int64_t{1}, (std::min)(height, count));
    measure_detail::generator random(seed);
    const int shift_x = random.below(extent.x), shift_y = random.below(extent.y);
    // Texel of a cell that reaches from the share first / of to next / of of an axis.
    const auto draw = [&](std::int64_t first, std::int64_t of, int length) {
        const std::int64_t begin = first * length / of, end = (first + 1) * length / of;
        return int(begin) + random.below((std::max)(int(end - begin), 1));
    };
    std::size_t next = 0;
    for (std::int64_t row = 0; row < rows; ++row) {
        const std::int64_t cells = (row + 1) * count / rows - row * count / rows;
        for (std::int64_t cell = 0; cell < cells; ++cell) {
            const int x = draw(cell, cells, extent.x), y = draw(row, rows, extent.y);
            texels[next++] = {int((std::int64_t(x) + shift_x) % width), int((std::int64_t(y) + shift_y) % height)};
        }
    }
    return {};
}

// Bytes of scratch that sample_horizons takes; 0 where check_grid() refuses the map.
template <height_sample Sample>
[[nodiscard]] std::size_t sample_scratch_size(const height_map<Sample>& heights) {
    return exact_scratch_size(heights);
}

// The exact horizons of some texels, see exact_horizon().
//   directions  in surface space, at least one, not zero, need not be of unit length
//   slopes      [direction][texel], at least as many as both numbers multiplied; no_horizon where nothing occludes,
//               holes among it
//   options     radius, curvature, scratch and memory; the rest is ignored
// Cost: a pass over the heights, then 1 to 3 microseconds a slope on real maps of 1024 x 1024 texels without a radius.
// Errors: what check_request() and check_samples() find, and relief as in bake_exact(); no texels, texels outside the
// map, too few slopes; scratch.
// Then nothing is written. The result does not depend on the executor, bit for bit.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status sample_horizons(const height_map<Sample>& heights, std::span<const glm::ivec2> texels,
                                     std::span<const glm::dvec2> directions, std::span<float> slopes,
                                     const bake_options& options = {}, Executor&& execute = {}) {
    if (status s = check_request(heights, directions, options); !s) return s;
    if (status s = measure_detail::check_texels(texels, heights.extent); !s) return s;
    const std::size_t count = texels.size();
    if (slopes.size() < count * directions.size())
        return {error::too_small, "slopes", double(slopes.size()), double(count) * double(directions.size())};
    if (status s = check_samples(heights); !s) return s;

    scratch_block scratch;
    if (status s = scratch.allocate(options, sample_scratch_size(heights), "a sample of horizons"); !s) return s;
    const std::size_t samples = height_bounds<Sample>::required_size(heights.extent);
    const height_bounds<Sample> bounds(heights, std::span<Sample>(scratch.carve<Sample>(samples), samples));
    if (status s = relief_detail::check(heights, bounds); !s) return s;

    constexpr std::size_t chunk = 64;
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::forward<Executor>(execute)(chunks * directions.size(), [&](std::size_t item) {
        const std::size_t direction = item / chunks, first = item % chunks * chunk;
        const exact_detail::rays<Sample> rays(heights, bounds, directions[direction], options.radius,
                                              options.curvature);
        for (std::size_t i = first; i < (std::min)(first + chunk, count); ++i)
            slopes[direction * count + i] = float(rays(texels[i]).slope);
    });
    return {};
}

}  // namespace bumpshadow
