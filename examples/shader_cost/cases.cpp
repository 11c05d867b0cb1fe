#include "shader_cost/cases.hpp"

namespace examples {
namespace {

constexpr const char* volume = "layout(binding = 0) uniform sampler3D horizons;\n";
constexpr const char* layers = "layout(binding = 0) uniform sampler2DArray horizons;\n";
constexpr const char* layers_and_cube =
    "layout(binding = 0) uniform sampler2DArray horizons;\nlayout(binding = 1) uniform samplerCube factor_cube;\n";
constexpr const char* masks_and_lightmaps =
    "layout(binding = 0) uniform sampler2D map;\nlayout(binding = 1) uniform sampler2D red;\n"
    "layout(binding = 2) uniform sampler2D green;\nlayout(binding = 3) uniform sampler2D blue;\n";
constexpr const char* two_textures =
    "layout(binding = 0) uniform sampler2D map;\nlayout(binding = 1) uniform sampler2D map1;\n";
constexpr const char* three_textures =
    "layout(binding = 0) uniform sampler2D map;\nlayout(binding = 1) uniform sampler2D map1;\n"
    "layout(binding = 2) uniform sampler2D map2;\n";
constexpr const char* one_texture = "layout(binding = 0) uniform sampler2D map;\n";

struct edge {
    std::string name, code;  // from float l and float horizon
};

const edge soft{"soft", "    return bumpshadow_shadow_soft(l, horizon, k, 1.0);\n"};
const edge centered{"centered", "    return bumpshadow_shadow_soft(l, horizon, k, 0.5);\n"};
const edge hard{"hard", "    return bumpshadow_shadow_hard(l, horizon);\n"};
const edge soft_above{"soft, light above the surface",
                      "    return bumpshadow_shadow_soft_above(l, horizon, k, 1.0);\n"};
const edge centered_above{"centered, light above the surface",
                          "    return bumpshadow_shadow_soft_above(l, horizon, k, 0.5);\n"};
const edge hard_above{"hard, light above the surface", "    return l >= horizon ? 1.0 : 0.0;\n"};

const std::string direction = "    vec2 v = vec2(light.x, light.y);\n";
const std::string sine = "    float l = bumpshadow_sine(light);\n";
const std::string slope = "    float l = bumpshadow_slope(light);\n    horizon *= max_slope;\n";

constexpr const char* angle_of_one = "    horizon *= 1.57079633;\n";

std::string bearing(const std::string& function) {
    return direction + "    float bearing = bumpshadow_bearing_" + function + "(v);\n";
}

constexpr const char* fetch_volume =
    "    float horizon = textureLod(horizons, vec3(uv, bumpshadow_volume_coordinate(bearing, offset)), 0.0).x;\n";
constexpr const char* fetch_tangent_layers = R"(    vec3 at = bumpshadow_tangent_layers(bearing, phase, 16.0);
    float horizon = bumpshadow_tangent_horizon(textureLod(horizons, vec3(uv, at.x), 0.0).x,
                                               textureLod(horizons, vec3(uv, at.y), 0.0).x, at.z);
)";
constexpr const char* fetch_grouped =
    R"(    vec3 at = bumpshadow_grouped_layers(bumpshadow_slice_position(bearing, phase, 16.0), 4.0);
    vec4 values = textureLod(horizons, vec3(uv, at.x), 0.0);
    float horizon = bumpshadow_grouped_horizon(values, textureLod(horizons, vec3(uv, at.y), 0.0).x, at.z);
)";
constexpr const char* fetch_overlapping =
    R"(    vec2 at = bumpshadow_overlapping_layer(bumpshadow_slice_position(bearing, phase, 24.0));
    float horizon = bumpshadow_overlapping_horizon(textureLod(horizons, vec3(uv, at.x), 0.0), at.y);
)";

constexpr const char* both_layers =
    "    vec4 layer0 = textureLod(horizons, vec3(uv, 0.0), 0.0);\n"
    "    vec4 layer1 = textureLod(horizons, vec3(uv, 1.0), 0.0);\n";
