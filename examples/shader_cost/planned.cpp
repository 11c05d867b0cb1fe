#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/texture.hpp>

#include "shader_cost/cases.hpp"

namespace examples {
namespace {

using bumpshadow::bearing_function;
using bumpshadow::texture_kind;

struct named_function {
    bearing_function function;
    const char* name;
};

// What fetches the horizon at `at`.
std::string fetch(texture_kind kind, bool arc) {
    if (kind == texture_kind::flat) return "textureLod(horizons, at, 0.0).x;\n";
    if (kind == texture_kind::volume)
        return std::string("textureLod(horizons, vec3(at, ") +
               (arc ? "bumpshadow_arc_coordinate(bearing, 0.3, 2.0, 0.1)"
                    : "bumpshadow_volume_coordinate(bearing, offset)") +
               "), 0.0).x;\n";
    return "bumpshadow_tangent_horizon(textureLod(horizons, vec3(at, layers.x), 0.0).x, "
           "textureLod(horizons, vec3(at, layers.y), 0.0).x, layers.z);\n";
}

planned_case planned(texture_kind kind, const named_function& function, bool arc, int taps) {
    bumpshadow::tangent_volume encoding;
    encoding.kind = kind;
    encoding.slices.function = function.function;
    if (arc) encoding.slices.arc = 0.25f;

    planned_case one;
    one.planned = bumpshadow::gpu_cost_of(encoding, taps);
    std::string sampler = "sampler2D", body;
    std::string& name = one.which.name;
    if (kind == texture_kind::flat) {
        name = "one slice";
    } else {
        name = std::string(kind == texture_kind::volume ? "volume" : "array") + (arc ? " over an arc, " : ", ") +
               function.name;
        sampler = kind == texture_kind::volume ? "sampler3D" : "sampler2DArray";
        body = std::string("    vec2 v = vec2(light.x, light.y);\n    float bearing = bumpshadow_bearing_") +
               function.name + "(v);\n";
    }
    if (kind == texture_kind::array)
        body += arc ? "    vec3 layers = bumpshadow_arc_layers(bearing, 0.3, 32.0, 0.1, 16.0);\n"
                    : "    vec3 layers = bumpshadow_tangent_layers(bearing, phase, 16.0);\n";
    if (taps == 1) {
        name += ", hard";
        body += "    vec2 at = uv;\n    float horizon = " + fetch(kind, arc) +
                "    return bumpshadow_shadow_hard(bumpshadow_slope(light), horizon * max_slope);\n";
    } else {
        const std::string n = std::to_string(taps);
        name += ", " + n + " x " + n + " places of a pixel";
        body += "    float l = bumpshadow_slope(light) * some_k, sum = 0.0;\n    const float n = " + n + ".0;\n" +
                "    for (float i = 0.0; i < n * n; i += 1.0) {\n" +
                "        vec2 at = uv + bumpshadow_pixel_place(i, n) * some_offset;\n        float horizon = " +
                fetch(kind, arc) + "        sum += bumpshadow_shadow_soft_above(l, horizon, k, 0.5);\n    }\n" +
                "    return sum / (n * n);\n";
    }
    one.which.group = "planned";
    one.which.textures = "layout(binding = 0) uniform " + sampler + " horizons;\n";
    one.which.result = "float";
    one.which.body = body;
    return one;
}

}  // namespace

std::vector<planned_case> planned_cases() {
    const named_function exact{bearing_function::exact, "exact"}, cubic{bearing_function::cubic, "cubic"},
        octant{bearing_function::octant, "octant"};
    std::vector<planned_case> all;
    for (const int taps : {1, 2, 4}) all.push_back(planned(texture_kind::flat, octant, false, taps));
    for (const texture_kind kind : {texture_kind::volume, texture_kind::array})
        for (const bool arc : {false, true}) {
            for (const named_function& function : {exact, cubic, octant})
                all.push_back(planned(kind, function, arc, 1));
            for (const int taps : {2, 4}) all.push_back(planned(kind, octant, arc, taps));
        }
    return all;
}

}  // namespace examples
