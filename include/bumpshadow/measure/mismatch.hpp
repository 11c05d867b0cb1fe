#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/status.hpp>

// Shadows against traced truth, over a set of lights.

namespace bumpshadow {

// Elevations of a light_grid, at the most.
inline constexpr std::size_t most_elevations = 64;

// Lights far away: each elevation in each direction.
struct light_grid {
    std::span<const glm::dvec2> directions = {};  // towards the light, in tangent space, not zero, any length
    std::span<const double> elevations = {};      // degrees, above 0, at most 90; up to most_elevations of them
};

// How many answers were wrong. With count 0 all others are NaN.
struct mismatch_figures {
    std::size_t count = 0;          // answers: one light at one texel each
    double share = 0.0;             // of them that are wrong, 0 to 1: the sum of the next two
    double wrongly_lit = 0.0;       // lit where the truth is shadow
    double wrongly_shadowed = 0.0;  // the reverse
    double interval = 0.0;          // half width of the 95 % confidence interval of `share`; infinite for one texel
};

namespace measure_detail {

// Counts of one figure, a texel at a time.
struct mismatch_counts {
    std::size_t texels = 0, answers = 0, lit = 0, shadowed = 0;
    double squares = 0.0;  // of the wrong answers of a texel

    void add(std::size_t of, std::size_t wrongly_lit, std::size_t wrongly_shadowed) {
        ++texels;
        answers += of;
        lit += wrongly_lit;
        shadowed += wrongly_shadowed;
        const double wrong = double(wrongly_lit + wrongly_shadowed);
        squares += wrong * wrong;
    }
    [[nodiscard]] mismatch_figures figures() const {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        if (answers == 0) return {0, nan, nan, nan, nan};
        const double count = double(answers), n = double(texels), wrong = double(lit + shadowed);
        mismatch_figures result{answers, wrong / count, double(lit) / count, double(shadowed) / count, 0.0};
        // Whole numbers, so that nothing cancels that is not exact.
        const double deviations = (n * squares - wrong * wrong) / n;
        result.interval = texels < 2 ? std::numeric_limits<double>::infinity()
                                     : standard_errors_95(n - 1.0) * std::sqrt(n / (n - 1.0) * deviations) / count;
        return result;
    }
};

[[nodiscard]] inline status check(const light_grid& lights) {
    if (lights.directions.empty()) return {error::missing, "lights.directions"};
    if (lights.elevations.empty()) return {error::missing, "lights.elevations"};
    if (lights.elevations.size() > most_elevations)
        return {error::out_of_range, "lights.elevations", double(lights.elevations.size()), double(most_elevations)};
    for (const glm::dvec2& d : lights.directions) {
        const double length = std::hypot(d.x, d.y);
        if (!is_finite(length)) return {error::not_finite, "length of a light's direction", length};
        if (!(length > 0.0)) return {error::not_positive, "length of a light's direction", length};
    }
    for (const double e : lights.elevations)
        if (!(e > 0.0 && e <= 90.0)) return {error::out_of_range, "elevation of a light", e, 90.0};
    return {};
}

}  // namespace measure_detail

// Share of wrong answers, lit or in shadow, of a shadow factor against exact horizons.
//   texels        of the sample, at least one
//   exact         slopes [direction][texel], from sample_horizons in the lights' directions
//   factor        (glm::ivec2 texel, glm::vec3 light) -> number, light of unit length: below 0.5 is shadow
//   result        over all lights; the interval is that of figures_of with the wrong answers of a texel as its sum
//   by_elevation  the same for each of lights.elevations, or empty
// The truth is shadow where the light's slope is below the exact one. Texels with no horizon in any direction are
// holes, left out and not counted. Where nothing at all was wrong the interval is 0; the share is then below 3 / texels
// with 95 % confidence, if a wrong texel is wrong for all lights (Hanley and Lippman-Hand 1983).
// Errors: sizes; no texels; directions of no length, elevations outside (0, 90], more than most_elevations. Then
// nothing is written.
template <class Factor>
[[nodiscard]] status shadow_mismatch(std::span<const glm::ivec2> texels, const light_grid& lights,
                                     std::span<const float> exact, Factor&& factor, mismatch_figures& result,
                                     std::span<mismatch_figures> by_elevation = {}) {
    using namespace measure_detail;
    if (texels.empty()) return {error::missing, "texels"};
    if (status s = measure_detail::check(lights); !s) return s;
    const std::size_t count = texels.size(), directions = lights.directions.size(), levels = lights.elevations.size();
    if (exact.size() != count * directions)
        return {error::mismatch, "exact size", double(exact.size()), double(count) * double(directions)};
    if (!by_elevation.empty() && by_elevation.size() != levels)
        return {error::mismatch, "by_elevation size", double(by_elevation.size()), double(levels)};

    double sines[most_elevations], cosines[most_elevations], slopes[most_elevations];
    for (std::size_t e = 0; e < levels; ++e) {
        const double angle = lights.elevations[e] * (std::numbers::pi / 180.0);
        sines[e] = std::sin(angle), cosines[e] = std::cos(angle), slopes[e] = std::tan(angle);
    }
    mismatch_counts all, each[most_elevations];
    for (std::size_t t = 0; t < count; ++t) {
        if (is_hole(directions, [&](std::size_t d) { return exact[d * count + t]; })) continue;
        std::size_t lit[most_elevations] = {}, shadowed[most_elevations] = {};
        for (std::size_t d = 0; d < directions; ++d) {
            const double horizon = double(exact[d * count + t]);
            const glm::dvec2 way = lights.directions[d], toward = way / std::hypot(way.x, way.y);
            for (std::size_t e = 0; e < levels; ++e) {
                const glm::vec3 light(toward.x * cosines[e], toward.y * cosines[e], sines[e]);
                const bool truth = slopes[e] < horizon, found = double(factor(texels[t], light)) < 0.5;
                lit[e] += truth && !found ? 1u : 0u;
                shadowed[e] += found && !truth ? 1u : 0u;
            }
        }
        std::size_t all_lit = 0, all_shadowed = 0;
        for (std::size_t e = 0; e < levels; ++e) {
            each[e].add(directions, lit[e], shadowed[e]);
            all_lit += lit[e], all_shadowed += shadowed[e];
        }
        all.add(directions * levels, all_lit, all_shadowed);
    }
    result = all.figures();
    for (std::size_t e = 0; e < by_elevation.size(); ++e) by_elevation[e] = each[e].figures();
    return {};
}

// The same for an encoding as a GPU shows it: its textures are read at the centers of the map's texels, by the snippets
// and the sampler of reference/shadow.hpp, with a hard edge.
//   extent  of the map that `texels` are in; the textures may be smaller
// Errors: besides those above, textures that do not have the layout of the encoding, texels outside the map.
template <class Encoding, class Textures>
[[nodiscard]] status shadow_mismatch(std::span<const glm::ivec2> texels, const light_grid& lights,
                                     std::span<const float> exact, const Encoding& encoding, const Textures& textures,
                                     const sampler& how, glm::ivec2 extent, mismatch_figures& result,
                                     std::span<mismatch_figures> by_elevation = {}) {
    const encoded_shadow<Encoding, Textures> shadow{encoding, textures, how};
    static_assert(!encoded_shadow<Encoding, Textures>::shades, "brightness has no shadow to compare");
    if (status s = shadow.check(); !s) return s;
    if (status s = measure_detail::check_texels(texels, extent); !s) return s;
    const auto factor = [&](glm::ivec2 texel, glm::vec3 light) {
        return shadow((glm::vec2(texel) + 0.5f) / glm::vec2(extent), light);
    };
    return shadow_mismatch(texels, lights, exact, factor, result, by_elevation);
}

}  // namespace bumpshadow
