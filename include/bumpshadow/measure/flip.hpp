#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/measure/flip_filters.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

#include <glm/common.hpp>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/matrix.hpp>

// FLIP for pictures of a low dynamic range: at each pixel, how large a person finds the difference between two pictures
// that are shown in turn at the same place.
//
// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3 (2), 2020. Pictures are
// continued at their borders by the border pixel. Both are first filtered as the eye does at the viewing distance, then
// compared in a uniform color space; the difference is raised where edges or points are in one picture alone.

namespace bumpshadow {

// How the pictures are looked at, and where memory comes from.
struct flip_options {
    // Pixels a degree of visual angle, 1 to 500. As published: 0.7 m away from a screen of 3840 pixels that is 0.7 m
    // wide.
    float pixels_per_degree = 67.02f;
    // As in bake_options. Sizes: flip_scratch_size.
    std::span<std::byte> scratch = {};
    std::pmr::memory_resource* memory = nullptr;  // null: std::pmr::get_default_resource()
};

namespace flip_detail {

inline constexpr int band = 64;  // rows an item of an executor

// Linear RGB to XYZ over that of white, D65: the primaries of sRGB, each row over its sum. Columns as GLM has them.
[[nodiscard]] inline glm::mat3 xyz_of_rgb() {
    const double x = 23359437.0, y = 12288897.0, z = 80288307.0;
    return glm::mat3(glm::dmat3(10135552.0 / x, 2613072.0 / y, 1425312.0 / z,  //
                                8788810.0 / x, 8788810.0 / y, 8788810.0 / z,   //
                                4435075.0 / x, 887015.0 / y, 70074185.0 / z));
}

// Filters and color spaces, once a call.
struct tables {
    filters filter;
    glm::mat3 to_xyz = xyz_of_rgb();
    glm::mat3 to_rgb = glm::mat3(glm::inverse(glm::dmat3(to_xyz)));
    float largest = 1.0f;  // color difference there can be, between green and blue

    explicit tables(double pixels_per_degree) : filter(pixels_per_degree) {
        largest = power(uniform({0.0f, 1.0f, 0.0f}), uniform({0.0f, 0.0f, 1.0f}));
    }

    // L*a*b* with a and b the smaller the darker the color is (Hunt).
    [[nodiscard]] glm::vec3 uniform(glm::vec3 rgb) const {
        const glm::vec3 xyz = to_xyz * rgb;
        const auto root = [](float t) {
            constexpr float delta = 6.0f / 29.0f;
            return t > delta * delta * delta ? std::cbrt(t) : t * (1.0f / (3.0f * delta * delta)) + 4.0f / 29.0f;
        };
        const float x = root(xyz.x), y = root(xyz.y), z = root(xyz.z);
        const float lightness = 116.0f * y - 16.0f, hunt = 0.01f * lightness;
        return {lightness, hunt * 500.0f * (x - y), hunt * 200.0f * (y - z)};
    }

    // HyAB distance to the power of 0.7.
    [[nodiscard]] static float power(glm::vec3 a, glm::vec3 b) {
        const glm::vec3 d = a - b;
        return std::pow(std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z), 0.7f);
    }

    // In [0, 1]: differences up to 0.4 of the largest take 0.95 of the range.
    [[nodiscard]] float color_difference(glm::vec3 a, glm::vec3 b) const {
        const float part = power(a, b) / largest;
        return part < 0.4f ? part * (0.95f / 0.4f) : (std::min)(0.95f + (part - 0.4f) * (0.05f / 0.6f), 1.0f);
    }
};

// What is kept of a picture's rows, filtered along x.
enum plane : int { luminance, red_green, blue_yellow, more_blue_yellow, smooth, edge, point, planes };
// Of one row, filtered along y, too: opponent colors, which become L*, a and b, and features, of which the first of
// each pair becomes the strength.
enum line : int { color_0, color_1, color_2, edge_x, edge_y, point_x, point_y, lines };

// Floats of a row: `width` rounded up for filtered().
[[nodiscard]] constexpr std::size_t row_floats(int width) {
    constexpr auto unit = std::size_t(group);
    return (std::size_t(width) + unit - 1) / unit * unit;
}

[[nodiscard]] constexpr std::size_t bands_of(glm::ivec2 extent) { return std::size_t(part_count(extent.y, band)); }

// Also for numbers that flip refuses.
[[nodiscard]] inline int radius_of(float pixels_per_degree) {
    return filters(pixels_per_degree >= 1.0f ? (std::min)(double(pixels_per_degree), 500.0) : 1.0).radius;
}

// Scratch of one band.
struct work {
    float* rows;     // 3, each with `radius` more at both ends
    float* planes;   // of both pictures: [picture][plane][row of the band and its margins][x]
    float* columns;  // [picture][line][x]

