// Every encoding of a baked map as a user would bind it, decoded by the paste files on every backend.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <bumpshadow/reference/shadow.hpp>

#include "shader/gl/encoded_maps.hpp"
#include "shader/gl/expressions.hpp"
#include "support/shader_run.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

using encoded_maps::encoded;
using glm::vec2;
using glm::vec3;
using glm::vec4;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float sharpness[] = {8.0f, 0.0f, 20.0f, 1e6f, 0.01f, infinity};

const std::vector<encoded>& every_encoding() {
    static const encoded_maps::maps maps;
    return maps.all();
}

// 64 unit vectors: all around at many elevations, some below the surface; where bearings are pieced together, and
// beside it; on the horizon; straight up and down, and almost.
std::vector<vec3> directions() {
    std::vector<vec3> result;
    for (int i = 0; i < 40; ++i) {
        const float angle = 6.2831853f * std::fmod(0.618034f * float(i), 1.0f), elevation = 0.044f * float(i) - 0.25f;
        result.emplace_back(std::cos(angle) * std::cos(elevation), std::sin(angle) * std::cos(elevation),
                            std::sin(elevation));
    }
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {-1.0f, 0.0f, 1.0f})
            for (const float turned : {0.0f, 1e-6f})
                if (x != 0.0f || y != 0.0f) result.push_back(glm::normalize(vec3(x - turned * y, y - turned, 0.5f)));
    result.insert(result.end(), {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1e-6f, -1e-7f, 1), vec3(1, 0, 0), vec3(0, -1, 0),
                                 vec3(0.6f, -0.8f, 0.0f), vec3(-0.8f, -0.0f, 0.6f), vec3(-0.0f, -0.8f, -0.6f)});
    return result;
}

// a: uv, level and k. b: the light, and what its elevation is multiplied by. c.x: part of the horizon that is left out.
constexpr const char* opening =
    "vec2 uv = vec2(a.x, a.y);\nfloat level = a.z, k = a.w;\nvec3 light = vec3(b.x, b.y, b.z);\n"
    "float horizon = 0.0f;\n";
constexpr const char* closing =
    "float elevation = bumpshadow_level(light) * b.w;\nfloat over = horizon * (1.0f - c.x);\n"
    "result = vec4(horizon, elevation, bumpshadow_shadow(elevation, over, k),\n"
    "              bumpshadow_shadow_soft(elevation, over, k, 0.5f));\n";

// Shadow factors of C++, from elevation, horizon and k.
using edge_function = float (*)(float, float, float);
float inside(float light, float over, float k) {
    return bumpshadow::shader::bumpshadow_shadow_soft(light, over, k, 1.0f);
}
float centered(float light, float over, float k) {
    return bumpshadow::shader::bumpshadow_shadow_soft(light, over, k, 0.5f);
}

std::string paste_file(const shader_run::backend& with) {
    const bool hlsl = with.source == shader_run::language::hlsl;
    return tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/bumpshadow.") + (hlsl ? "hlsl" : "glsl"));
}

bool runs(const shader_run::backend& with) {
    const std::string why = shader_run::missing(with);
    if (!why.empty()) skip::because(why);
    return why.empty();
}

// False, with a note: the driver has no such texture.
bool supported(const encoded& e, const shader_run::backend& with) {
    for (const gl::bound_texture& t : e.textures)
        if (!shader_run::context_of(with).supports(t.texture.layout, t.how)) {
            std::printf("  %s: %s not in this driver\n", with.name.data(), e.name.c_str());
            return false;
        }
    return true;
}

using group = std::vector<const encoded*>;