constexpr const char* chosen_layers = R"(    float first = bumpshadow_sine_first_layer(v);
    float second = textureLod(horizons, vec3(uv, 1.0 - first), 0.0).x;
    float horizon = bumpshadow_sine_half(textureLod(horizons, vec3(uv, first), 0.0), second, v);
)";
constexpr const char* with_factors = "    float horizon = bumpshadow_sine_layers_factors(layer0, layer1, factors);\n";

void add_slices(std::vector<shader_case>& all) {
    const std::string group = "tangent volume";
    for (const char* f : {"exact", "quintic", "cubic", "octant", "diamond"}) {
        all.push_back(
            {group, std::string(f) + ", soft", volume, "float", bearing(f) + fetch_volume + slope + soft.code});
        all.push_back({group, std::string(f) + ", " + soft_above.name, volume, "float",
                       bearing(f) + fetch_volume + slope + soft_above.code});
    }
    for (const edge& e : {centered, centered_above, hard, hard_above})
        all.push_back({group, "cubic, " + e.name, volume, "float", bearing("cubic") + fetch_volume + slope + e.code});
    all.push_back({group, "cubic, sines, soft", volume, "float", bearing("cubic") + fetch_volume + sine + soft.code});
    all.push_back(
        {group, "cubic, angles, soft", volume, "float",
         bearing("cubic") + fetch_volume + "    float l = bumpshadow_angle(light);\n" + angle_of_one + soft.code});
    all.push_back({group, "cubic, soft, ending with distance", volume, "float",
                   bearing("cubic") + fetch_volume + slope +
                       "    float factor = bumpshadow_shadow_soft(l, horizon, k, 1.0);\n"
                       "    return bumpshadow_shadow_fade(factor, uv.x, some_k, some_offset);\n"});
    for (const char* taps : {"2", "4"})
        all.push_back(
            {group, std::string("cubic, centered, lights above, ") + taps + " x " + taps + " places of a pixel", volume,
             "float",
             bearing("cubic") + "    float l = bumpshadow_slope(light) * some_k, sum = 0.0;\n    const float n = " +
                 taps + ".0;\n    for (float i = 0.0; i < n * n; i += 1.0) {\n" +
                 "        vec2 at = uv + bumpshadow_pixel_place(i, n) * some_offset;\n" +
                 "        float w = bumpshadow_volume_coordinate(bearing, offset);\n" +
                 "        float horizon = textureLod(horizons, vec3(at, w), 0.0).x;\n" +
                 "        sum += bumpshadow_shadow_soft_above(l, horizon, k, 0.5);\n    }\n" +
                 "    return sum / (n * n);\n"});
    std::string uniforms = bearing("cubic") + fetch_volume + slope + soft.code;
    uniforms.replace(uniforms.find("offset)"), 6, "some_offset");
    uniforms.replace(uniforms.find(", k,"), 3, ", some_k");
    all.push_back({group, "cubic, soft, everything in uniforms", volume, "float", uniforms});
    all.push_back({group, "cubic, array of single slices, soft", layers, "float",
                   bearing("cubic") + fetch_tangent_layers + slope + soft.code});
    // Slices over an arc: the lookups above with another coordinate.
    std::string arc = fetch_volume, arc_layers = fetch_tangent_layers;
    arc.replace(arc.find("bumpshadow_volume_coordinate(bearing, offset)"), 45,
                "bumpshadow_arc_coordinate(bearing, 0.3, 2.0, 0.1)");
    arc_layers.replace(arc_layers.find("bumpshadow_tangent_layers(bearing, phase, 16.0)"), 47,
                       "bumpshadow_arc_layers(bearing, 0.3, 32.0, 0.1, 16.0)");
    all.push_back({group, "cubic, over an arc, soft", volume, "float", bearing("cubic") + arc + slope + soft.code});
    all.push_back({group, "cubic, over an arc, array of single slices, soft", layers, "float",
                   bearing("cubic") + arc_layers + slope + soft.code});
    all.push_back({group, "one slice for a fixed light, soft", one_texture, "float",
                   "    float horizon = textureLod(map, uv, 0.0).x;\n" + slope + soft.code});
    for (const char* f : {"cubic", "octant"})
        for (const edge& e : {soft, soft_above}) {
            const std::string name = std::string(", ") + f + ", " + e.name;
            all.push_back({"slice layers", "grouped, two fetches" + name, layers, "float",
                           bearing(f) + fetch_grouped + slope + e.code});
            all.push_back({"slice layers", "overlapping, one fetch" + name, layers, "float",
                           bearing(f) + fetch_overlapping + slope + e.code});
        }
}

