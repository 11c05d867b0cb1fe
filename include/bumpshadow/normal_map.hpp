#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// A view of unit normals in tangent space (+x along +u, +y along growing row numbers, +z out of the surface), planar:
// [component][y][x] with the components x, y, z, so that rows shade in vectors. All three are 0 at a hole of the map.
// Owns nothing. Strides are in floats; 0 means tightly packed.
struct normal_map {
    std::span<float> values = {};  // from x of texel (0, 0) on; each in [-1, 1]
    glm::ivec2 extent{0};          // texels
    std::size_t row_stride = 0;    // floats from one row to the next
    std::size_t plane_stride = 0;  // floats from one component to the next

    // row_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t row_step() const {
        return row_stride != 0 ? row_stride : std::size_t(extent.x);
    }
    // plane_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t plane_step() const {
        return plane_stride != 0 ? plane_stride : row_step() * std::size_t(extent.y);
    }
    // Row y of a component: 0 x, 1 y, 2 z.
    [[nodiscard]] constexpr float* row(int component, int y) const {
        return values.data() + std::size_t(component) * plane_step() + std::size_t(y) * row_step();
    }
    // The normal of texel (x, y).
    [[nodiscard]] glm::vec3 at(int x, int y) const { return {row(0, y)[x], row(1, y)[x], row(2, y)[x]}; }
    // Stores the normal of texel (x, y).
    void set(int x, int y, glm::vec3 normal) const {
        for (glm::length_t c = 0; c < 3; ++c) row(int(c), y)[x] = normal[c];
    }
    // Floats of a component that count: from its first one to the last one of its last row.
    [[nodiscard]] constexpr std::size_t plane_size() const {
        return saturated_sum(saturated_product(std::size_t(extent.y) - 1, row_step()), std::size_t(extent.x));
    }
    // Floats that `values` has to have, 3 width height where tightly packed; the largest std::size_t where they are
    // more than it counts.
    [[nodiscard]] constexpr std::size_t required_size() const {
        const std::size_t step =
            plane_stride != 0 ? plane_stride : saturated_product(row_step(), std::size_t(extent.y));
        return saturated_sum(saturated_product(2, step), plane_size());
    }
};

// Which way the y (green) of a stored normal points. This is the one flip between this library and y-up maps.
enum class normal_y : unsigned char {
    down,  // along growing row numbers, as in tangent space here: D3D, left-handed
    up,    // against them: GL, right-handed
};
// 1 for y down, -1 for y up: what a stored y is multiplied by to point along growing row numbers.
[[nodiscard]] constexpr float sign_of(normal_y y) { return y == normal_y::down ? 1.0f : -1.0f; }

// Checks a view of normals that is to have an extent.
[[nodiscard]] inline status check(const normal_map& normals, glm::ivec2 extent) {
    if (normals.extent.x != extent.x)
        return {error::mismatch, "normals extent.x", double(normals.extent.x), double(extent.x)};
    if (normals.extent.y != extent.y)
        return {error::mismatch, "normals extent.y", double(normals.extent.y), double(extent.y)};
    if (extent.x <= 0) return {error::not_positive, "normals extent.x", double(extent.x)};
    if (extent.y <= 0) return {error::not_positive, "normals extent.y", double(extent.y)};
    const std::size_t width = std::size_t(extent.x);
    if (normals.row_step() < width)
        return {error::too_small, "normals row_stride", double(normals.row_step()), double(width)};
    if (normals.plane_step() < normals.plane_size())
        return {error::too_small, "normals plane_stride", double(normals.plane_step()), double(normals.plane_size())};
    if (normals.values.size() < normals.required_size())
        return {error::too_small, "normals size", double(normals.values.size()), double(normals.required_size())};
    return {};
}