// Encodings that run with one shader: the same switches, and no more textures than there are units.
std::vector<group> groups(bool sampling, const shader_run::backend& with) {
    std::map<std::string, std::vector<group>> by_switches;
    for (const encoded& e : every_encoding()) {
        if ((sampling && e.sampling[0].empty()) || (sampling && e.mips > 1) || !supported(e, with)) continue;
        std::vector<group>& same = by_switches[e.switches];
        const auto textures = [](const group& g) {
            std::size_t count = 0;
            for (const encoded* other : g) count += other->textures.size();
            return count;
        };
        if (same.empty() || textures(same.back()) + e.textures.size() > 13) same.emplace_back();
        same.back().push_back(&e);
    }
    std::vector<group> result;
    for (const auto& [switches, same] : by_switches) result.insert(result.end(), same.begin(), same.end());
    return result;
}

// A row of pixels for each encoding of a group, all with the same inputs.
struct job_inputs {
    std::vector<vec4> a, b, c = {};
};

gl::image run(const group& g, bool sampling, const std::string& functions, const job_inputs& in,
              const shader_run::backend& with) {
    shader_run::job job;
    job.functions = functions;
    job.extent = {int(in.a.size()), int(g.size())};
    job.body = opening;
    const std::size_t language = with.source == shader_run::language::hlsl ? 1 : 0;
    for (std::size_t row = 0; row < g.size(); ++row) {
        const encoded& e = *g[row];
        job.body += "if (at.y == " + std::to_string(row) + ") {\n" + (sampling ? e.sampling[language] : e.code) + "}\n";
        job.textures.insert(job.textures.end(), e.textures.begin(), e.textures.end());
        for (std::size_t i = 0; i < in.a.size(); ++i) {
            job.inputs[0].push_back(in.a[i]);
            // Negative: from the encoding's own range.
            job.inputs[1].emplace_back(vec3(in.b[i]), in.b[i].w < 0.0f ? bumpshadow::stored_scale(e.scale) : in.b[i].w);
        }
        job.inputs[2].insert(job.inputs[2].end(), in.c.begin(), in.c.end());
    }
    job.body += closing;
    gl::image image = shader_run::run(job, with);
    REQUIRE_MESSAGE(image.error.empty(), image.error);
    return image;
}

// Each direction at several places, some of them beyond the map, which repeats.
job_inputs inputs_of(int places) {
    shapes::noise noise(17);
    job_inputs in;
    for (const vec3 light : directions())
        for (int i = 0; i < places; ++i) {
            const auto coordinate = [&] { return float(3.0 * noise.uniform() - 1.0); };
            const float u = coordinate(), v = coordinate();
            in.a.emplace_back(u, v, float(4.0 * noise.uniform()), sharpness[in.a.size() % std::size(sharpness)]);
            in.b.emplace_back(light, -1.0f);
        }
    return in;
}

struct worst {
    float horizon = 0.0f, elevation = 0.0f, factor = 0.0f;  // elevation in units of max(1, |elevation|)
};

// What C++ gives for each of the inputs.
struct reference {
    std::vector<float> horizon, elevation;

    reference(const encoded& e, const job_inputs& in, bool sampling) {
        for (std::size_t i = 0; i < in.a.size(); ++i) {
            const vec3 light(in.b[i]);
            // Hard cases come with the same light again and again.
            if (i > 0 && light == vec3(in.b[i - 1]) && vec3(in.a[i]) == vec3(in.a[i - 1])) {
                horizon.push_back(horizon.back());
                elevation.push_back(elevation.back());
                continue;
            }
            horizon.push_back(e.expected(vec2(in.a[i]), light, sampling || e.mips == 1 ? 0.0f : in.a[i].z));
            elevation.push_back(bumpshadow::shadow_detail::level_of(e.scale, light));
        }
    }
};

constexpr float elevation_bound = 5e-6f;  // that of the arc tangent
constexpr float factor_bound = 2e-6f;     // beside what elevation and horizon make of it

