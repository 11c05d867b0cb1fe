#include "shader/gl/expressions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include <doctest/doctest.h>

#include "source.hpp"
#include "support/skip.hpp"

namespace expressions {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float flushed(float v) { return std::fpclassify(v) == FP_SUBNORMAL ? std::copysign(0.0f, v) : v; }

inputs flushed(const inputs& in) {
    inputs result;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) result.values[i][k] = flushed(in.values[i][k]);
    return result;
}

float apart(vec4 expected, vec4 found) {
    float worst = 0.0f;
    for (int k = 0; k < 4; ++k) {
        if (!std::isfinite(expected[k]) || !std::isfinite(found[k])) return infinity;
        const float difference = std::abs(flushed(found[k]) - flushed(expected[k]));
        worst = std::max(worst, difference / std::max(1.0f, std::abs(expected[k])));
    }
    return worst;
}

std::string described(const difference& d) {
    const auto text = [](const vec4& v) {
        char numbers[96];
        std::snprintf(numbers, sizeof numbers, "(%.9g %.9g %.9g %.9g)", double(v.x), double(v.y), double(v.z),
                      double(v.w));
        return std::string(numbers);
    };
    return text(d.found) + " is not " + text(d.expected) + " for a " + text(d.at.values[0]) + " b " +
           text(d.at.values[1]) + " c " + text(d.at.values[2]) + " d " + text(d.at.values[3]);
}

// A row of pixels for each expression; wide() as above.
shader_run::job job_of(std::span<const expression> table, std::span<const inputs> at) {
    shader_run::job job;
    job.extent = {int(at.size()), int(table.size())};
    for (int i = 0; i < 4; ++i)
        for (std::size_t row = 0; row < table.size(); ++row)
            for (const inputs& in : at) job.inputs[i].push_back(in.values[i]);
    for (std::size_t row = 0; row < table.size(); ++row)
        job.body += "    if (at.y == " + std::to_string(row) + ") result = wide(" + table[row].text + ");\n";
    return job;
}

constexpr const char* wide_in_shader =
    "vec4 wide(bool v) { return vec4(v ? 1.0f : 0.0f, 0.0f, 0.0f, 0.0f); }\n"
    "vec4 wide(float v) { return vec4(v, 0.0f, 0.0f, 0.0f); }\n"
    "vec4 wide(vec2 v) { return vec4(v.x, v.y, 0.0f, 0.0f); }\n"
    "vec4 wide(vec3 v) { return vec4(v.x, v.y, v.z, 0.0f); }\n"
    "vec4 wide(vec4 v) { return v; }\n";

std::string in_language(std::string_view glsl, const shader_run::backend& with) {
    return with.source == shader_run::language::hlsl ? shaders::hlsl(glsl) : std::string(glsl);
}

}  // namespace

std::vector<vec4> lights() {
    std::vector<vec3> directions;
    for (int i = 0; i < 48; ++i) {
        const float angle = 6.2831853f * float(i) / 48.0f;
        for (const float slope : {-0.5f, 0.0f, 0.02f, 0.7f, 9.0f})
            directions.emplace_back(std::cos(angle), std::sin(angle), slope);
    }
    // Axes and diagonals, where bearings are pieced together, and next to them; edges and corners of a cube; grazing.
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {-1.0f, 0.0f, 1.0f})
            for (const float turned : {0.0f, 1e-6f, -1e-6f})
                for (const float z : {0.4f, -0.3f, 1.0f, -1.0f, 1e-7f, -1e-7f})
                    directions.emplace_back(x - turned * y, y + turned * x, z);
    for (const float z : {1.0f, -1.0f}) {
        directions.emplace_back(0.0f, 0.0f, z);
        directions.emplace_back(-0.0f, -0.0f, z);
        directions.emplace_back(1e-6f, -1e-7f, z);
        directions.emplace_back(0.0f, -1e-4f, z);
    }
    std::vector<vec4> result;
    for (const vec3 v : directions)
        for (const float length : {1.0f, 1e-10f, 3e-4f, 1e10f}) result.emplace_back(v * length, 0.0f);
    for (const float x : {0.0f, 1e-40f, -1e-40f, 1e-45f})
        for (const float y : {0.0f, 2e-40f, -3e-41f})
            for (const float z : {0.0f, 1e-40f, -1e-40f, 1.0f}) result.emplace_back(x, y, z, 0.0f);
    return result;
}

std::string snippets(const shader_run::backend& with) {
    static const shaders::source source = shaders::read_source(BUMPSHADOW_SHADER_FOLDER);
    std::string text;
    for (const shaders::snippet& s : source.snippets) text += s.code + '\n';
    return in_language(text, with);
}

outcome compare(std::span<const expression> table, std::span<const inputs> at, std::string functions,
                const shader_run::backend& with) {
    shader_run::job job = job_of(table, at);
    job.functions = std::move(functions) + in_language(wide_in_shader, with);
    auto [error, values] = shader_run::run(job, with);
    outcome result{std::move(error), {}};
    if (!result.error.empty()) return result;
    for (std::size_t row = 0; row < table.size(); ++row) {
        difference d;
        d.least = infinity;
        d.most = -infinity;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const vec4 found = values[row * at.size() + i];
            const vec4 expected = table[row].evaluate(at[i].values);
            const vec4 expected_flushed = table[row].evaluate(flushed(at[i]).values);
            const float here = std::min(apart(expected, found), apart(expected_flushed, found));
            d.least = std::min(d.least, found.x);
            d.most = std::max(d.most, found.x);
            if (here <= d.worst) continue;
            d.worst = here;
            d.at = at[i];
            d.expected = expected;
            d.found = found;
        }
        result.differences.push_back(d);
    }
    return result;
}

std::vector<outcome> check(std::span<const expression> table, std::span<const inputs> at) {
    std::vector<outcome> results;
    std::string head;
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (const std::string why = shader_run::missing(with); !why.empty()) {
            skip::because(why);
            continue;
        }
        CAPTURE(with.name);
        outcome result = compare(table, at, snippets(with), with);
        REQUIRE_MESSAGE(result.error.empty(), result.error);
        for (std::size_t row = 0; row < table.size(); ++row) {
            const difference& d = result.differences[row];
            INFO(table[row].text, ": ", described(d));
            CHECK(d.worst <= table[row].bound);
        }
        results.push_back(std::move(result));
        head += (head.empty() ? "" : ", ") + std::string(with.name);
    }
    std::printf("largest differences from C++, in units of max(1, |value|): %s\n", head.c_str());
    for (std::size_t row = 0; row < table.size(); ++row) {
        for (const outcome& result : results) std::printf("%-9.2g", double(result.differences[row].worst));
        std::printf("%s\n", table[row].text);
    }
    return results;
}

}  // namespace expressions
