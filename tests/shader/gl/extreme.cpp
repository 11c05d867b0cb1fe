// Lights at the limits of float on a GPU: NaN and infinite components, too long and too short for their squares,
// grazing, zero, straight up and below, with every k: the factor is in [0, 1], and that of C++.
//
// GLSL leaves open what becomes of NaN (4.60, section 4.7.1), so no snippet asks for it: max(0.0f, v) and comparisons
// that are false give 0 or 1. Where a driver makes a number of NaN (Mesa: in atan and clamp) that is another factor.

#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/gl/encoded_maps.hpp"
#include "shader/gl/expressions.hpp"
#include "support/shader_run.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

using namespace expressions;

namespace {

using limits = std::numeric_limits<float>;

// Finite ones first.
constexpr float components[] = {0.0f,
                                -0.0f,
                                1.0f,
                                -1.0f,
                                1e-7f,
                                -1e-7f,
                                1e-40f,
                                1e19f,
                                -1e20f,
                                limits::max(),
                                limits::lowest(),
                                limits::infinity(),
                                -limits::infinity(),
                                limits::quiet_NaN()};
constexpr std::size_t finite_components = 11;
constexpr float all_k[] = {0.0f, 1e-40f, 1.0f, 8.0f, 1e30f, limits::max(), limits::infinity()};

// Lights of the first `count` components, each with four edges. a: the light and max_slope; b: horizon, k, c; c and d:
// texels.
std::vector<inputs> lights_of(std::size_t count) {
    constexpr float horizons[] = {0.0f, 0.3f, 1.0f}, max_slopes[] = {0.0f, 4.0f, 1e-40f, 0.03f, 1.0f};
    std::vector<inputs> result;
    for (std::size_t light = 0; light < count * count * count; ++light)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t n = result.size() + light;
            const vec3 v(components[light / count / count], components[light / count % count],
                         components[light % count]);
            result.push_back(
                {{vec4(v, max_slopes[n % 5]), vec4(horizons[n % 3], all_k[n % 7], n / 7 % 2 == 0 ? 1.0f : 0.5f, 0.0f),
                  vec4(0.1f, 0.7f, 0.35f, 0.9f), vec4(0.27f, 0.6f, 0.83f, 0.05f)}});
        }
    return result;
}

// In every form.
#define FACTORS(bound, level, horizon)                                       \
    EXPRESSION(bound, bumpshadow_shadow_hard(level, horizon)),               \
        EXPRESSION(bound, bumpshadow_shadow_soft(level, horizon, b.y, b.z)), \
        EXPRESSION(bound, bumpshadow_shadow_soft_above(level, horizon, b.y, b.z))

constexpr expression of_slopes_and_sines[] = {
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)) / max(a.w, 1e-6f), b.x),
    FACTORS(2e-6f, bumpshadow_sine(vec3(a.x, a.y, a.z)) / max(a.w, 1e-6f), b.x),
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)), bumpshadow_sine_layers(c, d, vec2(a.x, a.y))),
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)), bumpshadow_sine_half(c, d.x, vec2(a.x, a.y))),
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)),
            bumpshadow_fourier_3(vec3(c.x, c.y, c.z), bumpshadow_fourier_direction(vec2(a.x, a.y)))),
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)),
            bumpshadow_fourier_9(c, d, b.x, bumpshadow_fourier_direction(vec2(a.x, a.y)))),
};

constexpr expression of_angles_and_clamps[] = {
    FACTORS(5e-5f, bumpshadow_angle(vec3(a.x, a.y, a.z)) / max(a.w, 1e-6f), b.x),
    FACTORS(2e-6f, bumpshadow_slope(vec3(a.x, a.y, a.z)),
            bumpshadow_sine_layers_factors(c, d, bumpshadow_factors(vec2(a.x, a.y)))),
    FACTORS(2e-6f, bumpshadow_vertex_slope(vec3(a.x, a.y, a.z), 4.0f), b.x),
};

bool is_factor(float v) { return v >= 0.0f && v <= 1.0f; }  // not so for what is not a number

bool runs(const shader_run::backend& with) {
    const std::string why = shader_run::missing(with);
    if (!why.empty()) skip::because(why);
    return why.empty();
}