// What k makes of a difference in horizon and elevation: the factor lies between those of the ends. unit: what the
// elevation, as the snippets give it, was multiplied by.
float beyond(float factor, edge_function edge, float elevation, float unit, float horizon, float bound, float k) {
    const float slack = elevation == 0.0f ? 0.0f : elevation_bound * std::max(1.0f, std::abs(elevation));
    const float least = edge((elevation - slack) * unit, horizon + bound, k),
                most = edge((elevation + slack) * unit, horizon - bound, k);
    return std::isfinite(factor) ? std::max({0.0f, least - factor, factor - most}) : infinity;
}

worst compare(const encoded& e, const reference& expected, const job_inputs& in, const vec4* found) {
    worst w;
    const auto keep = [](float& most, float value) { most = std::isfinite(value) ? std::max(most, value) : infinity; };
    for (std::size_t i = 0; i < in.a.size(); ++i) {
        const float horizon = expected.horizon[i], elevation = expected.elevation[i];
        keep(w.horizon, std::abs(found[i].x - horizon));
        if (e.brightness) continue;
        keep(w.elevation, std::abs(found[i].y - elevation) / std::max(1.0f, std::abs(elevation)));
        const float k = in.a[i].w;
        keep(w.factor, beyond(found[i].z, inside, elevation, 1.0f, horizon, e.bound, k));
        keep(w.factor, beyond(found[i].w, centered, elevation, 1.0f, horizon, e.bound, k));
    }
    return w;
}

// Lights that a shader may come by, each with each k and with each unit of elevation: that of the encoding; one that is
// huge; and for a map without relief, whose horizon and max_slope are 0, 1 over 1e-6 in place of 0, and 1 over 0.
job_inputs bad_inputs() {
    const std::vector<vec4> lights = expressions::lights();
    job_inputs in;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        // The last ones are straight up and down, zero and denormal; before these come seams, edges and corners.
        if (i % 29 != 0 && i + 80 < lights.size() && (i % 7 != 0 || i + 728 < lights.size())) continue;
        for (const float k : {0.0f, 1e-40f, 8.0f, 1e6f, infinity})
            for (const vec2 unit : {vec2(-1.0f, 0.0f), vec2(1e30f, 0.0f), vec2(1e6f, 1.0f), vec2(infinity, 1.0f)}) {
                in.a.emplace_back(0.37f, 0.61f, 0.0f, k);
                in.b.emplace_back(vec3(lights[i]), unit.x);
                in.c.emplace_back(unit.y, 0.0f, 0.0f, 0.0f);
            }
    }
    return in;
}

float flushed(float v) { return std::fpclassify(v) == FP_SUBNORMAL ? 0.0f : v; }

// The elevation as the snippets give it.
float level_of(const bumpshadow::horizon_scale& scale, vec3 light) {
    namespace shader = bumpshadow::shader;
    return scale.stored == bumpshadow::quantity::sine    ? shader::bumpshadow_sine(light)
           : scale.stored == bumpshadow::quantity::angle ? shader::bumpshadow_angle(light)
                                                         : shader::bumpshadow_slope(light);
}

// What C++ gives for hard cases: as they are, and with 0 for denormal numbers, for which a GPU may take them.
struct bad_reference {
    job_inputs in[2];
    reference expected[2];

    explicit bad_reference(const encoded& e, const job_inputs& bad)
        : in{bad, flushed(bad)}, expected{{e, in[0], true}, {e, in[1], true}} {}

    static job_inputs flushed(job_inputs in) {
        for (vec4& v : in.b) v = vec4(::flushed(v.x), ::flushed(v.y), ::flushed(v.z), v.w);
        for (vec4& v : in.a) v.w = ::flushed(v.w);
        return in;
    }
    [[nodiscard]] bool allows(const encoded& e, std::size_t i, vec4 found, edge_function z, edge_function w) const {
        for (int k = 0; k < 2; ++k) {
            const vec4 a = in[k].a[i], b = in[k].b[i], c = in[k].c[i];
            const float unit = b.w < 0.0f ? bumpshadow::stored_scale(e.scale) : b.w, level = level_of(e.scale, vec3(b));
            const float horizon = expected[k].horizon[i], over = horizon * (1.0f - c.x), bound = e.bound * (1.0f - c.x);
            if (std::abs(found.x - horizon) <= e.bound &&
                beyond(found.z, z, level, unit, over, bound, a.w) <= factor_bound &&
                beyond(found.w, w, level, unit, over, bound, a.w) <= factor_bound)
                return true;
        }
        return false;
    }
};

