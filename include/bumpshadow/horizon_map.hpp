#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <span>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// Slope of a horizon where nothing occludes: a hole of the map, or a direction that leads straight out of an open one.
// Finite, so that filtering such a texel cannot make a NaN; every light is above it.
inline constexpr float no_horizon = std::numeric_limits<float>::lowest();

// A view of floats laid out [bearing][y][x], which is how a volume texture is uploaded; owns nothing.
// As a horizon map it holds slopes: tangents of the horizon's elevation, signed, one slice a direction. The same view
// holds the distances of the occluders. Strides are in floats; 0 means tightly packed.
struct horizon_map {
    std::span<float> values = {};  // from texel (0, 0) of slice 0 on
    glm::ivec2 extent{0};          // texels
    int bearings = 0;              // slices
    std::size_t row_stride = 0;    // floats from one row to the next
    std::size_t slice_stride = 0;  // floats from one slice to the next

    // row_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t row_step() const {
        return row_stride != 0 ? row_stride : std::size_t(extent.x);
    }
    // slice_stride, or what it is where tightly packed.
    [[nodiscard]] constexpr std::size_t slice_step() const {
        return slice_stride != 0 ? slice_stride : row_step() * std::size_t(extent.y);
    }
    // Row y of a slice.
    [[nodiscard]] constexpr float* row(int bearing, int y) const {
        return values.data() + std::size_t(bearing) * slice_step() + std::size_t(y) * row_step();
    }
    // Floats of a slice that count: from its first one to the last one of its last row.
    [[nodiscard]] constexpr std::size_t slice_size() const {
        return saturated_sum(saturated_product(std::size_t(extent.y) - 1, row_step()), std::size_t(extent.x));
    }
    // Floats that `values` has to have; the largest std::size_t where they are more than it counts.
    [[nodiscard]] constexpr std::size_t required_size() const {
        const std::size_t step =
            slice_stride != 0 ? slice_stride : saturated_product(row_step(), std::size_t(extent.y));
        return saturated_sum(saturated_product(std::size_t(bearings) - 1, step), slice_size());
    }
};

// Floats of a tightly packed horizon map; the largest std::size_t where they are more than it counts.
[[nodiscard]] constexpr std::size_t required_size(glm::ivec2 extent, int bearings) {
    return saturated_product(saturated_product(std::size_t(extent.x), std::size_t(extent.y)), std::size_t(bearings));
}

// Of bake_options::steps, at the most.
inline constexpr int most_steps = 65536;

// What every method that bakes horizons takes besides heights, directions and output.
// Another compiler or machine bakes the same bits where both fuse multiplications with additions or neither does;
// otherwise elevations differ by up to 0.0002 degrees, those of sweep by 0.00001 (the demo's wall, 16 bearings).
struct bake_options {
    // Cascade: how far texels are looked at one by one, 7/12 as far from 32 on, where what follows is looked at finely;
    // 1 to most_steps. Error falls and cost grows with it. Other methods ignore it.
    int steps = 12;
    // Occluders farther than this are left out, in the unit of texel_size.
    double radius = std::numeric_limits<double>::infinity();
    // Principal curvatures of the base surface along x and y, in 1/unit. Along a bearing the base falls away by
    // (x cos^2 + y sin^2) t^2 / 2. Negative ones (a hollow base, which rises for ever) need a finite radius, at which
    // the base's slope has to be one that a float can hold.
    glm::dvec2 curvature{0.0, 0.0};
    // Texels to bake; the output has this extent. Empty: the whole map.
    rectangle region = {};
    // Where distances to the occluders go, in the unit of texel_size; 0 where the surface at the texel itself is the
    // horizon (or nearer than a float holds), infinity where the horizon is absent, infinitely far or farther than a
    // float holds. Extent and bearings as the slopes. Optional.
    horizon_map distances = {};
    // Where scratch memory comes from: this span if it is not empty (see the method's scratch size), else the resource.
    std::span<std::byte> scratch = {};
    std::pmr::memory_resource* memory = nullptr;  // null: std::pmr::get_default_resource()
};

// Curvature of the base surface along a unit direction, in 1/unit: kx cos^2 + ky sin^2.
[[nodiscard]] constexpr double curvature_along(glm::dvec2 curvature, glm::dvec2 unit_direction) {
    return curvature.x * unit_direction.x * unit_direction.x + curvature.y * unit_direction.y * unit_direction.y;
}