void add_eight_channels(std::vector<shader_case>& all) {
    const std::string group = "eight channels";
    const std::string cube = "    vec4 texel = textureLod(factor_cube, light, 0.0);\n";
    for (const edge& e : {soft, soft_above}) {
        for (const char* kind : {"published", "biased"})
            all.push_back({group, std::string(kind) + " cube, sines, " + e.name, layers_and_cube, "float",
                           cube + both_layers + "    bumpshadow_eight factors = bumpshadow_factors_" + kind +
                               "_cube(texel);\n" + with_factors + sine + e.code});
        all.push_back({group, "biased cube, no structure, sines, " + e.name, layers_and_cube, "float",
                       cube + both_layers +
                           "    float horizon = bumpshadow_sine_layers_biased_cube(layer0, layer1, texel);\n" + sine +
                           e.code});
        all.push_back({group, "no cube, layers chosen, sines, " + e.name, layers, "float",
                       direction + chosen_layers + sine + e.code});
        all.push_back({group, "no cube, layers chosen, slopes, " + e.name, layers, "float",
                       direction + chosen_layers + slope + e.code});
        all.push_back({group, "no cube, sines, " + e.name, layers, "float",
                       direction + both_layers + "    float horizon = bumpshadow_sine_layers(layer0, layer1, v);\n" +
                           sine + e.code});
        all.push_back({group, "no cube, slopes, " + e.name, layers, "float",
                       direction + both_layers + "    float horizon = bumpshadow_sine_layers(layer0, layer1, v);\n" +
                           slope + e.code});
    }
    all.push_back({group, "no cube, all factors, sines, soft", layers, "float",
                   direction + both_layers + "    bumpshadow_eight factors = bumpshadow_factors(v);\n" + with_factors +
                       sine + soft.code});
    all.push_back({group, "factors of a bearing, slopes, soft", layers, "float",
                   bearing("cubic") + both_layers +
                       "    bumpshadow_eight factors = bumpshadow_factors_of_bearing(bearing);\n" + with_factors +
                       slope + soft.code});
}

void add_fourier(std::vector<shader_case>& all) {
    const std::string start = direction + "    vec2 d = bumpshadow_fourier_direction(v);\n";
    const auto texel = [](const char* name, const char* map, const char* number, const std::string& root) {
        return std::string("    vec4 ") + name + " = bumpshadow_fourier_" + root + "texel(textureLod(" + map +
               ", uv, 0.0), scale" + number + ", offset" + number + ");\n";
    };
    const std::string constant = "    float c = textureLod(map1, uv, 0.0).x * scale1.x + offset1.x;\n";
    const std::string root_constant =
        "    float c = bumpshadow_fourier_root_constant(textureLod(map1, uv, 0.0).x, scale1.x, offset1.x);\n";
    const std::string last = "    float c = textureLod(map2, uv, 0.0).x * some_k + some_offset;\n";
    const auto add = [&](const std::string& name, const char* textures, const std::string& code) {
        for (const edge& e : {soft, centered_above})
            all.push_back({"Fourier", name + ", " + e.name, textures, "float", start + code + e.code});
    };
    const std::string l = slope;
    add("3", one_texture,
        texel("a", "map", "0", "") + "    float horizon = bumpshadow_fourier_3(vec3(a.x, a.y, a.z), d);\n" + l);
    add("5", two_textures,
        texel("a", "map", "0", "") + constant + "    float horizon = bumpshadow_fourier_5(a, c, d);\n" + l);
    add("5 of sines", two_textures,
        texel("a", "map", "0", "") + constant + "    float horizon = bumpshadow_fourier_5(a, c, d);\n" + sine);
    add("5, roots", two_textures,
        texel("a", "map", "0", "root_") + root_constant + "    float horizon = bumpshadow_fourier_5(a, c, d);\n" + l);
    add("7", two_textures,
        texel("a", "map", "0", "") + texel("b", "map1", "1", "") +
            "    float horizon = bumpshadow_fourier_7(a, vec3(b.x, b.y, b.z), d);\n" + l);
    add("9", three_textures,
        texel("a", "map", "0", "") + texel("b", "map1", "1", "") + last +
            "    float horizon = bumpshadow_fourier_9(a, b, c, d);\n" + l);
}

