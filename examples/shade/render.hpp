#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/ext/vector_float3.hpp>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>

#include "common/encoding.hpp"
#include "common/heights.hpp"
#include "common/image.hpp"
#include "common/method.hpp"
#include "common/shading.hpp"

namespace examples {

// Everything but the light and the encoding.
struct scene {
    height_samples samples;
    height_source source;
    horizon_settings horizons;
    examples::surface surface;
    std::vector<image8> lightmaps;  // three, linear, any extent; or none
    std::optional<image8> detail;   // gray or RGB, any extent
    bumpshadow::sampler how;
    double light_radius = 1.0;                    // degrees; 0: a hard edge
    std::optional<bumpshadow::shadow_edge> edge;  // in place of the radius
    std::optional<double> emboss_shift;           // texels; default: from the map
    int threads = 0;
};

// What is shown: a packed map, horizons of the light's own bearing, or no shadow.
struct shown {
    encoding_kind kind = encoding_kind::none;
    bool published = false;  // sine: factors from the published cube; fourier: the post's own edge
    std::optional<encoded> map;
};

[[nodiscard]] shown prepare(const scene& scene, const encoding_settings& settings);

// The surface in the light, one pixel a texel; or, with `factor`, gray: what the light is multiplied by, 0 to 255
// (emboss: 128 is what the base texture has).
[[nodiscard]] image8 draw(const scene& scene, const shown& what, glm::vec3 light, bool factor);

// Height map, inverse, their sum, base texture and the product: figures 1A to 1E of the embossing article.
[[nodiscard]] std::vector<image8> draw_emboss_figures(const scene& scene, const encoded& map, glm::vec3 light);

}  // namespace examples
