#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/scene.hpp>
#include <bumpshadow/reference/sampler.hpp>

#include "common/encoding.hpp"
#include "common/heights.hpp"

namespace examples {

struct measured_error {
    double mismatch = 0.0;  // mean difference of the shadow factor; of single texels the share of wrong answers
    double interval = 0.0;  // half width of the 95 % confidence interval
};

// Pixels of a map in lights of a scene, and what share of each is lit, by exact horizons. It has nothing of the sample
// that a plan is made by.
class lit_pixels {
public:
    // Draws 3000 texels, or of a distant view 1000 squares of its texels anywhere in the map; of scenes with few lights
    // more, so that there are 48000 answers in different bearings, or 8000. Throws failure.
    lit_pixels(const height_samples& samples, const height_source& source, const bumpshadow::scene& scene,
               std::uint32_t seed);

    // Of a texture, as a GPU shows it, without mips, from taps x taps places of a pixel.
    [[nodiscard]] measured_error of(const encoded& map, const bumpshadow::shadow_edge& edge, int taps = 1) const;
    // Of a surface without shadows.
    [[nodiscard]] measured_error without_shadows() const;
    [[nodiscard]] std::size_t pixels() const { return places_.size(); }
    [[nodiscard]] int side() const { return side_; }

private:
    struct answer {
        glm::vec3 light;
        float lit;
    };

    template <class Factor>
    [[nodiscard]] measured_error judge(const Factor& factor) const;

    int side_ = 1;
    std::size_t lights_ = 1;  // of a pixel
    bumpshadow::sampler how_;
    std::vector<glm::vec2> places_;  // texture coordinates of the pixels' middles
    std::vector<answer> answers_;    // lights_ of each pixel
};

}  // namespace examples