    // add(pointer, floats) for each.
    template <class Add>
    void for_arrays(int width, int radius, const Add& add) {
        const std::size_t row = row_floats(width), margins = 2 * std::size_t(radius);
        add(rows, saturated_product(3, saturated_sum(row, margins)));
        add(planes, saturated_product(2 * std::size_t(flip_detail::planes) * (std::size_t(band) + margins), row));
        add(columns, saturated_product(2 * std::size_t(lines), row));
    }
};

// The next three are not inlined for the same reason as filtered().

// Linear red, green and blue to luminance and two differences: Y, Cx and Cz over 116, 500 and 200, without offset.
[[gnu::noinline]] inline void to_opponent(const tables& t, float* red, float* green, float* blue, int count) {
    for (int x = 0; x < count; ++x) {
        const glm::vec3 xyz = t.to_xyz * glm::vec3(red[x], green[x], blue[x]);
        red[x] = xyz.y, green[x] = xyz.x - xyz.y, blue[x] = xyz.y - xyz.z;
    }
}

// Filtered opponent colors to the uniform space, and features to their strengths.
[[gnu::noinline]] inline void to_uniform(const tables& t, float* l, std::size_t row, int count) {
    for (int x = 0; x < count; ++x, ++l) {
        const float white = l[color_0 * row], xyz_x = white + l[color_1 * row], xyz_z = white - l[color_2 * row];
        const glm::vec3 color = t.uniform(glm::clamp(t.to_rgb * glm::vec3(xyz_x, white, xyz_z), 0.0f, 1.0f));
        l[color_0 * row] = color.x, l[color_1 * row] = color.y, l[color_2 * row] = color.z;
        const auto length = [](float a, float b) { return std::sqrt(a * a + b * b); };
        l[edge_x * row] = length(l[edge_x * row], l[edge_y * row]);
        l[point_x * row] = length(l[point_x * row], l[point_y * row]);
    }
}

[[gnu::noinline]] inline void differences(const tables& t, const float* a, const float* b, std::size_t row, float* to,
                                          int count) {
    const auto color = [&](const float* l) { return glm::vec3(l[color_0 * row], l[color_1 * row], l[color_2 * row]); };
    for (int x = 0; x < count; ++x, ++a, ++b) {
        const float edges = std::abs(a[edge_x * row] - b[edge_x * row]);
        const float points = std::abs(a[point_x * row] - b[point_x * row]);
        const float feature = std::sqrt((std::min)((std::max)(edges, points) * 0.70710678f, 1.0f));
        to[x] = std::pow(t.color_difference(color(a), color(b)), 1.0f - feature);
    }
}

// Rows first - radius to end + radius of a picture, filtered along x. color(x, y): linear, in [0, 1]
template <class Color>
void filter_rows(const tables& t, const Color& color, glm::ivec2 extent, int first, int end, const work& w, float* to) {
    const int radius = t.filter.radius, count = int(row_floats(extent.x));
    const auto row = std::size_t(count), padded = row + 2 * std::size_t(radius);
    const std::size_t step = row * std::size_t(band + 2 * radius);
    const std::size_t right = std::size_t(radius) + std::size_t(extent.x);
    float* const from[3] = {w.rows + radius, w.rows + padded + radius, w.rows + 2 * padded + radius};
    for (int i = first - radius; i < end + radius; ++i, to += row) {
        if (i > first - radius && (i <= 0 || i >= extent.y)) {
            // Beyond the border every row is as the one before.
            for (float* p = to; p < to + std::size_t(planes) * step; p += step) std::copy(p - row, p, p);
            continue;
        }
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec3 rgb = color(x, (std::clamp)(i, 0, extent.y - 1));
            from[0][x] = rgb.x, from[1][x] = rgb.y, from[2][x] = rgb.z;
        }
        to_opponent(t, from[0], from[1], from[2], extent.x);
        for (std::size_t c = 0; c < 3; ++c) {
            float* const all = w.rows + c * padded;
            std::fill(all, all + radius, all[radius]);
            std::fill(all + right, all + padded, all[right - 1]);
        }
        const auto pass = [&](int channel, const filter& f, int plane) {
            filtered(from[channel], 1, f, to + std::size_t(plane) * step, count);
        };
        pass(0, t.filter.luminance, luminance);
        pass(1, t.filter.red_green, red_green);
        pass(2, t.filter.blue_yellow[0], blue_yellow);
        pass(2, t.filter.blue_yellow[1], more_blue_yellow);
        pass(0, t.filter.smooth, smooth);
        pass(0, t.filter.edge, edge);
        pass(0, t.filter.point, point);
    }
}