// True where the horizon of a map in itself is never negative: the surface goes on for ever and its base is flat, so
// that the slope to far points tends to 0.
[[nodiscard]] constexpr bool horizon_is_never_negative(edge_mode edge, double radius, double curvature) {
    return edge != edge_mode::open && is_infinite(radius) && curvature == 0.0;
}

// The region of an option, with "empty" replaced by the whole map.
[[nodiscard]] constexpr rectangle region_or_all(rectangle region, glm::ivec2 extent) {
    return region.empty() ? rectangle{glm::ivec2(0), extent} : region;
}

// Checks a view that slopes or distances are written to.
[[nodiscard]] inline status check_output(const horizon_map& out, glm::ivec2 extent, std::size_t bearings) {
    if (out.extent.x != extent.x) return {error::mismatch, "output extent.x", double(out.extent.x), double(extent.x)};
    if (out.extent.y != extent.y) return {error::mismatch, "output extent.y", double(out.extent.y), double(extent.y)};
    if (out.bearings <= 0 || std::size_t(out.bearings) != bearings)
        return {error::mismatch, "output bearings", double(out.bearings), double(bearings)};
    if (out.row_step() < std::size_t(extent.x))
        return {error::too_small, "output row_stride", double(out.row_step()), double(extent.x)};
    if (out.bearings > 1 && out.slice_step() < out.slice_size())
        return {error::too_small, "output slice_stride", double(out.slice_step()), double(out.slice_size())};
    if (out.values.size() < out.required_size())
        return {error::too_small, "output size", double(out.values.size()), double(out.required_size())};
    return {};
}

// Checks what is to be baked, but for the region.
template <height_sample Sample>
[[nodiscard]] status check_request(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                   const bake_options& options) {
    if (status s = check(heights); !s) return s;
    if (directions.empty()) return {error::not_positive, "bearings", 0.0};
    if (options.steps <= 0) return {error::not_positive, "steps", double(options.steps)};
    if (options.steps > most_steps) return {error::out_of_range, "steps", double(options.steps), double(most_steps)};
    if (!(options.radius > 0.0)) return {error::not_positive, "radius", options.radius};
    if (!is_finite(options.curvature.x)) return {error::not_finite, "curvature.x", options.curvature.x};
    if (!is_finite(options.curvature.y)) return {error::not_finite, "curvature.y", options.curvature.y};
    if (is_finite(options.radius)) {
        const double least = -double((std::numeric_limits<float>::max)()) / options.radius;
        if (options.curvature.x < least) return {error::out_of_range, "curvature.x", options.curvature.x, least};
        if (options.curvature.y < least) return {error::out_of_range, "curvature.y", options.curvature.y, least};
    }
    for (const glm::dvec2& d : directions) {
        if (!is_finite(d.x) || !is_finite(d.y)) return {error::not_finite, "direction", is_finite(d.x) ? d.y : d.x};
        if (d.x == 0.0 && d.y == 0.0) return {error::not_positive, "length of a direction", 0.0};
        const glm::dvec2 scaled =
            d / (std::max)(std::abs(d.x), std::abs(d.y));  // or its square could over- or underflow
        if (is_infinite(options.radius) && curvature_along(options.curvature, scaled) < 0.0)
            return {error::out_of_range, "curvature (negative needs a finite radius)",
                    options.curvature.x < 0.0 ? options.curvature.x : options.curvature.y, 0.0};
    }
    return {};
}

// Checks what all methods have in common; costs nothing that grows with the map.
template <height_sample Sample>
[[nodiscard]] status check_bake(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                const horizon_map& out, const bake_options& options) {
    if (status s = check_request(heights, directions, options); !s) return s;
    const glm::ivec2 origin = options.region.origin, size = options.region.extent;
    if (!options.region.empty()) {
        if (origin.x < 0 || origin.x > heights.extent.x - size.x)
            return {error::out_of_range, "region.origin.x", double(origin.x), double(heights.extent.x - size.x)};
        if (origin.y < 0 || origin.y > heights.extent.y - size.y)
            return {error::out_of_range, "region.origin.y", double(origin.y), double(heights.extent.y - size.y)};
    }
    const glm::ivec2 extent = region_or_all(options.region, heights.extent).extent;
    if (status s = check_output(out, extent, directions.size()); !s) return s;
    if (!options.distances.values.empty())
        if (status s = check_output(options.distances, extent, directions.size()); !s) return s;
    return {};
}

}  // namespace bumpshadow
