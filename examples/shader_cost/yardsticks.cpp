#include "shader_cost/cases.hpp"

namespace examples {
namespace {

constexpr const char* volume = "layout(binding = 0) uniform sampler3D horizons;\n";
constexpr const char* layers_and_cube =
    "layout(binding = 0) uniform sampler2DArray horizons;\nlayout(binding = 1) uniform samplerCube factor_cube;\n";
constexpr const char* one_texture = "layout(binding = 0) uniform sampler2D map;\n";
constexpr const char* two_textures =
    "layout(binding = 0) uniform sampler2D map;\nlayout(binding = 1) uniform sampler2D constant_map;\n";
constexpr const char* normal_and_lightmaps =
    "layout(binding = 0) uniform sampler2D map;\nlayout(binding = 1) uniform sampler2D red;\n"
    "layout(binding = 2) uniform sampler2D green;\nlayout(binding = 3) uniform sampler2D blue;\n";

// Lengyel, Smooth Horizon Mapping, listing 5.1.
constexpr const char* lengyel = R"(    vec3 L = normalize(light);
    vec4 factors = textureLod(factor_cube, L, 0.0);
    vec4 f0 = clamp(factors * 2.0 - 1.0, 0.0, 1.0);
    vec4 f1 = clamp(factors * -2.0 + 1.0, 0.0, 1.0);
    float s0 = dot(textureLod(horizons, vec3(uv, 0.0), 0.0), f0);
    float s1 = dot(textureLod(horizons, vec3(uv, 1.0), 0.0), f1);
    return clamp((L.z - (s0 + s1)) * 8.0 + 1.0, 0.0, 1.0);
)";

// Forsyth, Self-shadowing Bumpmap, section 4.1, and what the slope of section 4 needs.
constexpr const char* forsyth_bearing = R"(    float inverse = inversesqrt(dot(light.xy, light.xy));
    vec2 vec = light.xy * inverse;
    float angle;
    if (vec.x >= vec.y) {
        if (vec.x >= -vec.y) angle = vec.y * (0.25 / 1.414) + 0.75 + (0.707 * (0.25 / 1.414));
        else angle = vec.x * (0.25 / 1.414) + 0.5 + (0.707 * (0.25 / 1.414));
    } else {
        if (vec.x >= -vec.y) angle = vec.x * (-0.25 / 1.414) + 0.0 + (-0.707 * (-0.25 / 1.414));
        else angle = vec.y * (-0.25 / 1.414) + 0.25 + (-0.707 * (-0.25 / 1.414));
    }
)";
// A pixel, with the edge of the listing above.
constexpr const char* forsyth_soft = R"(    float horizon = textureLod(horizons, vec3(uv, angle + offset), 0.0).x;
    return clamp((light.z * inverse - horizon * max_slope) * 8.0 + 1.0, 0.0, 1.0);
)";
// A vertex; the slope is cut, since it "can be clamped quite early".
constexpr const char* forsyth_vertex = "    return vec2(angle + offset, clamp(light.z * inverse, -most, most));\n";
// Section 4.2, with the horizon stored around 0.5: what "sub" and "cnd" do.
constexpr const char* forsyth_pixel = R"(    float horizon = textureLod(horizons, vec3(uv, light.x), 0.0).x;
    return light.y - (horizon - 0.5) > 0.5 ? 1.0 : 0.0;
)";

constexpr const char* arc_tangent = R"(    float slope = light.z * inversesqrt(dot(light.xy, light.xy));
    float horizon = textureLod(horizons, vec3(uv, atan(light.y, light.x) * 0.15915494 + offset), 0.0).x;
    return clamp((slope - horizon * max_slope) * 8.0 + 1.0, 0.0, 1.0);
)";

// Self-shadowing textures using radial horizon maps (2010), the listing as it stands.
constexpr const char* fourier = R"(    vec3 n = normalize(light);
    vec4 coefficients = textureLod(map, uv, 0.0) * 4.0 - 2.0;
    float constant = textureLod(constant_map, uv, 0.0).x * 2.0 - 1.0;
    coefficients *= abs(coefficients);
    constant *= abs(constant);
    vec2 radial = normalize(vec3(light.xy, 0.0)).xy;
    vec3 multipliers = radial.xyx * radial.yyx * vec3(2.0, 1.0, -1.0);
    float horizon = constant + dot(coefficients.rg, radial) + dot(coefficients.baa, multipliers);
    return clamp(0.5 + 20.0 * (LIGHT - horizon), 0.0, 1.0);
)";

