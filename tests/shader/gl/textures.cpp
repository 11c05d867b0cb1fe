// The CPU sampler against the GPU's: every format, kind and way of sampling.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/quantize.hpp>
#include <bumpshadow/reference/sampler.hpp>

#include "support/shader_run.hpp"
#include "support/shapes.hpp"
#include "support/skip.hpp"

using namespace bumpshadow;
using glm::vec2;
using glm::vec3;
using glm::vec4;

namespace {

// Largest differences from the CPU sampler: fetched, nearest, filtered. What software renderers do: 8 bits and less are
// filtered with weights of 8 bits and results of 8 bits, all else and every cube in float; 565 is widened to 8 bits
// where it is sampled; blocks are decoded to 8 bits. Random texels are the hardest.
struct format_bounds {
    texel_format format;
    const char* name;
    float fetched, nearest, filtered;
};

constexpr format_bounds formats[] = {
    {texel_format::r8, "r8", 1e-7f, 1e-7f, 0.009f},        {texel_format::rg8, "rg8", 1e-7f, 1e-7f, 0.009f},
    {texel_format::rgba8, "rgba8", 1e-7f, 1e-7f, 0.009f},  {texel_format::r16, "r16", 1e-7f, 1e-7f, 2e-6f},
    {texel_format::rgba16, "rgba16", 1e-7f, 1e-7f, 2e-6f}, {texel_format::r16f, "r16f", 0.0f, 0.0f, 2e-6f},
    {texel_format::rgba16f, "rgba16f", 0.0f, 0.0f, 2e-6f}, {texel_format::r32f, "r32f", 0.0f, 0.0f, 2e-6f},
    {texel_format::rgba32f, "rgba32f", 0.0f, 0.0f, 2e-6f}, {texel_format::rgb565, "rgb565", 1e-7f, 0.003f, 0.011f},
    {texel_format::bc1, "bc1", 0.0067f, 0.0067f, 0.013f},  {texel_format::bc4, "bc4", 0.0067f, 0.0067f, 0.013f},
};

float filtered_bound(const format_bounds& f, texture_kind kind) {
    return kind == texture_kind::cube ? std::max(f.fetched, 2e-6f) : f.filtered;
}

constexpr texture_kind kinds[] = {texture_kind::flat, texture_kind::array, texture_kind::cube, texture_kind::volume};
constexpr const char* kind_names[] = {"flat", "array", "cube", "volume"};

struct owned_texture {
    texture_layout layout;
    std::vector<std::byte> bytes;