// values: those of the encoding, for every input; the factors by `edge`, and centered.
void check_bad(const encoded& e, const bad_reference& expected, std::span<const vec4> values,
               edge_function edge = inside) {
    const job_inputs& in = expected.in[0];
    std::size_t wrong = 0, first = 0;
    const auto is_factor = [](float v) { return v >= 0.0f && v <= 1.0f; };
    for (std::size_t i = 0; i < in.a.size(); ++i) {
        const vec4 found = values[i];
        // An embossed texture is up to twice as bright.
        const bool good =
            e.brightness ? found.x >= 0.0f && found.x <= 2.0f
                         : is_factor(found.z) && is_factor(found.w) && expected.allows(e, i, found, edge, centered);
        if (!good && wrong++ == 0) first = i;
    }
    const vec4 at = in.b[first], found = values[first];
    CHECK_MESSAGE(wrong == 0, e.name, ": ", wrong, " of ", in.a.size(), ", first light ", at.x, ' ', at.y, ' ', at.z,
                  ", unit ", at.w, ", k ", in.a[first].w, ": ", found.x, ' ', found.y, ' ', found.z, ' ', found.w);
}

// Prints a line for each encoding: the worst of each backend. With `in`, and in the same run, what is hard.
void check_all(bool sampling, const job_inputs& in) {
    const job_inputs bad = bad_inputs();
    job_inputs both = in;
    both.a.insert(both.a.end(), bad.a.begin(), bad.a.end());
    both.b.insert(both.b.end(), bad.b.begin(), bad.b.end());
    both.c.resize(in.a.size(), vec4(0.0f));
    both.c.insert(both.c.end(), bad.c.begin(), bad.c.end());
    std::map<const encoded*, std::string> lines;
    std::map<const encoded*, reference> references;
    std::map<const encoded*, bad_reference> bad_references;
    std::string head;
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (!runs(with)) continue;
        head += (head.empty() ? "" : ", ") + std::string(with.name);
        for (const group& g : groups(sampling, with)) {
            const std::string defines = g[0]->switches + (sampling ? "#define BUMPSHADOW_SAMPLE 1\n" : "");
            const gl::image image = run(g, sampling, defines + paste_file(with), both, with);
            for (std::size_t row = 0; row < g.size(); ++row) {
                const encoded& e = *g[row];
                INFO(with.name, ", ", e.name);
                const reference& expected = references.try_emplace(&e, e, in, sampling).first->second;
                const std::span values(&image.values[row * both.a.size()], both.a.size());
                const worst w = compare(e, expected, in, values.data());
                check_bad(e, bad_references.try_emplace(&e, e, bad).first->second, values.subspan(in.a.size()));
                char text[32];
                std::snprintf(text, sizeof text, "%-9.2g", double(w.horizon));
                lines[&e] += text;
                CHECK(w.horizon <= e.bound);
                CHECK(w.elevation <= elevation_bound);
                CHECK(w.factor <= factor_bound);
            }
        }
    }
    std::printf("largest differences of the stored horizon from C++; bound: %s\n", head.c_str());
    for (const encoded& e : every_encoding())
        if (!lines[&e].empty()) std::printf("  %s %-8.2g %s\n", lines[&e].c_str(), double(e.bound), e.name.c_str());
}

}  // namespace

