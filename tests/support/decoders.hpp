#pragma once

#include <string>
#include <vector>

#include <bumpshadow/shader/snippets.hpp>

// How a shader decodes a horizon: what a caller of shader_text::compose writes, for each decoder.
namespace decoders {

using bumpshadow::shader_text::choice;
using bumpshadow::shader_text::decoder;

struct use {
    decoder decode;
    const char* name;
    std::vector<std::string> entries;  // functions that it calls, short names apart
    bool bearing, shadow;              // which short names there are
    // Value of a horizon, from the vec3 `light` and, in place of texels, the vec4 `value`; ROOT: with signed roots.
    const char* horizon;
};

[[nodiscard]] inline const std::vector<use>& all() {
    static const std::vector<use> table = {
        {decoder::volume,
         "volume",
         {"bumpshadow_volume_coordinate"},
         true,
         true,
         "value.x * bumpshadow_volume_coordinate(bumpshadow_bearing(vec2(light.x, light.y)), 0.03125f)"},
        {decoder::slices,
         "slices",
         {"bumpshadow_tangent_layers", "bumpshadow_tangent_horizon"},
         true,
         true,
         "bumpshadow_tangent_horizon(value.x, value.y, "
         "bumpshadow_tangent_layers(bumpshadow_bearing(vec2(light.x, light.y)), 0.0f, 16.0f).z)"},
        {decoder::arc,
         "arc",
         {"bumpshadow_arc_coordinate"},
         true,
         true,
         "value.x * bumpshadow_arc_coordinate(bumpshadow_bearing(vec2(light.x, light.y)), -0.25f, 1.6f, -0.3f)"},
        {decoder::arc_slices,
         "arc, slices",
         {"bumpshadow_arc_layers", "bumpshadow_tangent_horizon"},
         true,
         true,
         "bumpshadow_tangent_horizon(value.x, value.y, "
         "bumpshadow_arc_layers(bumpshadow_bearing(vec2(light.x, light.y)), -0.25f, 8.0f, -2.0f, 5.0f).z)"},
        {decoder::grouped,
         "grouped",
         {"bumpshadow_slice_position", "bumpshadow_grouped_layers", "bumpshadow_grouped_horizon"},
         true,
         true,
         "bumpshadow_grouped_horizon(value, value.x, bumpshadow_grouped_layers(bumpshadow_slice_position("
         "bumpshadow_bearing(vec2(light.x, light.y)), 0.0f, 12.0f), 3.0f).z)"},
        {decoder::overlapping,
         "overlapping",
         {"bumpshadow_slice_position", "bumpshadow_overlapping_layer", "bumpshadow_overlapping_horizon"},
         true,
         true,
         "bumpshadow_overlapping_horizon(value, bumpshadow_overlapping_layer(bumpshadow_slice_position("
         "bumpshadow_bearing(vec2(light.x, light.y)), 0.0f, 12.0f)).y)"},
        {decoder::flat, "flat", {}, false, true, "value.x"},
        {decoder::sine_layers,
         "sine layers",
         {"bumpshadow_sine_layers"},
         false,
         true,
         "bumpshadow_sine_layers(value, value, vec2(light.x, light.y))"},
        {decoder::sine_layers_cube,
         "sine layers, cube",
         {"bumpshadow_sine_layers_biased_cube"},
         false,
         true,
         "bumpshadow_sine_layers_biased_cube(value, value, value)"},
        {decoder::sine_layers_half,
         "sine layers, half",
         {"bumpshadow_sine_first_layer", "bumpshadow_sine_half"},
         false,
         true,
         "bumpshadow_sine_half(value, bumpshadow_sine_first_layer(vec2(light.x, light.y)), vec2(light.x, light.y))"},
        {decoder::fourier_3,
         "fourier 3",
         {"bumpshadow_fourier_ROOTtexel", "bumpshadow_fourier_3", "bumpshadow_fourier_direction"},
         false,
         true,
         "bumpshadow_fourier_3(three(bumpshadow_fourier_ROOTtexel(value, value, value)), "
         "bumpshadow_fourier_direction(vec2(light.x, light.y)))"},
        {decoder::fourier_5,
         "fourier 5",
         {"bumpshadow_fourier_ROOTtexel", "bumpshadow_fourier_5", "bumpshadow_fourier_direction"},
         false,
         true,
         "bumpshadow_fourier_5(bumpshadow_fourier_ROOTtexel(value, value, value), CONSTANT, "
         "bumpshadow_fourier_direction(vec2(light.x, light.y)))"},
        {decoder::fourier_7,
         "fourier 7",
         {"bumpshadow_fourier_ROOTtexel", "bumpshadow_fourier_7", "bumpshadow_fourier_direction"},
         false,
         true,
         "bumpshadow_fourier_7(bumpshadow_fourier_ROOTtexel(value, value, value), "
         "three(bumpshadow_fourier_ROOTtexel(value, value, value)), "
         "bumpshadow_fourier_direction(vec2(light.x, light.y)))"},
        {decoder::fourier_9,
         "fourier 9",
         {"bumpshadow_fourier_ROOTtexel", "bumpshadow_fourier_9", "bumpshadow_fourier_direction"},
         false,
         true,
         "bumpshadow_fourier_9(bumpshadow_fourier_ROOTtexel(value, value, value), "
         "bumpshadow_fourier_ROOTtexel(value, value, value), CONSTANT, "
         "bumpshadow_fourier_direction(vec2(light.x, light.y)))"},
        {decoder::ssbump,
         "ssbump",
         {"bumpshadow_ssbump_weights", "bumpshadow_ssbump_light"},
         false,
         false,
         "bumpshadow_ssbump_light(light, bumpshadow_ssbump_weights(light))"},
        {decoder::ssbump_lightmaps,
         "ssbump, lightmaps",
         {"bumpshadow_ssbump_lightmaps"},
         false,
         false,
         "bumpshadow_ssbump_lightmaps(light, light, light, light).x"},
        {decoder::emboss,
         "emboss",
         {"bumpshadow_emboss_shift", "bumpshadow_emboss_inverse", "bumpshadow_emboss_relief", "bumpshadow_emboss"},
         false,
         false,
         "bumpshadow_emboss(bumpshadow_emboss_relief(bumpshadow_emboss_shift(light, vec2(value.x, value.y)).x, "
         "bumpshadow_emboss_inverse(value.x)), light, light).x"},
    };
    return table;
}

[[nodiscard]] inline bool is_fourier(decoder decode) {
    return decode >= decoder::fourier_3 && decode <= decoder::fourier_9;
}
[[nodiscard]] inline bool has_constant_texture(decoder decode) {
    return decode == decoder::fourier_5 || decode == decoder::fourier_9;
}

[[nodiscard]] inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

// The functions that a caller calls for a choice, short names included.
[[nodiscard]] inline std::vector<std::string> roots_of(const use& u, const choice& chosen) {
    std::vector<std::string> roots;
    for (const std::string& entry : u.entries)
        roots.push_back(replaced(entry, "ROOT", chosen.square_root ? "root_" : ""));
    if (chosen.square_root && has_constant_texture(u.decode)) roots.emplace_back("bumpshadow_fourier_root_constant");
    if (u.bearing) roots.emplace_back("bumpshadow_bearing");
    if (u.bearing && chosen.vertex)
        roots.insert(roots.end(), {"bumpshadow_vertex_bearing", "bumpshadow_to_tangent_space",
                                   "bumpshadow_bearing_pair", "bumpshadow_pick_bearing"});
    if (u.shadow) roots.insert(roots.end(), {"bumpshadow_level", "bumpshadow_shadow"});
    return roots;
}

// Statements that set the float `result`, from `light` and `value`.
[[nodiscard]] inline std::string body_of(const use& u, const choice& chosen) {
    const std::string constant = chosen.square_root ? "bumpshadow_fourier_root_constant(value.x, value.y, value.z)"
                                                    : "(value.x * value.y + value.z)";
    const std::string horizon =
        replaced(replaced(u.horizon, "ROOT", chosen.square_root ? "root_" : ""), "CONSTANT", constant);
    const std::string vertex = u.bearing && chosen.vertex
                                   ? " * bumpshadow_pick_bearing(bumpshadow_bearing_pair(bumpshadow_vertex_bearing("
                                     "bumpshadow_to_tangent_space(light, light, light, light), 4.0f).x), "
                                     "vec2(value.x, value.y))"
                                   : "";
    return "    float horizon = " + horizon + vertex +
           ";\n    result = " + (u.shadow ? "bumpshadow_shadow(bumpshadow_level(light), horizon, 8.0f)" : "horizon") +
           ";\n";
}

}  // namespace decoders
