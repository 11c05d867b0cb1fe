// All other snippets on a GPU: what is computed from lights, texels and vertices.

#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/gl/expressions.hpp"
#include "source.hpp"
#include "support/shapes.hpp"
#include "support/tool.hpp"

using namespace expressions;

namespace {

// Random numbers in [-1, 1] or, where texels are meant, in [0, 1].
std::vector<inputs> random_inputs(double least, int count) {
    shapes::noise noise(5);
    std::vector<inputs> result(static_cast<std::size_t>(count));
    for (inputs& in : result)
        for (vec4& v : in.values)
            for (int k = 0; k < 4; ++k) v[k] = float(least + (1.0 - least) * noise.uniform());
    return result;
}

// a: every light; b, c, d: random numbers in [0, 1].
std::vector<inputs> lights_and_texels() {
    const std::vector<vec4> all = lights();
    std::vector<inputs> result = random_inputs(0.0, int(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) result[i].values[0] = all[i];
    return result;
}

constexpr expression of_lights[] = {
    EXPRESSION(1e-6f, bumpshadow_factors(vec2(a.x, a.y)).layer0),
    EXPRESSION(1e-6f, bumpshadow_factors(vec2(a.x, a.y)).layer1),
    EXPRESSION(1e-6f, bumpshadow_sine_layers_factors(b, c, bumpshadow_factors(vec2(a.x, a.y)))),
    EXPRESSION(1e-6f, bumpshadow_sine_layers(b, c, vec2(a.x, a.y))),
    EXPRESSION(1e-6f, bumpshadow_sine_half(b, c.x, vec2(a.x, a.y))),
    EXPRESSION(0.0f, bumpshadow_sine_first_layer(vec2(a.x, a.y))),
    EXPRESSION(1e-6f, bumpshadow_emboss_shift(vec3(a.x, a.y, a.z), vec2(b.x, b.y))),
    EXPRESSION(1e-6f, bumpshadow_fourier_direction(vec2(a.x, a.y))),
    EXPRESSION(1e-6f, bumpshadow_vertex_slope(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_bearing_cubic(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_bearing_octant(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_bearing_exact(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_bearing_quintic(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_bearing_diamond(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_direction(vec3(a.x, a.y, a.z), 4.0f)),
    EXPRESSION(1e-6f, bumpshadow_vertex_direction_sine(vec3(a.x, a.y, a.z))),
};

constexpr expression of_texels[] = {
    EXPRESSION(1e-6f, bumpshadow_factors_published_cube(a).layer0),
    EXPRESSION(1e-6f, bumpshadow_factors_published_cube(a).layer1),
    EXPRESSION(1e-6f, bumpshadow_factors_biased_cube(a).layer0),
    EXPRESSION(1e-6f, bumpshadow_factors_biased_cube(a).layer1),
    EXPRESSION(1e-6f, bumpshadow_layer0_biased_cube(a)),
    EXPRESSION(1e-6f, bumpshadow_layer1_biased_cube(a)),
    EXPRESSION(1e-6f, bumpshadow_sine_layers_biased_cube(b, c, a)),
    EXPRESSION(1e-6f, bumpshadow_turn_to_diagonal(a.x)),
    EXPRESSION(1e-6f, bumpshadow_normal(vec3(a.x, a.y, a.z), 1.0f)),
    EXPRESSION(1e-6f, bumpshadow_normal(vec3(a.x, a.y, a.z), -1.0f)),
    EXPRESSION(1e-6f, bumpshadow_normal_of_derivatives(vec2(a.x, a.y), 3.0f, -1.0f)),
    EXPRESSION(1e-6f, bumpshadow_tangent_horizon(a.x, a.y, a.z)),
    EXPRESSION(1e-6f, bumpshadow_grouped_horizon(a, b.x, 4.0f * b.y)),
    EXPRESSION(1e-6f, bumpshadow_overlapping_horizon(a, 3.0f * b.y)),
    EXPRESSION(1e-6f, bumpshadow_fourier_texel(a, 4.0f * b, -2.0f * c)),
    EXPRESSION(1e-6f, bumpshadow_fourier_root_texel(a, 4.0f * b, -2.0f * c)),
    EXPRESSION(1e-6f, bumpshadow_fourier_root_constant(a.x, 4.0f * b.x, -2.0f * c.x)),
    EXPRESSION(1e-6f, bumpshadow_emboss_inverse(a.x)),
    EXPRESSION(1e-6f, bumpshadow_emboss_relief(a.x, a.y)),
    EXPRESSION(1e-6f, bumpshadow_emboss(a.w, vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z))),
    EXPRESSION(0.0f, bumpshadow_ssbump_other_hand(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_sum(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_normal(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_normal(vec3(0.0f, 0.0f, 0.0f))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_detail(vec3(a.x, a.y, a.z), b.x)),
    EXPRESSION(1e-6f, bumpshadow_ssbump_detail_masks(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_lightmaps(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z),
                                                  vec3(d.x, d.y, d.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_light(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z))),
};

constexpr expression of_numbers[] = {
    EXPRESSION(2e-6f, bumpshadow_factors_of_bearing(a.x).layer0),
    EXPRESSION(2e-6f, bumpshadow_factors_of_bearing(a.x).layer1),
    EXPRESSION(1e-6f, bumpshadow_volume_coordinate(a.x, a.y)),
    EXPRESSION(2e-6f, bumpshadow_tangent_layers(a.x, a.y, 16.0f)),
    EXPRESSION(1e-6f, bumpshadow_arc_coordinate(a.x, a.y, 2.0f, -0.1f)),
    EXPRESSION(2e-6f, bumpshadow_arc_layers(a.x, a.y, 20.0f, -0.3f, 16.0f)),
    EXPRESSION(2e-6f, bumpshadow_slice_position(a.x, a.y, 16.0f)),
    EXPRESSION(2e-6f, bumpshadow_grouped_layers(8.0f * abs(a.x), 2.0f)),
    EXPRESSION(2e-6f, bumpshadow_overlapping_layer(12.0f * abs(a.x))),
    EXPRESSION(1e-6f, bumpshadow_fourier_turn(vec2(a.x, a.y), vec2(b.x, b.y), vec2(c.x, c.y))),
    EXPRESSION(1e-6f, bumpshadow_fourier_3(vec3(a.x, a.y, a.z), vec2(c.x, c.y))),
    EXPRESSION(1e-6f, bumpshadow_fourier_5(a, b.w, vec2(c.x, c.y))),
    EXPRESSION(1e-6f, bumpshadow_fourier_7(a, vec3(b.x, b.y, b.z), vec2(c.x, c.y))),
    EXPRESSION(1e-6f, bumpshadow_fourier_9(a, b, c.w, vec2(c.x, c.y))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_project(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_weights(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_world_red(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_world_green(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z))),
    EXPRESSION(1e-6f, bumpshadow_ssbump_world_blue(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z))),
    EXPRESSION(4e-6f, bumpshadow_ssbump_world_normal(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z),
                                                     vec3(d.x, d.y, d.z))),
    EXPRESSION(1e-6f, bumpshadow_normal_lightmaps(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z),
                                                  vec3(d.x, d.y, d.z))),
    EXPRESSION(1e-6f, bumpshadow_reflection(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z))),
    EXPRESSION(1e-6f, bumpshadow_to_tangent_space(vec3(a.x, a.y, a.z), vec3(b.x, b.y, b.z), vec3(c.x, c.y, c.z),
                                                  vec3(d.x, d.y, d.z))),
    EXPRESSION(1e-6f, bumpshadow_unwrap_bearings(vec3(a.x, a.y, a.z))),
    EXPRESSION(0.0f, bumpshadow_bearings_go_round(vec3(a.x, a.y, a.z))),
    EXPRESSION(1e-6f, bumpshadow_bearing_pair(a.x)),
    EXPRESSION(0.0f, bumpshadow_pick_bearing(vec2(a.x, a.y), vec2(a.z, a.w))),
};

}  // namespace

TEST_CASE("what is computed from lights is what C++ computes") { check(of_lights, lights_and_texels()); }

TEST_CASE("what is computed from texels is what C++ computes") { check(of_texels, random_inputs(0.0, 500)); }

TEST_CASE("what is computed from other numbers is what C++ computes") { check(of_numbers, random_inputs(-1.0, 500)); }

TEST_CASE("no snippet is left out") {
    std::string tests;
    for (const auto& entry : std::filesystem::directory_iterator(BUMPSHADOW_TESTS_FOLDER "/shader/gl")) {
        const std::string text = tool::read(entry.path());
        if (text.find("EXPRESSION(") != std::string::npos) tests += text;
    }
    for (const shaders::snippet& s : shaders::read_source(BUMPSHADOW_SHADER_FOLDER).snippets)
        if (!s.code.starts_with("struct "))
            CHECK_MESSAGE(tests.find(s.name + '(') != std::string::npos, s.name,
                          " has no EXPRESSION in tests/shader/gl");
}