    [[nodiscard]] const_texture view() const { return {bytes, layout}; }
};

// Random texels, in [0, 1] for floats.
owned_texture random_texture(texel_format format, texture_kind kind, shapes::noise& noise) {
    owned_texture t;
    t.layout = {format, kind, kind == texture_kind::cube ? glm::ivec2(8, 8) : glm::ivec2(16, 8), 1, 1, 3};
    if (kind == texture_kind::array) t.layout.layers = 3;
    if (kind == texture_kind::cube) t.layout.layers = 6;
    if (kind == texture_kind::volume) t.layout.depth = 6;
    t.bytes.resize(t.layout.required_size());
    const auto put = [&](auto value, std::size_t i) { std::memcpy(&t.bytes[i * sizeof value], &value, sizeof value); };
    if (format == texel_format::r32f || format == texel_format::rgba32f)
        for (std::size_t i = 0; i < t.bytes.size() / 4; ++i) put(float(noise.uniform()), i);
    else if (format == texel_format::r16f || format == texel_format::rgba16f)
        for (std::size_t i = 0; i < t.bytes.size() / 2; ++i) put(to_half(float(noise.uniform())), i);
    else
        for (std::size_t i = 0; i < t.bytes.size(); ++i) put(std::uint8_t(noise.bits()), i);
    return t;
}

constexpr sampler samplers[] = {
    {address_mode::repeat, address_mode::repeat, address_mode::repeat, filter_mode::linear, filter_mode::point},
    {address_mode::clamp, address_mode::clamp, address_mode::clamp, filter_mode::linear, filter_mode::point},
    {address_mode::clamp, address_mode::mirror, address_mode::repeat, filter_mode::linear, filter_mode::linear},
    {address_mode::repeat, address_mode::clamp, address_mode::mirror, filter_mode::point, filter_mode::point},
};
constexpr int fetched = 4;  // after the samplers

// 0.9 of the way to the edges of a texel of level 0, whose edges those of other levels are as well.
float clear_of_edges(float coordinate, int texels, shapes::noise& noise) {
    const float n = float(texels);
    return (std::floor(coordinate * n) + 0.5f + 0.9f * float(noise.uniform() - 0.5)) / n;
}

// xyz: coordinates, w: level. Nearest texels and levels are only asked for where they are clear.
vec4 random_coordinates(const texture_layout& layout, const sampler& how, shapes::noise& noise) {
    vec4 c(0.0f);
    for (int k = 0; k < 3; ++k) c[k] = float(3.0 * noise.uniform() - 1.0);
    c.w = float(noise.uniform() * layout.mips);
    if (how.levels == filter_mode::point) c.w = float(noise.between(0, layout.mips - 1));
    if (layout.kind == texture_kind::array) c.z = float(noise.between(0, layout.layers - 1));
    if (how.texels == filter_mode::linear) return c;
    if (layout.kind == texture_kind::cube) {
        for (int k = 0; k < 3; ++k) c[k] = 2.0f * clear_of_edges(float(noise.uniform()), layout.extent.x, noise) - 1.0f;
        c[int(noise.bits() % 3)] = noise.bits() % 2 == 0 ? 1.0f : -1.0f;
        return c;
    }
    c.x = clear_of_edges(c.x, layout.extent.x, noise);
    c.y = clear_of_edges(c.y, layout.extent.y, noise);
    if (layout.kind == texture_kind::volume) c.z = clear_of_edges(c.z, layout.depth, noise);
    return c;
}

vec4 sampled_by_cpu(const const_texture& t, const sampler& how, vec4 c) {
    switch (t.layout.kind) {
        case texture_kind::flat: return sample(t, how, vec2(c.x, c.y), c.w);
        case texture_kind::array: return sample(t, how, vec2(c.x, c.y), c.w, int(c.z));
        case texture_kind::cube: return sample_cube(t, how, vec3(c.x, c.y, c.z), c.w);
        case texture_kind::volume: return sample_volume(t, how, vec3(c.x, c.y, c.z), c.w);
    }
    return vec4(0.0f);
}

vec4 fetched_by_cpu(const const_texture& t, vec4 c) {
    const bool volume = t.layout.kind == texture_kind::volume;
    return fetch(t, {int(c.x), int(c.y), volume ? int(c.z) : 0}, int(c.w), volume ? 0 : int(c.z));
}

// Some coordinates for each sampler, and all texels but those of cubes, which no shader fetches.
// b.x: index of the sampler, or `fetched`.
shader_run::job job_of(const owned_texture& t, shapes::noise& noise) {
    const texture_layout& l = t.layout;
    shader_run::job job;
    const auto add = [&](vec4 coordinates, int how) {
        job.inputs[0].push_back(coordinates);
        job.inputs[1].emplace_back(float(how), 0.0f, 0.0f, 0.0f);
    };
    for (int how = 0; how < fetched; ++how)
        for (int i = 0; i < 600; ++i) add(random_coordinates(l, samplers[how], noise), how);
    for (int level = 0; level < l.mips && l.kind != texture_kind::cube; ++level)
        for (int slice = 0; slice < l.layers * l.level_depth(level); ++slice)
            for (int y = 0; y < l.level_extent(level).y; ++y)
                for (int x = 0; x < l.level_extent(level).x; ++x)
                    add(vec4(float(x), float(y), float(slice), float(level)), fetched);
    while (job.inputs[0].size() % 64 != 0) add(job.inputs[0].back(), int(job.inputs[1].back().x));
    job.extent = {64, int(job.inputs[0].size() / 64)};

    const bool flat = l.kind == texture_kind::flat;
    for (int how = 0; how < fetched; ++how) {
        const std::string number = std::to_string(how);
        job.textures.push_back({"map" + number, t.view(), samplers[how]});
        job.body.append("if (int(b.x) == ").append(number).append(") result = sample_map").append(number);
        job.body += flat ? "(vec2(a.x, a.y), a.w);\n" : "(vec3(a.x, a.y, a.z), a.w);\n";
    }
    if (l.kind != texture_kind::cube)
        job.body += std::string("if (int(b.x) == 4) result = fetch_map1(") +
                    (flat ? "ivec2(int(a.x), int(a.y))" : "ivec3(int(a.x), int(a.y), int(a.z))") + ", int(a.w));\n";
    return job;
}

// Largest differences: for each sampler, and fetched.
std::array<float, 5> worst_of(const owned_texture& t, const shader_run::backend& with, shapes::noise& noise) {
    const shader_run::job job = job_of(t, noise);
    const gl::image image = shader_run::run(job, with);
    REQUIRE_MESSAGE(image.error.empty(), image.error);
    std::array<float, 5> worst = {};
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        const vec4 at = job.inputs[0][i];
        const int how = int(job.inputs[1][i].x);
        const vec4 expected =
            how == fetched ? fetched_by_cpu(t.view(), at) : sampled_by_cpu(t.view(), samplers[how], at);
        const vec4 apart = glm::abs(image.values[i] - expected);
        float& here = worst[std::size_t(how)];
        here = std::max({here, apart.x, apart.y, apart.z, apart.w});
    }
    return worst;
}

}  // namespace