namespace normal_detail {

inline constexpr int band = 16;  // rows an item of an executor

// body(y) for every row, in bands.
template <executor Executor, class Body>
void for_rows(int rows, Executor&& execute, const Body& body) {
    std::forward<Executor>(execute)(std::size_t(part_count(rows, band)), [&](std::size_t item) {
        const int first = int(item) * band, last = first + (std::min)(band, rows - first);
        for (int y = first; y < last; ++y) body(y);
    });
}

// The steepest slope, so that squares stay finite.
inline constexpr double steepest = 1e150;

// Slope between two samples. The halves' difference is finite, whatever they are, and so is the slope.
template <height_sample Sample>
[[nodiscard]] inline double slope(Sample a, Sample b, double factor) {
    double slope;
    if constexpr (std::is_same_v<Sample, double>)
        slope = 2.0 * ((0.5 * a - 0.5 * b) * factor);
    else
        slope = (double(a) - double(b)) * factor;
    slope = slope < steepest ? slope : steepest;
    return slope > -steepest ? slope : -steepest;
}

// Slope at texel (x, y) along the axis (dx, dy): from one neighbor to the other; one that is missing or a hole is
// replaced by the texel itself.
template <height_sample Sample>
[[nodiscard]] double slope(const height_map<Sample>& heights, int x, int y, int dx, int dy) {
    Sample ends[2];
    int span = 0;
    for (int side = 0; side < 2; ++side) {
        const int sign = 2 * side - 1;
        const std::int64_t nx = resolve_edge(x + sign * dx, heights.extent.x, heights.edge);
        const std::int64_t ny = resolve_edge(y + sign * dy, heights.extent.y, heights.edge);
        const bool there = nx >= 0 && ny >= 0 && !is_no_data(heights, sample_at(heights, nx, ny));
        ends[side] = there ? sample_at(heights, nx, ny) : sample_at(heights, x, y);
        span += there ? 1 : 0;
    }
    if (span == 0) return 0.0;
    const double unit = unit_height(heights) / (dx != 0 ? heights.texel_size.x : heights.texel_size.y);
    return slope(ends[1], ends[0], unit / double(span));
}

[[nodiscard]] inline glm::vec3 normal(double slope_x, double slope_y) {
    const double inverse = 1.0 / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
    return {float(-slope_x * inverse), float(-slope_y * inverse), float(inverse)};
}

}  // namespace normal_detail

// Normals of a height map by central differences over the two neighbors on each axis; one-sided at an open border and
// beside a hole. out.extent: that of the map, or of `region`, of whose texels the normals then are.
// Errors: what check() finds in either view, samples that are not finite, a region outside the map.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status bake_normals(const height_map<Sample>& heights, const normal_map& out, rectangle region = {},
                                  Executor&& execute = {}) {
    if (status s = check(heights); !s) return s;
    const auto [origin, extent] = region_or_all(region, heights.extent);
    if (origin.x < 0 || origin.x > heights.extent.x - extent.x)
        return {error::out_of_range, "region.origin.x", double(origin.x), double(heights.extent.x - extent.x)};
    if (origin.y < 0 || origin.y > heights.extent.y - extent.y)
        return {error::out_of_range, "region.origin.y", double(origin.y), double(heights.extent.y - extent.y)};
    if (status s = check(out, extent); !s) return s;
    if (status s = check_samples(heights); !s) return s;

    const double half_x = 0.5 * unit_height(heights) / heights.texel_size.x;
    const double half_y = 0.5 * unit_height(heights) / heights.texel_size.y;
    const glm::ivec2 first = origin, size = extent;
    normal_detail::for_rows(size.y, execute, [&, first, size](int row) {
        const int y = first.y + row;
        const auto whole = [&](int x) {
            const bool hole = is_no_data(heights, sample_at(heights, x, y));
            out.set(x - first.x, row,
                    hole ? glm::vec3(0.0f)
                         : normal_detail::normal(normal_detail::slope(heights, x, y, 1, 0),
                                                 normal_detail::slope(heights, x, y, 0, 1)));
        };
        // Texels with both neighbors inside the row and no hole near need no questions asked.
        const std::int64_t above = resolve_edge(y - 1, heights.extent.y, heights.edge);
        const std::int64_t below = resolve_edge(y + 1, heights.extent.y, heights.edge);
        const bool plain = !heights.no_data && above >= 0 && below >= 0;
        const int left = plain ? (std::max)(first.x, 1) : first.x;
        const int right = plain ? (std::max)(left, (std::min)(first.x + size.x, heights.extent.x - 1)) : first.x;
        for (int x = first.x; x < (std::min)(left, first.x + size.x); ++x) whole(x);
        if (plain) {
            const Sample* here = heights.samples + y * heights.row_stride + first.x;
            const Sample* up = heights.samples + above * heights.row_stride + first.x;
            const Sample* down = heights.samples + below * heights.row_stride + first.x;
            float *nx = out.row(0, row), *ny = out.row(1, row), *nz = out.row(2, row);
            for (int x = left - first.x; x < right - first.x; ++x) {
                const glm::vec3 n = normal_detail::normal(normal_detail::slope(here[x + 1], here[x - 1], half_x),
                                                          normal_detail::slope(down[x], up[x], half_y));
                nx[x] = n.x;
                ny[x] = n.y;
                nz[x] = n.z;
            }
        }
        for (int x = right; x < first.x + size.x; ++x) whole(x);
    });
    return {};
}

