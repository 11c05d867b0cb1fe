#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>

#include <bumpshadow/config.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// Sample types of a height map. 8 and 16 bits are normalized: their largest value stands for 1.
template <class T>
concept height_sample = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> || std::same_as<T, float> ||
    std::same_as<T, double>;

// What lies beyond the border of a height map.
enum class edge_mode : unsigned char {
    repeat,  // the map tiles
    clamp,   // the border height goes on for ever
    mirror,  // the map is reflected at its border; the border texel is repeated once
    open,    // nothing: no surface, no occluder
};

// Texels [origin, origin + extent). An empty one, the default, stands for the whole map where a function takes one.
struct rectangle {
    glm::ivec2 origin{0};  // texels
    glm::ivec2 extent{0};  // texels

    // True where it has no texels.
    [[nodiscard]] constexpr bool empty() const { return extent.x <= 0 || extent.y <= 0; }
};

// Of a height map, at the most: texels along a side, so that indices of half texels and margins are still ints.
inline constexpr int largest_side = 1 << 30;
// Texel sizes lie between 1 / largest_length and this, height scales not above it on either side of 0, so that
// quotients, squares and sums of such lengths are far from the limits of double.
inline constexpr double largest_length = 1e150;
// Samples in double are not above this on either side of 0, so that their differences are finite.
inline constexpr double largest_sample = 1e300;

// A view of heights; owns nothing.
//
// Texel (x, y) is samples[y * row_stride + x]: x along +u, y along +v, row-major. Tangent space is +x along +u,
// +y along +v (the direction of growing row number) and +z out of the surface. An image whose first row is the top
// of the picture, used with a y-up normal map, needs one flip: mirror the rows of the heights or negate the normal's y.
//
// Height of a texel = sample * height_scale - datum, in the unit of texel_size. The surface between texel centers is
// bilinear. Horizons and normals depend on differences of heights alone, which are taken before anything is rounded to
// float; the datum matters to encode/emboss.hpp, which stores heights, and to the GPU kernel, which reads floats.
template <height_sample Sample>
struct height_map {
    const Sample* samples = nullptr;     // of texel (0, 0)
    glm::ivec2 extent{0};                // texels, 1 to largest_side
    std::ptrdiff_t row_stride = 0;       // samples from one row to the next
    double height_scale = 1.0;           // units a sample; for 8 and 16 bits the height of the largest sample value;
                                         // -largest_length to largest_length
    double datum = 0.0;                  // units, subtracted from every height
    glm::dvec2 texel_size{1.0, 1.0};     // units between texel centers, 1 / largest_length to largest_length
    edge_mode edge = edge_mode::repeat;  // what lies beyond the border
    std::optional<Sample> no_data = {};  // this value (or NaN) marks a hole: it does not occlude and is never shadowed
};

// A tightly packed map of the given extent, everything else at its default.
template <height_sample Sample>
[[nodiscard]] constexpr height_map<Sample> tight_height_map(const Sample* samples, glm::ivec2 extent) {
    return {.samples = samples, .extent = extent, .row_stride = extent.x};
}

// Factor from a sample to a height, in the unit of texel_size.
template <height_sample Sample>
[[nodiscard]] constexpr double unit_height(const height_map<Sample>& heights) {
    if constexpr (std::is_integral_v<Sample>)
        return heights.height_scale / static_cast<double>((std::numeric_limits<Sample>::max)());
    else
        return heights.height_scale;
}

// Index of the texel that stands in for index i on an axis of n texels, n > 0, or -1 where there is none (open).
[[nodiscard]] constexpr std::int64_t resolve_edge(std::int64_t i, std::int64_t n, edge_mode edge) {
    if (i >= 0 && i < n) return i;
    switch (edge) {
        case edge_mode::clamp: return i < 0 ? 0 : n - 1;
        case edge_mode::repeat: {
            const std::int64_t r = i % n;
            return r < 0 ? r + n : r;
        }
        case edge_mode::mirror: {
            std::int64_t r = i % (2 * n);
            if (r < 0) r += 2 * n;
            return r < n ? r : 2 * n - 1 - r;
        }
        case edge_mode::open: break;
    }
    return -1;
}

// True where a sample marks a hole of this map.
template <height_sample Sample>
[[nodiscard]] constexpr bool is_no_data(const height_map<Sample>& heights, Sample sample) {
    if (!heights.no_data) return false;
    if constexpr (std::is_floating_point_v<Sample>)
        if (is_nan(*heights.no_data)) return is_nan(sample);
    return sample == *heights.no_data;
}

