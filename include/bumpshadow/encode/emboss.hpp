#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <bumpshadow/encode/mean_level.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Embossing, as hardware of 1999 draws bumps: a height map, plus its inverse shifted towards the light, times the base
// texture. A trick: no shadows, and no highlights. Source: "Ups and Downs" of Bump Mapping with DirectX 6, Gamasutra,
// June 4, 1999, page 2.

namespace bumpshadow {

// All that the textures hold: (height - lowest) * scale, clamped to [0, 0.5]; the inverse is 0.5 minus that. The byte
// of 0.5 is 128, so that a flat surface changes a base texture by at most one step of 8 bits. Heights scaled into the
// range: see scaled_emboss. Heights clamped to it: a scale of 1 / (the height that stands for 1).
struct emboss {
    double lowest = 0.0;  // height, in the unit of texel_size
    double scale = 0.5;   // 1 / unit
};
// Byte that stands for 0.5, the highest height.
inline constexpr int emboss_half = 128;

// Either of the two textures: r8.
[[nodiscard]] constexpr texture_layout layout_of(const emboss&, glm::ivec2 extent, int mips = 1) {
    return {.format = texel_format::r8, .extent = extent, .mips = mips};
}
// Texture fetches of one light, base texture apart: height and inverse.
[[nodiscard]] constexpr int fetches(const emboss&) { return 2; }

// The encoding that scales the heights of a map into 0 to 0.5; a flat map becomes 0. Errors: what check() finds,
// samples that are not finite, a height or a range of heights that a double does not hold, a range that is not 0 but
// whose inverse it does not hold.
template <height_sample Sample>
[[nodiscard]] status scaled_emboss(const height_map<Sample>& heights, emboss& out) {
    if (status s = check(heights); !s) return s;
    if (status s = check_samples(heights); !s) return s;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int y = 0; y < heights.extent.y; ++y)
        for (int x = 0; x < heights.extent.x; ++x) {
            const Sample sample = sample_at(heights, x, y);
            if (is_no_data(heights, sample)) continue;
            const double height = double(sample) * unit_height(heights) - heights.datum;
            if (!is_finite(height))
                return {error::out_of_range, "height", height, (std::numeric_limits<double>::max)(), {x, y}};
            low = (std::min)(low, height);
            high = (std::max)(high, height);
        }
    if (!(high > low)) {
        out = {is_finite(low) ? low : 0.0, 0.0};
        return {};
    }
    const double range = high - low, scale = 0.5 / range;
    if (!is_finite(range))
        return {error::out_of_range, "range of heights", range, (std::numeric_limits<double>::max)()};
    if (!is_finite(scale))
        return {error::out_of_range, "range of heights", range, 0.5 / (std::numeric_limits<double>::max)()};
    out = {low, scale};
    return {};
}

namespace emboss_detail {

[[nodiscard]] inline status check_texture(const const_texture& t, const char* what) {
    if (t.layout.format != texel_format::r8)
        return {error::mismatch, what, double(t.layout.format), double(texel_format::r8)};
    if (t.layout.kind != texture_kind::flat)
        return {error::mismatch, "texture kind", double(t.layout.kind), double(texture_kind::flat)};
    return check(t);
}

[[nodiscard]] inline int byte_at(const const_texture& t, int level, int x, int y) {
    return std::to_integer<int>(t.slice(0, level)[std::size_t(y) * t.layout.row_bytes(level) + std::size_t(x)]);
}

// The inverse height map between texels, bilinear, in steps of 8 bits. No surface counts as height 0, and so does what
// lies too far away to be a texel.
[[nodiscard]] inline float inverse_at(const const_texture& heights, edge_mode edge, glm::vec2 texel) {
    if (!(std::abs(texel.x) < 1e6f && std::abs(texel.y) < 1e6f)) return float(emboss_half);
    const float fx = std::floor(texel.x), fy = std::floor(texel.y);
    const float u = texel.x - fx, v = texel.y - fy;
    const glm::ivec2 extent = heights.layout.extent;
    const auto inverse = [&](float x, float y) {
        const std::int64_t column = resolve_edge(std::int64_t(x), extent.x, edge);
        const std::int64_t row = resolve_edge(std::int64_t(y), extent.y, edge);
        const int height = column < 0 || row < 0 ? 0 : byte_at(heights, 0, int(column), int(row));
        return float((std::max)(0, emboss_half - height));
    };
    const float above = (1.0f - u) * inverse(fx, fy) + u * inverse(fx + 1.0f, fy);
    const float below = (1.0f - u) * inverse(fx, fy + 1.0f) + u * inverse(fx + 1.0f, fy + 1.0f);
    return (1.0f - v) * above + v * below;
}

}  // namespace emboss_detail

