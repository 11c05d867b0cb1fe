#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/status.hpp>

#include "common/image.hpp"
#include "common/shading.hpp"
#include "report/section.hpp"

namespace examples {

// Degrees, as light_direction() takes them.
struct far_light {
    double azimuth = 0.0, elevation = 0.0;

    [[nodiscard]] glm::vec3 direction() const { return light_direction(azimuth, elevation); }
};

// The lights that pictures are compared under: every azimuth at every elevation, azimuth by azimuth. The azimuths fall
// evenly between the bearings of 4, 8, 16 and 32 slices, so that no number of them is favored.
[[nodiscard]] std::vector<double> light_azimuths(bool quick);
[[nodiscard]] std::vector<double> light_elevations(bool quick);

// A part of a map as a shadow of the whole map sees it: bumpshadow::shade() is given the part, `inner` whole texels of
// the whole map.
template <class Shadow>
struct window_shadow {
    Shadow inner;
    bumpshadow::rectangle window;
    glm::ivec2 whole{0};

    static constexpr bool shades = [] {
        if constexpr (requires { Shadow::shades; }) return bool(Shadow::shades);
        return false;
    }();

    [[nodiscard]] bumpshadow::status check() const {
        if constexpr (requires { inner.check(); }) return inner.check();
        return {};
    }
    [[nodiscard]] float operator()(glm::vec2 uv, glm::vec3 light) const {
        // By way of the number of the texel, so that no rounding moves its center.
        const glm::vec2 texel = glm::floor(uv * glm::vec2(window.extent)) + glm::vec2(window.origin);
        return inner((texel + 0.5f) / glm::vec2(whole), light);
    }
    [[nodiscard]] bool row(glm::ivec2, glm::ivec2 first, int count, glm::vec3 light, float* factors) const {
        if constexpr (requires { inner.row(first, first, count, light, factors); })
            return inner.row(whole, window.origin + first, count, light, factors);
        return false;
    }
};

// The middle of a map, which is shaded texel by texel: the whole of small ones, at most `longest` texels a side of
// others.
class lit_window {
public:
    // Throws failure.
    lit_window(const report_map& map, int longest);

    [[nodiscard]] const bumpshadow::rectangle& window() const { return window_; }
    [[nodiscard]] glm::ivec2 extent() const { return window_.extent; }
    [[nodiscard]] glm::ivec2 whole() const { return whole_; }
    [[nodiscard]] double texels() const { return double(window_.extent.x) * double(window_.extent.y); }
    // With the normals of the height map.
    [[nodiscard]] const examples::surface& surface() const { return surface_; }

    template <class Shadow>
    [[nodiscard]] window_shadow<Shadow> of_whole(const Shadow& shadow) const {
        return {shadow, window_, whole_};
    }

private:
    bumpshadow::rectangle window_;
    glm::ivec2 whole_{0};
    examples::surface surface_;
};

// Pictures against the truth, over several lights: root of the mean square over all pixels, channels and lights, in
// 8-bit sRGB levels; PSNR from that; mean of FLIP.
class picture_errors {
public:
    // Returns the FLIP of each pixel. Throws failure.
    const std::vector<float>& add(const image8& truth, const image8& result);
    void put(record& r) const;

private:
    double squares_ = 0.0, flips_ = 0.0, pictures_ = 0.0, pixels_ = 0.0;
    std::vector<float> difference_;
};

// FLIP of 0 as black, over purple and orange, to 1 as pale yellow.
[[nodiscard]] image8 picture_of_flip(std::span<const float> difference, glm::ivec2 extent);

}  // namespace examples