// Row `index` of the band, filtered along y.
inline void filter_columns(const tables& t, const float* from, int index, int count, float* to) {
    const auto row = std::size_t(count), step = row * std::size_t(band + 2 * t.filter.radius);
    const float* const middle = from + row * std::size_t(index + t.filter.radius);
    const auto pass = [&](int plane, const filter& f, int line) {
        filtered(middle + std::size_t(plane) * step, std::ptrdiff_t(row), f, to + std::size_t(line) * row, count);
    };
    pass(luminance, t.filter.luminance, color_0);
    pass(red_green, t.filter.red_green, color_1);
    pass(blue_yellow, t.filter.blue_yellow_share[0], color_2);
    filtered<true>(middle + more_blue_yellow * step, std::ptrdiff_t(row), t.filter.blue_yellow_share[1],
                   to + color_2 * row, count);
    pass(edge, t.filter.smooth, edge_x);
    pass(smooth, t.filter.edge, edge_y);
    pass(point, t.filter.smooth, point_x);
    pass(smooth, t.filter.point, point_y);
}

[[nodiscard]] inline status check_output(glm::ivec2 extent, std::span<float> difference, const flip_options& options) {
    const std::size_t size = std::size_t(extent.x) * std::size_t(extent.y);
    if (difference.size() < size) return {error::too_small, "difference size", double(difference.size()), double(size)};
    const float density = options.pixels_per_degree;
    if (!(density >= 1.0f && density <= 500.0f))
        return {error::out_of_range, "pixels_per_degree", double(density), density > 500.0f ? 500.0 : 1.0};
    return {};
}

[[nodiscard]] inline std::size_t scratch_bytes(glm::ivec2 extent, float pixels_per_degree, int concurrency) {
    const int slots = slot_pool::slots(concurrency, bands_of(extent)), radius = radius_of(pixels_per_degree);
    scratch_layout layout;
    work w;
    for (int i = 0; i < slots; ++i)
        w.for_arrays(extent.x, radius, [&](float*&, std::size_t count) { layout.add<float>(count); });
    return layout.add<work>(std::size_t(slots)).bytes();
}

// Both colors: (x, y) -> linear RGB in [0, 1]
template <class Truth, class Result, class Executor>
[[nodiscard]] status compare(const Truth& truth, const Result& result, glm::ivec2 extent, std::span<float> difference,
                             const flip_options& options, const Executor& execute) {
    const tables t(double(options.pixels_per_degree));
    const std::size_t bands = bands_of(extent),
                      bytes = scratch_bytes(extent, options.pixels_per_degree, execute.concurrency());
    const int slots = slot_pool::slots(execute.concurrency(), bands);
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    scratch_block block;
    if (status s = block.allocate(where, bytes, "flip"); !s) return s;
    work* const works = block.carve<work>(std::size_t(slots));
    for (int i = 0; i < slots; ++i)
        works[i].for_arrays(extent.x, t.filter.radius,
                            [&](float*& array, std::size_t count) { array = block.carve<float>(count); });
    slot_pool pool(slots);

    execute(bands, [&](std::size_t item) {
        const auto lease = pool.acquire();
        const work& w = works[lease.index()];
        const int first = int(item) * band, end = first + (std::min)(band, extent.y - first);
        const int count = int(row_floats(extent.x));
        const auto row = std::size_t(count);
        float* const second_planes = w.planes + std::size_t(planes) * row * std::size_t(band + 2 * t.filter.radius);
        float* const second_columns = w.columns + std::size_t(lines) * row;
        filter_rows(t, truth, extent, first, end, w, w.planes);
        filter_rows(t, result, extent, first, end, w, second_planes);
        for (int i = first; i < end; ++i) {
            filter_columns(t, w.planes, i - first, count, w.columns);
            filter_columns(t, second_planes, i - first, count, second_columns);
            to_uniform(t, w.columns, row, extent.x);
            to_uniform(t, second_columns, row, extent.x);
            differences(t, w.columns, second_columns, row, difference.data() + std::size_t(i) * std::size_t(extent.x),
                        extent.x);
        }
    });
    return {};
}

}  // namespace flip_detail