// What the texels of a normal map hold in 8 bits.
enum class normal_form : unsigned char {
    unit,         // (normal + 1) / 2 in three channels
    derivatives,  // (dz/dx, dz/dy) / max_slope, from [-1, 1] to [0, 1], in two
};

// All that decoding needs. Flat is (128, 128, 255), as other tools write it, which is 1/255 too much in x and y: a tilt
// of 0.3 degrees (unit) or 0.3 max_slope (derivatives).
struct normal_encoding {
    normal_form form = normal_form::unit;  // what the channels hold
    normal_y y = normal_y::down;           // which way their y points
    // Derivatives: the steepest (rise over run) along an axis that is stored; beyond, clamped.
    // smallest_normal_slope to largest_normal_slope.
    float max_slope = 1.0f;
};

// The slope of a normal in the surface, over a much smaller one, would overflow.
inline constexpr float smallest_normal_slope = 1e-18f;
// The square of a much larger one would overflow.
inline constexpr float largest_normal_slope = 1e18f;

// Checks max_slope.
[[nodiscard]] inline status check(const normal_encoding& encoding) {
    const float slope = encoding.max_slope;
    const bool used = encoding.form == normal_form::derivatives;
    if (used && !(slope > 0.0f)) return {error::not_positive, "max_slope", double(slope)};
    if (!is_finite(slope)) return {error::not_finite, "max_slope", double(slope)};
    if (used && slope < smallest_normal_slope)
        return {error::out_of_range, "max_slope", double(slope), double(smallest_normal_slope)};
    if (used && slope > largest_normal_slope)
        return {error::out_of_range, "max_slope", double(slope), double(largest_normal_slope)};
    return {};
}

// Normals to bytes. Channels that the form does not need become 0, a fourth one 255; a hole gets 128 in all that it
// needs. Errors: what the checks find; unit needs 3 or 4 channels, derivatives 2 to 4.
template <executor Executor = serial>
[[nodiscard]] status encode_normals(const normal_map& normals, const normal_encoding& encoding, const pixels& out,
                                    Executor&& execute = {}) {
    const bool unit = encoding.form == normal_form::unit;
    if (status s = check(encoding); !s) return s;
    if (status s = check(normals, out.extent); !s) return s;
    if (status s = check(out, out.extent, unit ? 3 : 2); !s) return s;
    const float flip = sign_of(encoding.y), scale = 0.5f / encoding.max_slope;
    normal_detail::for_rows(out.extent.y, execute, [&](int y) {
        const float *nx = normals.row(0, y), *ny = normals.row(1, y), *nz = normals.row(2, y);
        for (int x = 0; x < out.extent.x; ++x) {
            // A normal in the surface has infinite slopes, of which only the signs are left.
            const float inverse = unit ? 0.5f : -scale / (std::max)(nz[x], 1e-20f);
            const float stored[4] = {0.5f + nx[x] * inverse, 0.5f + flip * ny[x] * inverse,
                                     unit ? 0.5f + 0.5f * nz[x] : 0.0f, 1.0f};
            std::byte* const texel = out.at(x, y);
            for (int c = 0; c < out.channels; ++c) texel[c] = std::byte(to_unorm8(stored[c]));
        }
    });
    return {};
}

// Bytes back to unit normals, through the shader's functions. (128, 128, 128), which a hole has in the unit form, gives
// straight up. Errors: as above.
template <executor Executor = serial>
[[nodiscard]] status decode_normals(const const_pixels& from, const normal_encoding& encoding, const normal_map& out,
                                    Executor&& execute = {}) {
    const bool unit = encoding.form == normal_form::unit;
    if (status s = check(encoding); !s) return s;
    if (status s = check(out, from.extent); !s) return s;
    if (status s = check(from, from.extent, unit ? 3 : 2); !s) return s;
    const float flip = sign_of(encoding.y);
    normal_detail::for_rows(from.extent.y, execute, [&](int y) {
        for (int x = 0; x < from.extent.x; ++x) {
            const std::byte* const texel = from.at(x, y);
            const auto channel = [&](int c) { return from_unorm8(std::to_integer<std::uint8_t>(texel[c])); };
            out.set(x, y,
                    unit
                        ? shader::bumpshadow_normal({channel(0), channel(1), channel(2)}, flip)
                        : shader::bumpshadow_normal_of_derivatives({channel(0), channel(1)}, encoding.max_slope, flip));
        }
    });
    return {};
}

}  // namespace bumpshadow
