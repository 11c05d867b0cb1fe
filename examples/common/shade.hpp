#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "common/image.hpp"

namespace examples {

// sRGB in [0, 1] to linear light and back.
[[nodiscard]] inline glm::vec3 linear(glm::vec3 srgb) {
    const auto one = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
    return {one(srgb.x), one(srgb.y), one(srgb.z)};
}

[[nodiscard]] inline std::uint8_t srgb_byte(float light) {
    const float c = std::clamp(light, 0.0f, 1.0f);
    const float srgb = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
    return std::uint8_t(std::lround(255.0f * srgb));
}

// What a picture is made of, texel by texel.
struct surface {
    glm::ivec2 extent{0};
    std::vector<glm::vec3> normals;  // unit length, tangent space; all zero for a hole in the map
    std::vector<glm::vec3> albedo;   // linear RGB; empty: one plain tone
};

// Normals from central differences; one-sided where the map is open.
template <bumpshadow::height_sample Sample>
[[nodiscard]] std::vector<glm::vec3> normals_of(const bumpshadow::height_map<Sample>& heights) {
    using bumpshadow::resolve_edge;
    const glm::ivec2 extent = heights.extent;
    const double unit = bumpshadow::unit_height(heights);
    // Slope from one neighbor to the other along an axis; a missing one, or a hole, is replaced by the texel itself.
    const auto slope = [&](int x, int y, int dx, int dy, double step) {
        const Sample here = bumpshadow::sample_at(heights, x, y);
        double height[2];
        double span = 0.0;
        for (int side = 0; side < 2; ++side) {
            const int sign = 2 * side - 1;
            const std::int64_t nx = resolve_edge(x + sign * dx, extent.x, heights.edge);
            const std::int64_t ny = resolve_edge(y + sign * dy, extent.y, heights.edge);
            const bool there =
                nx >= 0 && ny >= 0 && !bumpshadow::is_no_data(heights, bumpshadow::sample_at(heights, nx, ny));
            height[side] = unit * double(there ? bumpshadow::sample_at(heights, nx, ny) : here);
            span += there ? step : 0.0;
        }
        return span > 0.0 ? (height[1] - height[0]) / span : 0.0;
    };
    std::vector<glm::vec3> normals(std::size_t(extent.x) * std::size_t(extent.y));
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            if (bumpshadow::is_no_data(heights, bumpshadow::sample_at(heights, x, y))) continue;
            const double nx = -slope(x, y, 1, 0, heights.texel_size.x), ny = -slope(x, y, 0, 1, heights.texel_size.y);
            const double inverse = 1.0 / std::sqrt(nx * nx + ny * ny + 1.0);
            normals[std::size_t(y) * std::size_t(extent.x) + std::size_t(x)] =
                glm::vec3(nx * inverse, ny * inverse, inverse);
        }
    return normals;
}

// A far light: the bearing it comes from in turns (0 from the right, 0.25 from below the picture) and its elevation.
struct light {
    double bearing = 0.0;
    double elevation = 45.0;  // degrees above the surface

    [[nodiscard]] float slope() const { return float(std::tan(elevation * std::numbers::pi / 180.0)); }
    [[nodiscard]] glm::vec3 direction() const {
        const double turn = bearing * 2.0 * std::numbers::pi, rise = elevation * std::numbers::pi / 180.0;
        return {std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise)};
    }
};

// Shadow factors of one light: horizons interpolated between the two nearest bearings, with a soft edge. No horizons,
// no shadow. Slice i of N holds bearing i/N, so the light stands between slices floor(bearing N) and the next one.
class shadow {
public:
    shadow(const bumpshadow::horizon_map* horizons, light from) : horizons_(horizons), light_(from.slope()) {
        if (horizons == nullptr) return;
        const double slice = (from.bearing - std::floor(from.bearing)) * horizons->bearings;
        first_ = int(slice) % horizons->bearings;
        second_ = (first_ + 1) % horizons->bearings;
        weight_ = float(slice - std::floor(slice));
    }

    // 0 in shadow, 1 in light.
    [[nodiscard]] float operator()(int x, int y) const {
        if (horizons_ == nullptr) return 1.0f;
        const float a = horizons_->row(first_, y)[x], b = horizons_->row(second_, y)[x];
        const float horizon = a * (1.0f - weight_) + b * weight_;
        return std::clamp(sharpness * (light_ - horizon) + 0.5f, 0.0f, 1.0f);
    }

private:
    static constexpr float sharpness = 10.0f;

    const bumpshadow::horizon_map* horizons_;
    float light_;
    int first_ = 0, second_ = 0;
    float weight_ = 0.0f;
};

// Shades the whole surface, one pixel a texel: diffuse light and a little from the sky. Where horizons are given the
// light is cut off by them, else this is plain normal mapping.
[[nodiscard]] inline image8 shade(const surface& surface, light from, const bumpshadow::horizon_map* horizons) {
    const glm::vec3 plain_tone = linear(glm::vec3(0.74f, 0.70f, 0.64f)), hole = linear(glm::vec3(0.1f, 0.1f, 0.12f));
    const glm::vec3 direction = from.direction();
    // A camera would open up as the light gets low: what lies flat keeps much of its brightness.
    const float exposure = 1.9f / (0.55f + direction.z);
    const glm::vec3 sun = exposure * glm::vec3(1.0f, 0.94f, 0.84f), sky = exposure * glm::vec3(0.09f, 0.104f, 0.128f);
    const shadow factor(horizons, from);

    image8 picture(surface.extent, 3);
    for (int y = 0; y < surface.extent.y; ++y)
        for (int x = 0; x < surface.extent.x; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(surface.extent.x) + std::size_t(x);
            const glm::vec3 normal = surface.normals[i];
            glm::vec3 color = hole;
            if (normal.z > 0.0f) {
                const float lit = std::max(glm::dot(normal, direction), 0.0f) * factor(x, y);
                color = (surface.albedo.empty() ? plain_tone : surface.albedo[i]) *
                        ((0.5f + 0.5f * normal.z) * sky + lit * sun);
            }
            std::uint8_t* pixel = picture.at(x, y);
            for (int c = 0; c < 3; ++c) pixel[c] = srgb_byte(color[c]);
        }
    return picture;
}

}  // namespace examples