// The first texel, in row order, that is not a hole; {-1, -1} where all are. Methods that work in float subtract its
// height from all others first, so that heights far from zero keep their detail.
template <height_sample Sample>
[[nodiscard]] constexpr glm::ivec2 reference_texel(const height_map<Sample>& heights) {
    for (int y = 0; y < heights.extent.y; ++y)
        for (int x = 0; x < heights.extent.x; ++x)
            if (!is_no_data(heights, heights.samples[y * heights.row_stride + x])) return {x, y};
    return {-1, -1};
}

// Its sample; 0 where there is none.
template <height_sample Sample>
[[nodiscard]] constexpr double reference_sample(const height_map<Sample>& heights) {
    const glm::ivec2 texel = reference_texel(heights);
    return texel.x < 0 ? 0.0 : static_cast<double>(heights.samples[texel.y * heights.row_stride + texel.x]);
}

// Sample of the texel at (x, y), which has to lie inside the map.
template <height_sample Sample>
[[nodiscard]] constexpr Sample sample_at(const height_map<Sample>& heights, std::int64_t x, std::int64_t y) {
    BUMPSHADOW_ASSERT(x >= 0 && x < heights.extent.x && y >= 0 && y < heights.extent.y);
    return heights.samples[y * heights.row_stride + x];
}

// Checks extent and texel size, which are all that sizes of scratch depend on.
[[nodiscard]] inline status check_grid(glm::ivec2 extent, glm::dvec2 texel_size) {
    constexpr const char* sides[] = {"heights.extent.x", "heights.extent.y"};
    constexpr const char* sizes[] = {"texel_size.x", "texel_size.y"};
    for (glm::length_t i = 0; i < 2; ++i) {
        if (extent[i] <= 0) return {error::not_positive, sides[i], double(extent[i])};
        if (extent[i] > largest_side) return {error::out_of_range, sides[i], double(extent[i]), double(largest_side)};
    }
    for (glm::length_t i = 0; i < 2; ++i) {
        const double size = texel_size[i], least = 1.0 / largest_length;
        if (!is_finite(size)) return {error::not_finite, sizes[i], size};
        if (!(size > 0.0)) return {error::not_positive, sizes[i], size};
        if (size < least) return {error::out_of_range, sizes[i], size, least};
        if (size > largest_length) return {error::out_of_range, sizes[i], size, largest_length};
    }
    return {};
}

// Checks everything about a view that costs no pass over the samples.
template <height_sample Sample>
[[nodiscard]] status check(const height_map<Sample>& heights) {
    if (heights.samples == nullptr) return {error::missing, "heights.samples"};
    if (status s = check_grid(heights.extent, heights.texel_size); !s) return s;
    if (heights.row_stride < heights.extent.x)
        return {error::too_small, "heights.row_stride", double(heights.row_stride), double(heights.extent.x)};
    if (!is_finite(heights.height_scale)) return {error::not_finite, "height_scale", heights.height_scale};
    if (std::abs(heights.height_scale) > largest_length)
        return {error::out_of_range, "height_scale", heights.height_scale, largest_length};
    if (!is_finite(heights.datum)) return {error::not_finite, "datum", heights.datum};
    return {};
}

// Looks for the first sample, in row order, that is NaN, infinite or above largest_sample, and is not no_data.
template <height_sample Sample>
[[nodiscard]] status check_samples(const height_map<Sample>& heights) {
    if constexpr (std::is_floating_point_v<Sample>) {
        for (int y = 0; y < heights.extent.y; ++y) {
            const Sample* row = heights.samples + y * heights.row_stride;
            finite_detail::bits_of<Sample> largest = 0;
            for (int x = 0; x < heights.extent.x; ++x) {
                const auto bits = finite_detail::magnitude(row[x]);
                largest = bits > largest ? bits : largest;
            }
            constexpr Sample most =
                std::is_same_v<Sample, double> ? Sample(largest_sample) : (std::numeric_limits<Sample>::max)();
            if (largest <= finite_detail::magnitude(most)) continue;
            for (int x = 0; x < heights.extent.x; ++x) {
                if (is_no_data(heights, row[x])) continue;
                if (!is_finite(row[x])) return {error::not_finite, "height", double(row[x]), 0.0, {x, y}};
                if (std::abs(row[x]) > most)
                    return {error::out_of_range, "sample", double(row[x]), double(most), {x, y}};
            }
        }
    }
    return {};
}

}  // namespace bumpshadow