TEST_CASE(
    "horizons and shadow factors of every encoding are those of C++, with lights, k and max_slope that are none, too") {
    CHECK(directions().size() == 64);
    check_all(false, inputs_of(16));
}

TEST_CASE("the functions that sample give the same") { check_all(true, inputs_of(4)); }

TEST_CASE("with every edge the factor is in [0, 1] and that of C++") {
    namespace shader = bumpshadow::shader;
    constexpr struct {
        const char* defines;
        edge_function edge;
    } edges[] = {
        {"#define BUMPSHADOW_EDGE 0\n",
         [](float light, float over, float) { return shader::bumpshadow_shadow_hard(light, over); }},
        {"#define BUMPSHADOW_EDGE 2\n", centered},
        {"#define BUMPSHADOW_BELOW 0\n",
         [](float light, float over, float k) { return shader::bumpshadow_shadow_soft_above(light, over, k, 1.0f); }},
        {"#define BUMPSHADOW_EDGE 2\n#define BUMPSHADOW_BELOW 0\n",
         [](float light, float over, float k) { return shader::bumpshadow_shadow_soft_above(light, over, k, 0.5f); }},
    };
    const job_inputs in = bad_inputs();
    for (const shader_run::backend& with : shader_run::all_backends) {
        if (!runs(with)) continue;
        const std::vector<group> all = groups(false, with);
        const encoded& e = *all[0][0];
        for (const auto& one : edges) {
            INFO(with.name, ", ", one.defines);
            check_bad(e, bad_reference(e, in),
                      run({&e}, false, e.switches + one.defines + paste_file(with), in, with).values, one.edge);
        }
    }
}

// A comparison that could not fail would be worth nothing.
TEST_CASE("a changed decoder is noticed") {
    const shader_run::backend with = shader_run::glsl_450;
    if (!runs(with)) return;
    const job_inputs in = inputs_of(4);
    constexpr struct {
        const char *encoding, *from, *to;
    } changes[] = {
        {"tangent volume, r8", "return bearing + offset", "return bearing - offset"},
        {"tangent volume, r16f", "0.15703793", "0.15603793"},
        {"slices, array, r16f", "position - layer)", "position)"},
        {"slice layers, four", "0.24999996", "0.2"},
        {"slice layers, overlapping", "0.33333328", "0.3"},
        {"sine layers, array", "0.3355101", "0.4355101"},
        {"sine layers, biased cube", "texel * -2.007874", "texel * -1.8"},
        {"Fourier 5, 8 bits", "lower.x + higher.x", "lower.x - higher.x"},
        {"Fourier 9, 16 bits, roots", "return root * abs(root)", "return root"},
        {"SSBump, rgba8, y down", "0.81649658 * v.x", "0.79649658 * v.x"},
        {"emboss", "0.50196078", "0.45"},
        {"tangent volume, r16f", "(light - horizon) + c", "(light - horizon) + 0.999 * c"},
        {"tangent volume, r16f", "light.z * inversesqrt", "1.00001 * light.z * inversesqrt"},
    };
    for (const auto& change : changes) {
        CAPTURE(change.encoding);
        std::string functions = paste_file(with);
        const auto& all = every_encoding();
        const auto e =
            std::find_if(all.begin(), all.end(), [&](const encoded& other) { return other.name == change.encoding; });
        REQUIRE(e != all.end());
        REQUIRE(functions.find(change.from) != std::string::npos);
        for (std::size_t at = 0; (at = functions.find(change.from, at)) != std::string::npos;
             at += std::string_view(change.to).size())
            functions.replace(at, std::string_view(change.from).size(), change.to);
        const gl::image image = run({&*e}, false, e->switches + functions, in, with);
        const worst w = compare(*e, reference(*e, in, false), in, image.values.data());
        const bool noticed = w.horizon > e->bound || w.elevation > elevation_bound || w.factor > factor_bound;
        CHECK_MESSAGE(noticed, change.encoding, ": ", change.from);
    }
}
