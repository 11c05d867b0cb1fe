// That shaders run as they are meant to: what the other tests rest on.

#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/gl.hpp"
#include "support/hlsl.hpp"
#include "support/shader_run.hpp"
#include "support/skip.hpp"

using glm::vec4;

namespace {

// Whether the backend runs here; says so where not.
bool runs(const shader_run::backend& with) {
    const std::string why = shader_run::missing(with);
    if (!why.empty()) skip::because(why);
    return why.empty();
}

}  // namespace

TEST_CASE("pixels and their inputs are where they should be") {
    shader_run::job job;
    job.extent = {5, 3};
    for (int i = 0; i < 15; ++i) {
        job.inputs[0].emplace_back(float(i), 0.1f, -1e30f, 1.0f);
        job.inputs[2].emplace_back(0.0f, 0.0f, 0.0f, float(i * i));
    }
    job.body = "result = vec4(float(at.x), float(at.y), a.x + c.w, a.z);";
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (!runs(with)) continue;
        CAPTURE(with.name);
        const gl::image image = shader_run::run(job, with);
        REQUIRE_MESSAGE(image.error.empty(), image.error);
        REQUIRE(image.values.size() == 15);
        for (int y = 0; y < 3; ++y) {
            for (int x = 0; x < 5; ++x) {
                const int i = 5 * y + x;
                CHECK(image.values[std::size_t(i)] == vec4(float(x), float(y), float(i + i * i), -1e30f));
            }
        }
    }
}

TEST_CASE("errors of the compiler come back as text") {
    shader_run::job job;
    job.extent = {1, 1};
    job.body = "result = undeclared_thing(a);";
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (!runs(with)) continue;
        CAPTURE(with.name);
        CHECK(shader_run::run(job, with).error.find("undeclared_thing") != std::string::npos);
    }
}

TEST_CASE("compute shaders read and write buffers") {
    constexpr std::string_view body =
        "void main() { uint i = gl_GlobalInvocationID.x; sums[i] = values[i] * factors.y + sums[i]; }\n";
    const std::string declarations =
        "layout(local_size_x = 16) in;\n"
        "layout(std430, binding = 0) readonly buffer Values { float values[]; };\n"
        "layout(std430, binding = 1) buffer Sums { float sums[]; };\n"
        "layout(std140, binding = 0) uniform Constants { vec4 factors; };\n";
    const std::string hlsl_text =
        "StructuredBuffer<float> values : register(t0);\n"
        "RWStructuredBuffer<float> sums : register(u1);\n"
        "cbuffer Constants : register(b0) { float4 factors; };\n"
        "[numthreads(16, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {\n"
        "    sums[id.x] = values[id.x] * factors.y + sums[id.x];\n"
        "}\n";
    for (const shader_run::backend& with : {shader_run::glsl_450, shader_run::es_310, shader_run::hlsl_450}) {
        if (!runs(with)) continue;
        CAPTURE(with.name);
        std::string text = std::string(with.header) + declarations + std::string(body);
        if (with.source == shader_run::language::hlsl) {
            const hlsl::translation translated = hlsl::to_glsl(hlsl_text, "comp");
            REQUIRE_MESSAGE(translated.error.empty(), translated.error);
            text = translated.glsl;
        } else if (with.runs_on == gl::api::es) {
            text.insert(with.header.size(), shader_run::es_precision);
        }
        std::vector<float> values(64), sums(64, 0.5f), constants = {0.0f, 3.0f, 0.0f, 0.0f};
        std::iota(values.begin(), values.end(), 0.0f);
        const gl::bound_buffer buffers[] = {{std::as_writable_bytes(std::span(values))},
                                            {std::as_writable_bytes(std::span(sums))},
                                            {std::as_writable_bytes(std::span(constants)), true}};
        const std::string error = gl::run_compute(shader_run::context_of(with), text, {4, 1, 1}, buffers);
        REQUIRE_MESSAGE(error.empty(), error, text);
        for (std::size_t i = 0; i < 64; ++i) CHECK(sums[i] == 3.0f * float(i) + 0.5f);
    }
}