// Factors of each encoding with its textures, sampled wherever the light's bearing comes to lie.
shader_run::job job_of(const encoded_maps::encoded& e, const std::vector<vec4>& lights,
                       const shader_run::backend& with) {
    const bool hlsl = with.source == shader_run::language::hlsl;
    shader_run::job job;
    job.functions =
        e.switches + tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/bumpshadow.") + (hlsl ? "hlsl" : "glsl"));
    job.body =
        "vec2 uv = vec2(0.37f, 0.61f);\nfloat level = 0.0f, horizon = 0.0f;\nvec3 light = vec3(a.x, a.y, a.z);\n{\n" +
        e.code +
        "}\nfloat elevation = bumpshadow_level(light) * b.x;\n"
        "result = vec4(bumpshadow_shadow_hard(elevation, horizon), bumpshadow_shadow(elevation, horizon, b.y),\n"
        "              bumpshadow_shadow_soft(elevation, horizon, b.y, 0.5f),\n"
        "              bumpshadow_shadow_soft_above(elevation, horizon, b.y, 0.5f));\n";
    job.textures.assign(e.textures.begin(), e.textures.end());
    for (const vec4 light : lights)
        for (const float k : {0.0f, 8.0f, limits::infinity()}) {
            job.inputs[0].push_back(light);
            job.inputs[1].emplace_back(bumpshadow::stored_scale(e.scale), k, 0.0f, 0.0f);
        }
    job.extent = {int(job.inputs[0].size()), 1};
    return job;
}

}  // namespace

TEST_CASE("factors of slopes and sines are those of C++ for every light there is") {
    for (const outcome& result : check(of_slopes_and_sines, lights_of(std::size(components))))
        for (const difference& d : result.differences) CHECK((is_factor(d.least) && is_factor(d.most)));
}

TEST_CASE("factors of angles and clamps are those of C++ for every finite light, and in [0, 1] for every other") {
    check(of_angles_and_clamps, lights_of(finite_components));
    const std::vector<inputs> at = lights_of(std::size(components));
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (!runs(with)) continue;
        const outcome result = compare(of_angles_and_clamps, at, snippets(with), with);
        REQUIRE_MESSAGE(result.error.empty(), result.error);
        for (std::size_t row = 0; row < result.differences.size(); ++row) {
            const difference& d = result.differences[row];
            INFO(with.name, ": ", of_angles_and_clamps[row].text);
            CHECK((is_factor(d.least) && is_factor(d.most)));
            CHECK(d.worst <= 1.0f);  // infinite where there was NaN
        }
    }
}

TEST_CASE("lights that are not finite give a factor in [0, 1] of every encoding, whatever its textures are asked for") {
    static const encoded_maps::maps maps;
    constexpr float some[] = {0.0f, 1.0f, -1e-7f, limits::infinity(), -limits::infinity(), limits::quiet_NaN()};
    std::vector<vec4> lights;
    for (const float x : some)
        for (const float y : some)
            for (const float z : some)
                if (!std::isfinite(x + y + z)) lights.emplace_back(x, y, z, 0.0f);
    for (const shader_run::backend& with : {shader_run::glsl_450, shader_run::hlsl_450}) {
        if (!runs(with)) continue;
        for (const encoded_maps::encoded& e : maps.all()) {
            // Brightness is promised for finite lights. Cubes are left out: Mesa 22.3's software renderer crashes where
            // one is sampled with NaN, whatever the shader makes of the texel.
            bool supported = !e.brightness;
            for (const gl::bound_texture& t : e.textures)
                supported = supported && t.texture.layout.kind != bumpshadow::texture_kind::cube &&
                            shader_run::context_of(with).supports(t.texture.layout, t.how);
            if (!supported) continue;
            INFO(with.name, ", ", e.name);
            const gl::image image = shader_run::run(job_of(e, lights, with), with);
            REQUIRE_MESSAGE(image.error.empty(), image.error);
            std::size_t wrong = 0;
            for (const vec4 v : image.values)
                wrong += is_factor(v.x) && is_factor(v.y) && is_factor(v.z) && is_factor(v.w) ? 0 : 1;
            CHECK(wrong == 0);
        }
    }
}