// Bytes of scratch that flip takes, on an executor of that concurrency: O(width) a thread; 0 without pixels.
[[nodiscard]] inline std::size_t flip_scratch_size(glm::ivec2 extent, const flip_options& options = {},
                                                   int concurrency = 1) {
    if (extent.x <= 0 || extent.y <= 0) return 0;
    return flip_detail::scratch_bytes(extent, options.pixels_per_degree, concurrency);
}

// Compares two pictures in 8-bit sRGB, of 3 or 4 channels; the fourth is ignored.
//   difference  [y][x], tightly packed: 0 where nothing can be seen to 1 for the largest difference, between green and
//               blue; black and white are 0.967 apart
// Symmetric: truth and result can be exchanged. A comparison of 1024 x 1024 pixels takes about 0.25 s on one core.
// Accuracy: against filters over squares in double precision the mean is within 2e-5 and a pixel within 5e-4; beside
// an edge that is in one picture alone more, up to 2e-3, where colors differ by less than floats can tell.
// Errors: sizes; pixels_per_degree; scratch. Then nothing is written. The result does not depend on the executor.
template <executor Executor = serial>
[[nodiscard]] status flip(const const_pixels& truth, const const_pixels& result, std::span<float> difference,
                          const flip_options& options = {}, Executor&& execute = {}) {
    if (status s = check(truth, truth.extent, 3); !s) return s;
    if (status s = check(result, truth.extent, 3); !s) return s;
    if (status s = flip_detail::check_output(truth.extent, difference, options); !s) return s;
    float light[256];
    for (int i = 0; i < 256; ++i) light[i] = srgb_to_linear(float(i) / 255.0f);
    const auto color = [&](const const_pixels& of) {
        return [&](int x, int y) {
            const std::byte* const p = of.at(x, y);
            return glm::vec3(light[std::to_integer<int>(p[0])], light[std::to_integer<int>(p[1])],
                             light[std::to_integer<int>(p[2])]);
        };
    };
    return flip_detail::compare(color(truth), color(result), truth.extent, difference, options, execute);
}

// Compares two pictures in linear light, which is cut off at 0 and 1.
// Errors: besides, a value that is not finite, with its place.
template <executor Executor = serial>
[[nodiscard]] status flip(const rgb_image& truth, const rgb_image& result, std::span<float> difference,
                          const flip_options& options = {}, Executor&& execute = {}) {
    if (status s = check(truth); !s) return s;
    if (status s = check(result); !s) return s;
    if (result.extent.x != truth.extent.x)
        return {error::mismatch, "image extent.x", double(result.extent.x), double(truth.extent.x)};
    if (result.extent.y != truth.extent.y)
        return {error::mismatch, "image extent.y", double(result.extent.y), double(truth.extent.y)};
    if (status s = flip_detail::check_output(truth.extent, difference, options); !s) return s;
    for (const rgb_image* image : {&truth, &result})
        for (int y = 0; y < truth.extent.y; ++y)
            for (int i = 0; i < 3 * truth.extent.x; ++i)
                if (const float v = image->row(y)[i]; !is_finite(v))
                    return {error::not_finite, "image", double(v), 0.0, {i / 3, y}};
    const auto color = [](const rgb_image& of) {
        return [&of](int x, int y) {
            const float* const p = of.row(y) + 3 * x;
            return glm::clamp(glm::vec3(p[0], p[1], p[2]), 0.0f, 1.0f);
        };
    };
    return flip_detail::compare(color(truth), color(result), truth.extent, difference, options, execute);
}

// One number for a picture: the mean of its differences; NaN for none.
[[nodiscard]] inline double mean_difference(std::span<const float> difference) {
    double sum = 0.0;
    for (const float d : difference) sum += double(d);
    return difference.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / double(difference.size());
}

}  // namespace bumpshadow
