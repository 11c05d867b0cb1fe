#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

namespace measure_detail {

// Elevation of a slope in radians: straight down for no_horizon, and for NaN.
[[nodiscard]] inline double elevation_angle(float slope) {
    return is_nan(slope) ? -0.5 * std::numbers::pi : std::atan(double(slope));
}

// True where no direction of a texel has a horizon: a hole. slope(bearing)
template <class Slope>
[[nodiscard]] bool is_hole(std::size_t bearings, const Slope& slope) {
    for (std::size_t b = 0; b < bearings; ++b)
        if (const float s = slope(b); !is_nan(s) && s > no_horizon) return false;
    return true;
}

// found(bearing, texel)
template <class Found>
[[nodiscard]] status elevation_error(const Found& found, std::size_t texels, std::size_t bearings,
                                     std::span<const float> exact, error_figures& result,
                                     const measure_options& options) {
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    const std::size_t count = texels * bearings;
    scratch_block scratch;
    if (status s = scratch.allocate(where, scratch_layout().add<double>(count).bytes(), "errors of elevations"); !s)
        return s;
    const std::span<double> errors(scratch.carve<double>(count), count);
    for (std::size_t t = 0; t < texels; ++t) {
        const bool left_out = is_hole(bearings, [&](std::size_t b) { return exact[b * texels + t]; }) &&
                              is_hole(bearings, [&](std::size_t b) { return found(b, t); });
        for (std::size_t b = 0; b < bearings; ++b) {
            // Subtracted before anything else: equal slopes have to give 0, fused or not.
            const double difference = elevation_angle(found(b, t)) - elevation_angle(exact[b * texels + t]);
            errors[t * bearings + b] =
                left_out ? std::numeric_limits<double>::quiet_NaN() : difference * (180.0 / std::numbers::pi);
        }
    }
    result = figures_of(errors, bearings);
    return {};
}

}  // namespace measure_detail

// Bytes of scratch that elevation_error takes.
[[nodiscard]] constexpr std::size_t elevation_scratch_size(std::size_t texels, std::size_t bearings) {
    return scratch_layout().add<double>(texels, bearings).bytes();
}

// Error of baked horizons against exact ones at some texels, as angles of elevation, in degrees.
//   found   slopes of the whole map; only read
//   texels  of the map, from sample_texels for instance
//   exact   [bearing][texel], from sample_horizons in the directions of `found`
//   result  texels are what was drawn: the bearings of one are taken together, see figures_of
// no_horizon, and NaN, stand for -90 degrees: where one side has a horizon and the other has none, the angle between
// counts in full. Texels that have none in any bearing on both sides are holes, left out and not counted.
// Errors: sizes; no texels, texels outside the map; scratch. Then `result` stays as it was.
[[nodiscard]] inline status elevation_error(const horizon_map& found, std::span<const glm::ivec2> texels,
                                            std::span<const float> exact, error_figures& result,
                                            const measure_options& options = {}) {
    if (status s = check_horizons(found); !s) return s;
    if (status s = measure_detail::check_texels(texels, found.extent); !s) return s;
    const auto bearings = std::size_t(found.bearings);
    if (exact.size() != texels.size() * bearings)
        return {error::mismatch, "exact size", double(exact.size()), double(texels.size()) * double(bearings)};
    const auto at = [&](std::size_t b, std::size_t t) { return found.row(int(b), texels[t].y)[texels[t].x]; };
    return measure_detail::elevation_error(at, texels.size(), bearings, exact, result, options);
}

// The same for slopes that were found at the sample's texels alone, [bearing][texel] as `exact`.
[[nodiscard]] inline status elevation_error(std::span<const float> found, std::size_t texels,
                                            std::span<const float> exact, error_figures& result,
                                            const measure_options& options = {}) {
    if (texels == 0 || exact.empty()) return {error::missing, "texels"};
    if (exact.size() % texels != 0) return {error::not_a_multiple, "exact size", double(exact.size()), double(texels)};
    if (found.size() != exact.size())
        return {error::mismatch, "found size", double(found.size()), double(exact.size())};
    const auto at = [&](std::size_t b, std::size_t t) { return found[b * texels + t]; };
    return measure_detail::elevation_error(at, texels, exact.size() / texels, exact, result, options);
}

}  // namespace bumpshadow