// The height map, and the inverse one where inverse.bytes is not empty, with the mip chain of their layouts. Holes are
// stored as 0. clamped: where given, the number of texels outside the range. Errors: what the checks find, extents that
// differ, a scale that is negative or not finite.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status pack_emboss(const height_map<Sample>& heights, const emboss& encoding, const texture& out,
                                 const texture& inverse = {}, std::size_t* clamped = nullptr, Executor&& execute = {}) {
    if (status s = check(heights); !s) return s;
    if (!is_finite(encoding.lowest)) return {error::not_finite, "lowest", encoding.lowest};
    if (!is_finite(encoding.scale)) return {error::not_finite, "scale", encoding.scale};
    if (encoding.scale < 0.0) return {error::out_of_range, "scale", encoding.scale, 0.0};
    const bool both = !inverse.bytes.empty();
    for (const texture* t : {&out, &inverse}) {
        if (t == &inverse && !both) continue;
        if (status s = emboss_detail::check_texture(*t, "texture format"); !s) return s;
        if (t->layout.extent.x != heights.extent.x)
            return {error::mismatch, "texture extent.x", double(t->layout.extent.x), double(heights.extent.x)};
        if (t->layout.extent.y != heights.extent.y)
            return {error::mismatch, "texture extent.y", double(t->layout.extent.y), double(heights.extent.y)};
    }
    if (both && inverse.layout.mips != out.layout.mips)
        return {error::mismatch, "texture mips", double(inverse.layout.mips), double(out.layout.mips)};
    if (status s = check_samples(heights); !s) return s;

    const auto store = [&](int level, int x, int y, int byte) {
        const std::size_t at = std::size_t(y) * out.layout.row_bytes(level) + std::size_t(x);
        out.slice(0, level)[at] = std::byte(byte);
        if (both) inverse.slice(0, level)[at] = std::byte(emboss_half - byte);
    };
    std::atomic<std::size_t> outside{0};
    const double unit = unit_height(heights);
    normal_detail::for_rows(heights.extent.y, execute, [&](int y) {
        std::size_t count = 0;
        for (int x = 0; x < heights.extent.x; ++x) {
            const Sample sample = sample_at(heights, x, y);
            if (is_no_data(heights, sample)) {
                store(0, x, y, 0);
                continue;
            }
            const double value = (double(sample) * unit - heights.datum - encoding.lowest) * encoding.scale;
            // The extremes of a scaled map may land outside by rounding.
            if (!(value >= -1e-9 && value <= 0.5 + 1e-9)) ++count;
            store(0, x, y, to_unorm8(float(std::clamp(value, 0.0, 0.5))));
        }
        outside.fetch_add(count, std::memory_order_relaxed);
    });
    for (int level = 1; level < out.layout.mips; ++level) {
        const glm::ivec2 to = out.layout.level_extent(level);
        normal_detail::for_rows(to.y, execute, [&](int y) {
            mean_detail::mean_row<float>(
                out.layout.level_extent(level - 1), to, y,
                [&](int x, int j) { return float(emboss_detail::byte_at(out, level - 1, x, j)); },
                [&](int x, float mean) { store(level, x, y, int(mean + 0.5f)); });
        });
    }
    if (clamped != nullptr) *clamped = outside.load();
    return {};
}

// Shifts over a texture that covers a quad of two triangles, from those of its corners, which is how a light that is
// near is drawn. corners: at texture coordinates (0, 0), (1, 0), (0, 1), (1, 1), for each
//   shader::bumpshadow_emboss_shift(light position - corner position, amount)
// A far light has one shift for all; a lambda that returns it serves.
struct quad_shift {
    glm::vec2 corners[4];  // their shifts, in the unit of `amount`: texels where draw_relief and draw_emboss take them

    // The shift at uv. The diagonal runs from (1, 0) to (0, 1).
    [[nodiscard]] glm::vec2 operator()(glm::vec2 uv) const {
        if (uv.x + uv.y <= 1.0f)
            return corners[0] + uv.x * (corners[1] - corners[0]) + uv.y * (corners[2] - corners[0]);
        return corners[3] + (1.0f - uv.x) * (corners[2] - corners[3]) + (1.0f - uv.y) * (corners[1] - corners[3]);
    }
};

