#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// How far an embossed height map may be shifted: undershifting hides gentle slopes, overshifting ruins sharp ones
// ("Ups and Downs" of Bump Mapping with DirectX 6, which leaves the amount to the eye).

namespace bumpshadow {

// Shifts that show the relief of a height map, in texels.
//   largest   beyond it the shift outgrows the slopes, so that a rise looks like two images of itself: the farthest for
//             which height(p + d) - height(p) correlates with the slope at p by sqrt(1/2) or more. A straight rise b
//             texels wide gives 0.79 b, a wave of length l gives l / 4, and a sheer step 1.
//   smallest  where the relief begins to show: half of the texels that change by a step of 8 bits or more for the
//             largest shift do so.
struct emboss_shift_range {
    float smallest = 0.0f;  // texels
    float largest = 0.0f;   // texels
};

// Measures both along x and along y, up to `limit` texels and half of the map; the largest is that where nothing ends
// it. A flat map allows all shifts. heights: level 0 of what pack_emboss wrote. Errors: what the checks find.
[[nodiscard]] inline status measure_emboss_shift(const const_texture& heights, emboss_shift_range& out,
                                                 int limit = 64) {
    if (status s = emboss_detail::check_texture(heights, "texture format"); !s) return s;
    if (limit < 1) return {error::not_positive, "limit", double(limit)};
    const glm::ivec2 extent = heights.layout.extent;
    // visit(along) for all texels with `before` texels before them on an axis and `after` behind; along(i) is the
    // height i texels away. Returns how many.
    const auto visit_all = [&](int before, int after, const auto& visit) {
        const std::ptrdiff_t pitch = std::ptrdiff_t(heights.layout.row_bytes(0));
        double count = 0.0;
        for (int axis = 0; axis < 2; ++axis) {
            const glm::ivec2 first = axis == 0 ? glm::ivec2(before, 0) : glm::ivec2(0, before);
            const glm::ivec2 last = extent - (axis == 0 ? glm::ivec2(after, 0) : glm::ivec2(0, after));
            const std::ptrdiff_t step = axis == 0 ? 1 : pitch;
            for (int y = first.y; y < last.y; ++y)
                for (int x = first.x; x < last.x; ++x) {
                    const std::byte* const texel = heights.bytes.data() + y * pitch + x;
                    visit([=](int i) { return std::to_integer<int>(texel[i * step]); });
                    count += 1.0;
                }
        }
        return count;
    };
    // Share of texels that differ from the one `shift` away by `least` or more.
    const auto visible = [&](int shift, int least) {
        std::int64_t sum = 0;
        const double count =
            visit_all(0, shift, [&](auto along) { sum += std::abs(along(shift) - along(0)) >= least ? 1 : 0; });
        return count > 0.0 ? double(sum) / count : 0.0;
    };
    const int farthest = (std::max)(1, (std::min)(limit, (std::min)(extent.x, extent.y) / 2));

    // Slopes are differences over as few texels as make a root mean square of two steps: over fewer, the steps of
    // gentle slopes would pass for sharp rises.
    int reach = 1;
    for (; reach < farthest; ++reach) {
        std::int64_t square = 0;
        const double count = visit_all(reach, reach, [&](auto along) {
            const int slope = along(reach) - along(-reach);
            square += slope * slope;
        });
        if (double(square) >= 4.0 * count) break;
    }
    int largest = reach;
    for (int d = reach + 1; d <= farthest; ++d) {
        std::int64_t both = 0, shifted = 0, slopes = 0;
        visit_all(reach, d, [&](auto along) {
            const int slope = along(reach) - along(-reach), difference = along(d) - along(0);
            both += slope * difference;
            shifted += difference * difference;
            slopes += slope * slope;
        });
        if (both < 0 || double(both) * double(both) < 0.5 * double(shifted) * double(slopes)) break;
        largest = d;
    }

    out = {0.0f, float(largest)};
    const double enough = 0.5 * visible(largest, 1);
    if (enough == 0.0) return {};
    // Within a texel the difference grows linearly with the shift.
    for (int eighth = 1; eighth < 8; ++eighth)
        if (visible(1, (8 + eighth - 1) / eighth) >= enough) {
            out.smallest = float(eighth) / 8.0f;
            return {};
        }
    for (int d = 1; d <= largest; ++d)
        if (visible(d, 1) >= enough) {
            out.smallest = float(d);
            return {};
        }
    return {};
}

// A warning: out_of_range for a shift, in texels, that is outside the range. Drawing with it is well defined.
[[nodiscard]] inline status check_emboss_shift(float shift, const emboss_shift_range& range) {
    if (!is_finite(shift)) return {error::not_finite, "shift", double(shift)};
    if (shift < range.smallest)
        return {error::out_of_range, "shift (too small, hides gentle slopes)", double(shift), double(range.smallest)};
    if (shift > range.largest)
        return {error::out_of_range, "shift (too large, ruins sharp slopes)", double(shift), double(range.largest)};
    return {};
}

}  // namespace bumpshadow