constexpr const char* ray_march = R"(    vec3 step = vec3(light.xy / light.z, 1.0) * (1.0 / 16.0);
    vec3 p = vec3(uv, textureLod(map, uv, 0.0).x);
    step.z *= 1.0 - p.z;
    step.xy *= max_slope * (1.0 - p.z);
    float clear = 1.0;
    for (int i = 0; i < 16; ++i) {
        p += step;
        clear = min(clear, p.z - textureLod(map, p.xy, 0.0).x);
    }
    return clamp(8.0 * clear + 1.0, 0.0, 1.0);
)";

// Radiosity normal mapping (McTaggart, Half-Life 2 / Valve Source Shading, 2004), basis as in Ols 2010.
constexpr const char* radiosity = R"(    vec3 n = textureLod(map, uv, 0.0).xyz * 2.0 - 1.0;
    vec3 d = vec3(dot(n, vec3(0.81649658, 0.0, 0.57735027)), dot(n, vec3(-0.40824829, 0.70710678, 0.57735027)),
                  dot(n, vec3(-0.40824829, -0.70710678, 0.57735027)));
    d = clamp(d, 0.0, 1.0);
    d *= d;
    vec3 sum = d.x * textureLod(red, uv, 0.0).xyz + d.y * textureLod(green, uv, 0.0).xyz +
               d.z * textureLod(blue, uv, 0.0).xyz;
    return sum / dot(d, vec3(1.0));
)";

constexpr const char* product = R"(    vec3 masks = textureLod(map, uv, 0.0).xyz;
    vec3 d = vec3(dot(light, vec3(0.81649658, 0.0, 0.57735027)),
                  dot(light, vec3(-0.40824829, 0.70710678, 0.57735027)),
                  dot(light, vec3(-0.40824829, -0.70710678, 0.57735027)));
    return dot(masks, clamp(d, 0.0, 1.0));
)";

constexpr const char* normal_reflection = R"(    vec3 n = normalize(textureLod(map, uv, 0.0).xyz * 2.0 - 1.0);
    return reflect(-light, n);
)";

constexpr const char* normal_light = R"(    vec3 n = textureLod(map, uv, 0.0).xyz * 2.0 - 1.0;
    return clamp(dot(n, light), 0.0, 1.0);
)";

std::string fourier_with(const std::string& light) {
    std::string text = fourier;
    return text.replace(text.find("LIGHT"), 5, light);
}

}  // namespace

shader_case empty_case(const std::string& result) {
    const char* body = result == "float"  ? "    return uv.x + uv.y + light.x + light.y + light.z;\n"
                       : result == "vec2" ? "    return uv + light.xy + light.z;\n"
                       : result == "vec3" ? "    return light + vec3(uv, 0.0);\n"
                                          : "    return mat3(light, light.yzx, light.zxy);\n";
    return {"harness", "empty, " + result, "", result, body};
}

std::vector<shader_case> yardsticks() {
    const std::string group = "yardstick";
    return {
        {group, "Lengyel, listing 5.1", layers_and_cube, "float", lengyel},
        {group, "Forsyth, bearing as published", volume, "float", std::string(forsyth_bearing) + forsyth_soft},
        {group, "Forsyth, vertex: bearing as published, slope", "", "vec2",
         std::string(forsyth_bearing) + forsyth_vertex},
        {group, "Forsyth, pixel: sub and cnd", volume, "float", forsyth_pixel},
        {group, "arc tangent and volume", volume, "float", arc_tangent},
        {group, "Fourier, 5, as published", two_textures, "float", fourier_with("light.z")},
        {group, "Fourier, 5, with the unit vector that is meant", two_textures, "float", fourier_with("n.z")},
        {group, "ray march, 16 steps", one_texture, "float", ray_march},
        {group, "normal map, one dynamic light", one_texture, "float", normal_light},
        {group, "normal map, reflection", one_texture, "vec3", normal_reflection},
        {group, "normal map, three lightmaps", normal_and_lightmaps, "vec3", radiosity},
        {group, "SSBump, one dynamic light, 3 x 3 product", one_texture, "float", product},
    };
}

}  // namespace examples
