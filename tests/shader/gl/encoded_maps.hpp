#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/texture.hpp>

#include "support/gl.hpp"
#include "support/shapes.hpp"

// A small map of stones, baked and packed in every encoding, with what a shader writes to decode each, and what C++
// gives.
namespace encoded_maps {

using glm::vec2;
using glm::vec3;

struct encoded {
    std::string name;
    std::string switches;  // of the paste file, as lines of #define
    // Statements that set `horizon` from the vec2 uv, the vec3 light and the float level.
    std::string code;
    // The same by a function of the paste file that samples: GLSL and HLSL; empty where there is none.
    std::string sampling[2];
    std::vector<gl::bound_texture> textures;
    bumpshadow::horizon_scale scale;
    // What the horizon, over what stands for 1, may differ by: see filter_bounds.hpp.
    float bound;
    bool brightness = false;  // in place of a horizon
    int mips = 1;
    // Of C++: the horizon, or the brightness, by reference/shadow.hpp.
    std::function<float(vec2 uv, vec3 light, float level)> expected;
};

class maps {
public:
    maps();
    maps(const maps&) = delete;
    maps& operator=(const maps&) = delete;

    [[nodiscard]] const std::vector<encoded>& all() const { return all_; }

private:
    void add_all();
    void add(const bumpshadow::tangent_volume& v, int mips, const char* remark = "");
    void add(const bumpshadow::tangent_volume& v, const bumpshadow::texture& t, int mips, const char* remark);
    // Slopes as they are baked, which a float texture takes.
    void add_slopes(bumpshadow::texture_kind kind);
    void add(const bumpshadow::slice_layers& s, int mips);
    enum class sine_way : unsigned char { array, half, two, published, biased };  // the last two: factors from a cube
    void add(const bumpshadow::sine_layers& s, sine_way way);
    void add(const bumpshadow::fourier& f);
    void add(const bumpshadow::ssbump& s);
    void add_emboss();

    [[nodiscard]] bumpshadow::texture make(const bumpshadow::texture_layout& layout);
    [[nodiscard]] std::span<const bumpshadow::horizon_map> levels(int count) const {
        return std::span(levels_).first(std::size_t(count));
    }
    // A name that no other texture has.
    [[nodiscard]] std::string name();

    shapes::field<float> heights_;
    std::vector<glm::dvec2> directions_;
    std::deque<std::vector<float>> floats_;
    std::deque<std::vector<std::byte>> bytes_;
    std::vector<bumpshadow::horizon_map> levels_;
    bumpshadow::normal_map normals_;
    std::vector<encoded> all_;
    int names_ = 0;
};

}  // namespace encoded_maps