void add_ssbump(std::vector<shader_case>& all) {
    const std::string group = "SSBump";
    const std::string masks = "    vec3 masks = textureLod(map, uv, 0.0).xyz;\n";
    const std::string maps =
        "textureLod(red, uv, 0.0).xyz, textureLod(green, uv, 0.0).xyz, textureLod(blue, uv, 0.0).xyz);\n";
    all.push_back({group, "three lightmaps", masks_and_lightmaps, "vec3",
                   masks + "    return bumpshadow_ssbump_lightmaps(masks, " + maps});
    all.push_back({group, "three lightmaps with a normal map", masks_and_lightmaps, "vec3",
                   "    vec3 normal = 2.0 * textureLod(map, uv, 0.0).xyz - 1.0;\n"
                   "    return bumpshadow_normal_lightmaps(normal, " +
                       maps});
    all.push_back({group, "dynamic light", one_texture, "float",
                   masks + "    return bumpshadow_ssbump_light(masks, bumpshadow_ssbump_weights(light));\n"});
    all.push_back({group, "dynamic light, weights from the vertex shader", one_texture, "float",
                   masks + "    return bumpshadow_ssbump_light(masks, light);\n"});
    const std::string lit = "    return bumpshadow_ssbump_light(masks, light);\n";
    all.push_back({group, "dynamic light, masks of the other hand", one_texture, "float",
                   masks + "    masks = bumpshadow_ssbump_other_hand(masks);\n" + lit});
    all.push_back({group, "dynamic light, gray detail", two_textures, "float",
                   masks + "    masks = bumpshadow_ssbump_detail(masks, textureLod(map1, uv, 0.0).x);\n" + lit});
    all.push_back(
        {group, "dynamic light, detail masks", two_textures, "float",
         masks + "    masks = bumpshadow_ssbump_detail_masks(masks, textureLod(map1, uv, 0.0).xyz);\n" + lit});
    all.push_back({group, "normal", one_texture, "vec3", masks + "    return bumpshadow_ssbump_normal(masks);\n"});
    all.push_back({group, "normal in the world", one_texture, "vec3",
                   masks + "    return bumpshadow_ssbump_world_normal(masks, scale0.xyz, offset0.xyz, scale1.xyz);\n"});
    all.push_back({group, "reflection", one_texture, "vec3",
                   masks + "    return bumpshadow_reflection(light, bumpshadow_ssbump_normal(masks));\n"});
    // Axes that the compiler cannot tell to be the same numbers in another order, since each has a factor of its own.
    all.push_back({group, "vertex: basis in the world", "", "mat3",
                   R"(    vec3 tangent = light, bitangent = light.yzx, normal = light.zxy;
    return mat3(bumpshadow_ssbump_world_red(tangent, normal),
                bumpshadow_ssbump_world_green(tangent, bitangent, normal),
                bumpshadow_ssbump_world_blue(tangent, bitangent, normal));
)"});
}

void add_rest(std::vector<shader_case>& all) {
    all.push_back({"emboss", "shift a pixel, two heights", two_textures, "float",
                   R"(    vec2 shift = bumpshadow_emboss_shift(light, steps.xy);
    float inverse = bumpshadow_emboss_inverse(textureLod(map, uv + shift, 0.0).x);
    return bumpshadow_emboss_relief(textureLod(map, uv, 0.0).x, inverse);
)"});
    all.push_back(
        {"emboss", "shift from the vertex shader", two_textures, "float",
         R"(    float inverse = bumpshadow_emboss_inverse(textureLod(map, uv + vec2(light.x, light.y), 0.0).x);
    return bumpshadow_emboss_relief(textureLod(map, uv, 0.0).x, inverse);
)"});

    all.push_back(
        {"emboss", "base texture in light of a color", two_textures, "vec3",
         R"(    float inverse = bumpshadow_emboss_inverse(textureLod(map, uv + vec2(light.x, light.y), 0.0).x);
    float relief = bumpshadow_emboss_relief(textureLod(map, uv, 0.0).x, inverse);
    return bumpshadow_emboss(relief, textureLod(map1, uv, 0.0).xyz, scale0.xyz);
)"});
    all.push_back({"normal map", "three channels", one_texture, "vec3",
                   "    return bumpshadow_normal(textureLod(map, uv, 0.0).xyz, 1.0);\n"});
    all.push_back({"normal map", "partial derivatives", one_texture, "vec3",
                   "    return bumpshadow_normal_of_derivatives(textureLod(map, uv, 0.0).xy, max_slope, 1.0);\n"});
}

void add_vertices(std::vector<shader_case>& all) {
    const std::string vertex = "bearing and slope a vertex";
    for (const edge& e : {soft, soft_above, hard_above})
        all.push_back(
            {vertex, "pixel: volume, " + e.name, volume, "float",
             "    float horizon = textureLod(horizons, vec3(uv, light.x), 0.0).x;\n    float l = light.y;\n" + e.code});
    for (const char* f : {"exact", "quintic", "cubic", "octant", "diamond"})
        all.push_back({vertex, "vertex: bearing and slope, " + std::string(f), "", "vec2",
                       "    return bumpshadow_vertex_bearing_" + std::string(f) + "(light, most);\n"});
    all.push_back(
        {vertex, "vertex: direction and slope", "", "vec3", "    return bumpshadow_vertex_direction(light, most);\n"});
    all.push_back(
        {vertex, "vertex: direction and sine", "", "vec3", "    return bumpshadow_vertex_direction_sine(light);\n"});
    const std::string to_tangent_space =
        "    light = bumpshadow_to_tangent_space(light, scale0.xyz, offset0.xyz, scale1.xyz);\n";
    all.push_back({vertex, "vertex: light into tangent space", "", "vec3", to_tangent_space + "    return light;\n"});
    all.push_back({vertex, "vertex: light into tangent space, bearing and slope, octant", "", "vec2",
                   to_tangent_space + "    return bumpshadow_vertex_bearing_octant(light, most);\n"});
    all.push_back(
        {vertex, "triangle: bearings unwrapped", "", "vec3", "    return bumpshadow_unwrap_bearings(light);\n"});
    all.push_back({vertex, "triangle: bearings unwrapped, whether they go round", "", "float",
                   "    return bumpshadow_bearings_go_round(bumpshadow_unwrap_bearings(light)) ? 1.0 : 0.0;\n"});
    all.push_back({vertex, "vertex: bearing and slope, octant, the bearing twice", "", "vec3",
                   R"(    vec2 both = bumpshadow_vertex_bearing_octant(light, most);
    return vec3(bumpshadow_bearing_pair(both.x), both.y);
)"});
    all.push_back({vertex, "pixel: volume, one bearing of two, their change given, soft", volume, "float",
                   "    float bearing = bumpshadow_pick_bearing(light.xy, uv);\n"
                   "    float horizon = textureLod(horizons, vec3(uv, bearing), 0.0).x;\n    float l = light.z;\n" +
                       soft.code});
    all.push_back({vertex, "pixel: direction and slope from the vertex, cubic", volume, "float",
                   bearing("cubic") + fetch_volume + "    float l = light.z;\n" + soft.code});
}

}  // namespace

std::vector<shader_case> snippet_cases() {
    std::vector<shader_case> all;
    add_slices(all);
    add_eight_channels(all);
    add_fourier(all);
    add_ssbump(all);
    add_rest(all);
    add_vertices(all);
    return all;
}

}  // namespace examples
