#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/relief.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

// Lengyel's horizons: every higher texel within a radius raises those of 32 directions that lie within its angular
// size, and each stored direction is the average of the five nearest.
//
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.2.

namespace bumpshadow {

inline constexpr int neighborhood_radius = 16;      // texels, where bake_options names no radius
inline constexpr int neighborhood_directions = 32;  // direction n has bearing n / 32
inline constexpr int neighborhood_average = 5;      // neighboring directions that make one output
inline constexpr int largest_neighborhood = 1024;   // texels

namespace neighborhood_detail {

// Texels that are worked on at a time, so that their 32 sines stay in the nearest cache.
inline constexpr int chunk = 64;
inline constexpr int rows_per_item = 8;
// Height of what does not occlude: holes, and what lies beyond an open border.
inline constexpr float absent = std::numeric_limits<float>::lowest();

// A texel of the neighborhood.
struct tap {
    std::ptrdiff_t offset;  // in the plane, from the central texel
    float inverse;          // of its distance, in lengths of the smaller texel side
};

struct neighborhood {
    glm::dvec2 texel_size;
    double radius;  // infinite: neighborhood_radius texels
    glm::ivec2 reach;

    neighborhood(glm::dvec2 size, double limit) : texel_size(size), radius(limit) {
        // What is above the largest is an error, and must not overflow before that is found.
        const auto texels = [&](double spacing) {
            const double count = is_infinite(radius) ? double(neighborhood_radius) : radius / spacing;
            return count <= largest_neighborhood ? int((std::max)(count, 0.0)) : largest_neighborhood + 1;
        };
        reach = {texels(size.x), texels(size.y)};
    }

    [[nodiscard]] bool contains(int x, int y) const {
        if (x == 0 && y == 0) return false;
        if (is_infinite(radius)) return x * x + y * y <= neighborhood_radius * neighborhood_radius;
        return std::hypot(x * texel_size.x, y * texel_size.y) <= radius;
    }