TEST_CASE("textures are read as the CPU sampler reads them") {
    shapes::noise noise(11);
    for (const shader_run::backend& with : {shader_run::glsl_450, shader_run::es_300}) {
        if (const std::string why = shader_run::missing(with); !why.empty()) {
            skip::because(why);
            continue;
        }
        std::printf("%s, %s: largest differences: repeat, clamp, between levels; nearest; fetched\n", with.name.data(),
                    shader_run::context_of(with).description().c_str());
        for (const format_bounds& f : formats) {
            for (const texture_kind kind : kinds) {
                // The same driver: formats differ between the APIs, kinds do not.
                if (with.runs_on == gl::api::es && kind != texture_kind::flat && f.format != texel_format::r8) continue;
                const owned_texture t = random_texture(f.format, kind, noise);
                const char* const kind_name = kind_names[int(kind)];
                if (!shader_run::context_of(with).supports(t.layout, samplers[0])) {
                    std::printf("  %-7s %-7s not in this driver\n", f.name, kind_name);
                    continue;
                }
                INFO(with.name, " ", f.name, " ", kind_name);
                const std::array<float, 5> worst = worst_of(t, with, noise);
                std::printf("  %-7s %-7s %8.2g %8.2g %8.2g %8.2g %8.2g\n", f.name, kind_name, double(worst[0]),
                            double(worst[1]), double(worst[2]), double(worst[3]), double(worst[4]));
                CHECK(worst[0] <= filtered_bound(f, kind));
                CHECK(worst[1] <= filtered_bound(f, kind));
                CHECK(worst[2] <= filtered_bound(f, kind));
                CHECK(worst[3] <= f.nearest);
                CHECK(worst[4] <= f.fetched);
            }
        }
    }
}

// HLSL reaches the same textures by other names.
TEST_CASE("textures in HLSL") {
    if (const std::string why = shader_run::missing(shader_run::hlsl_450); !why.empty()) return skip::because(why);
    shapes::noise noise(12);
    for (const texture_kind kind : kinds) {
        INFO(kind_names[int(kind)]);
        const std::array<float, 5> worst =
            worst_of(random_texture(texel_format::rgba32f, kind, noise), shader_run::hlsl_450, noise);
        for (std::size_t how = 0; how < 3; ++how) CHECK(worst[how] <= 2e-6f);
        CHECK(worst[3] == 0.0f);
        CHECK(worst[4] == 0.0f);
    }
}