// How the work is split, which decides where values are rounded to 8 bits.
enum class emboss_passes : unsigned char {
    // The frame buffer, 8 bits, holds the height, then the sum (saturated), then twice the product with the base, whose
    // two halves the blender rounds before it adds them: results are even or 255. A color of light is a fourth pass.
    three,
    // Height and inverse in one pass with two textures: one rounding less where heights are filtered, too; here, where
    // pixels are texels, the same as three.
    two,
    // All in one pass: a sum that is clamped but not rounded, one rounding at the end. Within 2 steps of the others,
    // and within 1 more for a colored light.
    one,
};

// Height plus shifted inverse, 8 bits with saturation, in all channels: the first two passes.
//   heights: level 0 of what pack_emboss wrote; a pixel of `out` for each texel
//   shift(uv): what is added to the coordinates of the inverse, in texels; towards the light, see
//   bumpshadow_emboss_shift
// Errors: what the checks find.
template <class Shift, executor Executor = serial>
[[nodiscard]] status draw_relief(const const_texture& heights, edge_mode edge, const Shift& shift, const pixels& out,
                                 Executor&& execute = {}) {
    if (status s = emboss_detail::check_texture(heights, "texture format"); !s) return s;
    const glm::ivec2 extent = heights.layout.extent;
    if (status s = check(out, extent, 1); !s) return s;
    normal_detail::for_rows(extent.y, execute, [&](int y) {
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec2 texel{float(x), float(y)};
            const glm::vec2 uv = (texel + 0.5f) / glm::vec2(extent);
            const float inverse = emboss_detail::inverse_at(heights, edge, texel + shift(uv));
            const int sum = emboss_detail::byte_at(heights, 0, x, y) + int(inverse + 0.5f);
            std::byte* const pixel = out.at(x, y);
            for (int c = 0; c < out.channels; ++c) pixel[c] = std::byte((std::min)(sum, 255));
        }
    });
    return {};
}

// The embossed base texture.
//   base, out: 3 or 4 channels, extent of the heights; a fourth one becomes 255. They may be the same picture
//   color: of the light, in [0, 1]
// Errors: what the checks find, a color that is not in range.
template <class Shift, executor Executor = serial>
[[nodiscard]] status draw_emboss(const const_texture& heights, edge_mode edge, const const_pixels& base,
                                 const Shift& shift, const pixels& out, emboss_passes passes = emboss_passes::one,
                                 glm::vec3 color = {1.0f, 1.0f, 1.0f}, Executor&& execute = {}) {
    if (status s = emboss_detail::check_texture(heights, "texture format"); !s) return s;
    const glm::ivec2 extent = heights.layout.extent;
    if (status s = check(base, extent, 3); !s) return s;
    if (status s = check(out, extent, 3); !s) return s;
    for (glm::length_t c = 0; c < 3; ++c)
        if (!(color[c] >= 0.0f && color[c] <= 1.0f)) return {error::out_of_range, "color", double(color[c]), 1.0};
    const bool fourth = color.x != 1.0f || color.y != 1.0f || color.z != 1.0f;
    normal_detail::for_rows(extent.y, execute, [&](int y) {
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec2 texel{float(x), float(y)};
            const glm::vec2 uv = (texel + 0.5f) / glm::vec2(extent);
            const int height = emboss_detail::byte_at(heights, 0, x, y);
            const float inverse = emboss_detail::inverse_at(heights, edge, texel + shift(uv));
            int bytes[3];
            for (int c = 0; c < 3; ++c) bytes[c] = std::to_integer<int>(base.at(x, y)[c]);
            if (passes == emboss_passes::one) {
                const float relief = shader::bumpshadow_emboss_relief(float(height) / 255.0f, inverse / 255.0f);
                const glm::vec3 lit = shader::bumpshadow_emboss(
                    relief, glm::vec3(float(bytes[0]), float(bytes[1]), float(bytes[2])) / 255.0f, color);
                for (glm::length_t c = 0; c < 3; ++c) bytes[c] = to_unorm8(lit[c]);
            } else {
                const int sum = (std::min)(height + int(inverse + 0.5f), 255);
                for (glm::length_t c = 0; c < 3; ++c) {
                    const int product = (sum * bytes[c] + 127) / 255;  // rounded to nearest; there are no ties
                    bytes[c] = (std::min)(2 * product, 255);
                    if (fourth) bytes[c] = to_unorm8(float(bytes[c]) / 255.0f * color[c]);
                }
            }
            std::byte* const pixel = out.at(x, y);
            for (int c = 0; c < 3; ++c) pixel[c] = std::byte(bytes[c]);
            if (out.channels == 4) pixel[3] = std::byte(255);
        }
    });
    return {};
}

}  // namespace bumpshadow