    // Calls visit(direction, x, y, distance) for every texel and each direction that it affects: those which pass the
    // texel's center by no more than half its diagonal at that distance.
    template <class Visit>
    void marks(const Visit& visit) const {
        constexpr double turn = 2.0 * std::numbers::pi;
        const double half_diagonal = 0.5 * std::hypot(texel_size.x, texel_size.y);
        for (int y = -reach.y; y <= reach.y; ++y)
            for (int x = -reach.x; x <= reach.x; ++x) {
                if (!contains(x, y)) continue;
                const glm::dvec2 way(x * texel_size.x, y * texel_size.y);
                const double distance = std::hypot(way.x, way.y);
                const double center = neighborhood_directions * exact_bearing(way);
                const double half = neighborhood_directions / turn * std::atan(half_diagonal / distance);
                const int first = int(std::ceil(center - half - 1e-9)), last = int(std::floor(center + half + 1e-9));
                for (int n = first; n <= last; ++n) visit(n & (neighborhood_directions - 1), x, y, distance);
            }
    }
};

// Heights with a margin that resolves the edge, and the taps sorted by direction.
struct tables {
    float* heights;  // of texel (0, 0), see relief.hpp
    std::ptrdiff_t stride;
    tap* taps;
    std::array<std::size_t, neighborhood_directions + 1> first;
    std::array<bool, neighborhood_directions> needed;
};

// The direction of the 32 that is nearest to another one; the next one where two are equally near.
[[nodiscard]] inline int nearest(glm::dvec2 direction) {
    return int(std::floor(neighborhood_directions * exact_bearing(direction) + 0.5)) & (neighborhood_directions - 1);
}

[[nodiscard]] inline std::ptrdiff_t stride(int width, int reach) {
    return (std::ptrdiff_t(width) + chunk - 1) / chunk * chunk + 2 * std::ptrdiff_t(reach);
}

template <height_sample Sample>
[[nodiscard]] std::size_t plane_size(const height_map<Sample>& heights, glm::ivec2 reach) {
    return std::size_t(stride(heights.extent.x, reach.x)) * (std::size_t(heights.extent.y) + 2 * std::size_t(reach.y));
}

template <height_sample Sample>
[[nodiscard]] relief_detail::height_range fill(const tables& to, const height_map<Sample>& heights, glm::ivec2 reach) {
    const double unit = relief_detail::height_in_texels(heights), reference = reference_sample(heights);
    const int width = heights.extent.x, height = heights.extent.y;
    relief_detail::height_range range;
    for (int y = 0; y < height; ++y) {
        float* const row = to.heights + y * to.stride;
        std::fill_n(row - reach.x, to.stride, absent);
        (void)relief_detail::copy_row(heights, y, reference, unit, absent, row, range);
        for (int i = 1; i <= reach.x; ++i) {
            const std::int64_t left = resolve_edge(-i, width, heights.edge);
            const std::int64_t right = resolve_edge(std::int64_t(width) - 1 + i, width, heights.edge);
            if (left >= 0) row[-i] = row[left];
            if (right >= 0) row[std::int64_t(width) - 1 + i] = row[right];
        }
    }
    for (int i = 1; i <= reach.y; ++i)
        for (const std::int64_t y : {std::int64_t(-i), std::int64_t(height) - 1 + i}) {
            const std::int64_t from = resolve_edge(y, height, heights.edge);
            float* const row = to.heights + y * to.stride - reach.x;
            if (from < 0)
                std::fill_n(row, to.stride, absent);
            else
                std::copy_n(to.heights + from * to.stride - reach.x, to.stride, row);
        }
    return range;
}

// Sines of the horizons of `chunk` texels in one direction, equations 5.1 and 5.2.
inline void sines(const float* center, std::span<const tap> taps, float* out) {
    float squared_tangent[chunk] = {};
    for (const tap& t : taps) {
        const float* const heights = center + t.offset;
        const float weight = 0.5f * t.inverse;
        for (int x = 0; x < chunk; ++x) {
            const float difference = heights[x] - center[x];
            // Twice the difference where it is positive, else 0: written so that compilers vectorize the loop.
            const float higher = difference + std::abs(difference);
            const float tangent = higher * weight, square = tangent * tangent;
            squared_tangent[x] = square > squared_tangent[x] ? square : squared_tangent[x];
        }
    }
    for (int x = 0; x < chunk; ++x) {
        // It may be infinite, or denormal, of which -ffast-math makes a root that is no number.
        const float square = squared_tangent[x] < 1e30f ? squared_tangent[x] : 1e30f;
        out[x] = square > 1e-36f ? std::sqrt(square / (1.0f + square)) : 0.0f;
    }
}

}  // namespace neighborhood_detail

// Bytes of scratch of bake_neighborhood: 4 for each texel of the map and of a margin of the radius around it; 0 where
// check_grid() refuses the map.
template <height_sample Sample>
[[nodiscard]] std::size_t neighborhood_scratch_size(const height_map<Sample>& heights,
                                                    std::span<const glm::dvec2> /*directions*/ = {},
                                                    const bake_options& options = {}) {
    if (!check_grid(heights.extent, heights.texel_size)) return 0;
    const neighborhood_detail::neighborhood around(heights.texel_size, options.radius);
    std::size_t count = 0;
    around.marks([&](int, int, int, double) { ++count; });
    scratch_layout layout;
    layout.add<float>(neighborhood_detail::plane_size(heights, around.reach));
    layout.add<neighborhood_detail::tap>(count);
    return layout.bytes();
}

// Horizons as Lengyel bakes them: of the texels within 16 texels that are higher, the largest squared tangent in 32
// directions; the sines of the five directions nearest to each output averaged.
//   directions: in surface space (units of texel_size), at least one, of any length; the paper's are the eight
//       multiples of 1/8 turn. Slice i of the output is direction i. All of them together cost little more than one.
//   out: slopes, [direction][y][x], of the region's extent: s / sqrt(1 - s^2), s the averaged sine. 0 where no texel is
//       higher, never negative, at most 1000; no_horizon at holes
//   options.radius: reach in the unit of texel_size; infinite, the default, stands for the paper's 16 texels
// A texel affects the directions that pass its center by at most half its diagonal; several where it is near.
// Errors: what check_bake() and check_samples() find, curvature or distances (not_supported), a radius above 1024
// texels, heights more than 1e35 smaller texel sides above or below reference_texel() (out_of_range), scratch. On an
// error nothing is written. The result does not depend on the executor or the region, bit for bit.
// Accuracy: a smoothed horizon of small range, which does not approach the exact one.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status bake_neighborhood(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                       const horizon_map& out, const bake_options& options = {},
                                       Executor&& execute = {}) {
    using namespace neighborhood_detail;
    if (status s = check_bake(heights, directions, out, options); !s) return s;
    if (options.curvature.x != 0.0) return {error::not_supported, "curvature.x", options.curvature.x};
    if (options.curvature.y != 0.0) return {error::not_supported, "curvature.y", options.curvature.y};
    if (!options.distances.values.empty())
        return {error::not_supported, "distances", double(options.distances.values.size())};
    const neighborhood around(heights.texel_size, options.radius);
    if ((std::max)(around.reach.x, around.reach.y) > largest_neighborhood)
        return {error::out_of_range, "radius", options.radius,
                largest_neighborhood * (std::min)(heights.texel_size.x, heights.texel_size.y)};
    if (status s = check_samples(heights); !s) return s;

    tables table{};
    around.marks([&](int n, int, int, double) { ++table.first[std::size_t(n) + 1]; });
    for (std::size_t n = 0; n < neighborhood_directions; ++n) table.first[n + 1] += table.first[n];
    scratch_block scratch;
    if (status s = scratch.allocate(options, neighborhood_scratch_size(heights, directions, options), "a neighborhood");
        !s)
        return s;
    table.stride = stride(heights.extent.x, around.reach.x);
    table.heights = scratch.carve<float>(plane_size(heights, around.reach));
    table.heights += around.reach.y * table.stride + around.reach.x;
    table.taps = scratch.carve<tap>(table.first.back());
    if (status s = relief_detail::check(fill(table, heights, around.reach)); !s) return s;
    std::array<std::size_t, neighborhood_directions> next{};
    std::copy_n(table.first.begin(), next.size(), next.begin());
    around.marks([&](int n, int x, int y, double distance) {
        const double inverse = relief_detail::smaller_side(heights.texel_size) / distance;
        table.taps[next[std::size_t(n)]++] = {y * table.stride + x, float(inverse)};
    });
    constexpr int side = neighborhood_average / 2;
    for (const glm::dvec2& d : directions)
        for (int n = nearest(d) - side; n <= nearest(d) + side; ++n)
            table.needed[std::size_t(n & (neighborhood_directions - 1))] = true;

    const rectangle region = region_or_all(options.region, heights.extent);
    const std::size_t bands = std::size_t((region.extent.y + rows_per_item - 1) / rows_per_item);
    execute(bands, [&](std::size_t band) {
        const int begin = int(band) * rows_per_item, end = (std::min)(begin + rows_per_item, region.extent.y);
        for (int y = begin; y < end; ++y)
            for (int x0 = 0; x0 < heights.extent.x; x0 += chunk) {
                const int left = (std::max)(x0, region.origin.x);
                const int right = (std::min)(x0 + chunk, region.origin.x + region.extent.x);
                if (left >= right) continue;
                const float* const center = table.heights + (region.origin.y + y) * table.stride + x0;
                float sine[neighborhood_directions][chunk];
                for (std::size_t n = 0; n < neighborhood_directions; ++n)
                    if (table.needed[n])
                        sines(center, {table.taps + table.first[n], table.first[n + 1] - table.first[n]}, sine[n]);
                for (std::size_t i = 0; i < directions.size(); ++i) {
                    const int middle = nearest(directions[i]);
                    float* const row = out.row(int(i), y) - region.origin.x;
                    for (int x = left; x < right; ++x) {
                        float sum = 0.0f;
                        for (int n = middle - side; n <= middle + side; ++n)
                            sum += sine[n & (neighborhood_directions - 1)][x - x0];
                        const float s = sum / float(neighborhood_average);
                        const float squared_cosine = (std::max)((1.0f - s) * (1.0f + s), 1e-6f);
                        row[x] = center[x - x0] == absent ? no_horizon : s / std::sqrt(squared_cosine);
                    }
                }
            }
    });
    return {};
}

}  // namespace bumpshadow
