#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/shader/snippets_text.hpp>

// The shader snippets as text, for engines that put their shaders together at run time, and for shading languages
// without a preprocessor. What comes out holds what is asked for and what that calls, and no line that starts with #.
// For a choice it is functions alone, in GLSL that Godot 3 takes too: no structures, arrays, overloads, matrices,
// nested conditions without parentheses and suffixes of numbers. Needs the standard library alone.

namespace bumpshadow::shader_text {

// Shading language of the text.
enum class dialect : unsigned char {
    glsl,  // 330 and newer, ES 300 and newer, Vulkan
    hlsl,  // shader model 4 and newer
};

// How a horizon is decoded.
enum class decoder : unsigned char {
    volume,            // tangent volume, one fetch
    slices,            // tangent volume as an array, two fetches
    arc,               // tangent volume over an arc of bearings, one fetch
    arc_slices,        // the same as an array, two fetches
    grouped,           // slice layers, two fetches
    overlapping,       // slice layers, one fetch
    flat,              // one slice, for a light whose bearing is fixed: no bearing function
    sine_layers,       // two layers, factors computed
    sine_layers_cube,  // the same, factors from a cube (biased)
    sine_layers_half,  // an array of both layers, of one of which one channel is enough
    fourier_3,
    fourier_5,
    fourier_7,
    fourier_9,
    ssbump,            // one light
    ssbump_lightmaps,  // three lightmaps
    emboss,
};

// Edge of the shadow, see shader/shadow.h.
enum class edge : unsigned char {
    hard,
    soft,            // inside the shadow: c = 1
    soft_above,      // the same for lights that never shine from below the surface
    centered,        // c = 0.5
    centered_above,  // the same for lights that never shine from below the surface
};

// What the source is put together for.
struct choice {
    decoder decode = decoder::volume;                    // what textures there are
    bearing_function bearing = bearing_function::cubic;  // that slices were baked for
    quantity stored = quantity::slope;                   // by the texture
    edge shadow = edge::soft;                            // of the shadow
    bool square_root = false;                            // Fourier: signed square roots are stored
    bool vertex = false;  // decoders of slices: bearing and level a vertex at a time, too
    bool places = false;  // of a pixel that covers many texels: bumpshadow_pixel_place, too
};

namespace snippets_detail {

inline constexpr int count = int(std::size(snippets));
using set = decltype(snippet::needs);

[[nodiscard]] constexpr int index_of(std::string_view name) {
    for (int i = 0; i < count; ++i)
        if (snippets[i].name == name) return i;
    return -1;
}

constexpr void join(set& to, const set& from) {
    for (std::size_t w = 0; w < to.size(); ++w) to[w] |= from[w];
}

[[nodiscard]] constexpr bool has(const set& s, int i) {
    return (s[std::size_t(i) / 64] >> (std::size_t(i) % 64) & 1u) != 0;
}

template <class Write>
void write_set(const set& chosen, dialect language, const Write& write) {
    for (int i = 0; i < count; ++i)
        if (has(chosen, i)) {
            write(snippets[i].comment);
            write(language == dialect::glsl ? snippets[i].glsl : snippets[i].hlsl);
        }
}

inline constexpr std::string_view bearings[] = {"bumpshadow_bearing_exact", "bumpshadow_bearing_quintic",
                                                "bumpshadow_bearing_cubic", "bumpshadow_bearing_octant",
                                                "bumpshadow_bearing_diamond"};
inline constexpr std::string_view levels[] = {"bumpshadow_slope", "bumpshadow_sine", "bumpshadow_angle"};
inline constexpr std::string_view shadows[] = {"bumpshadow_shadow_hard", "bumpshadow_shadow_soft",
                                               "bumpshadow_shadow_soft_above", "bumpshadow_shadow_soft",
                                               "bumpshadow_shadow_soft_above"};

// The functions that a caller of a decoder calls by name.
[[nodiscard]] constexpr std::array<std::string_view, 4> entries(const choice& chosen) {
    const std::string_view texel = chosen.square_root ? "bumpshadow_fourier_root_texel" : "bumpshadow_fourier_texel";
    const std::string_view constant = chosen.square_root ? "bumpshadow_fourier_root_constant" : "";
    constexpr std::string_view direction = "bumpshadow_fourier_direction";
    switch (chosen.decode) {
        case decoder::volume: return {"bumpshadow_volume_coordinate"};
        case decoder::slices: return {"bumpshadow_tangent_layers", "bumpshadow_tangent_horizon"};
        case decoder::arc: return {"bumpshadow_arc_coordinate"};
        case decoder::arc_slices: return {"bumpshadow_arc_layers", "bumpshadow_tangent_horizon"};
        case decoder::grouped:
            return {"bumpshadow_slice_position", "bumpshadow_grouped_layers", "bumpshadow_grouped_horizon"};
        case decoder::overlapping:
            return {"bumpshadow_slice_position", "bumpshadow_overlapping_layer", "bumpshadow_overlapping_horizon"};
        case decoder::flat: return {};
        case decoder::sine_layers: return {"bumpshadow_sine_layers"};
        case decoder::sine_layers_cube: return {"bumpshadow_sine_layers_biased_cube"};
        case decoder::sine_layers_half: return {"bumpshadow_sine_first_layer", "bumpshadow_sine_half"};
        case decoder::fourier_3: return {texel, "bumpshadow_fourier_3", direction};
        case decoder::fourier_5: return {texel, "bumpshadow_fourier_5", direction, constant};
        case decoder::fourier_7: return {texel, "bumpshadow_fourier_7", direction};
        case decoder::fourier_9: return {texel, "bumpshadow_fourier_9", direction, constant};
        case decoder::ssbump: return {"bumpshadow_ssbump_weights", "bumpshadow_ssbump_light"};
        case decoder::ssbump_lightmaps: return {"bumpshadow_ssbump_lightmaps"};
        case decoder::emboss:
            return {"bumpshadow_emboss_shift", "bumpshadow_emboss_inverse", "bumpshadow_emboss_relief",
                    "bumpshadow_emboss"};
    }
    return {};
}

// What bearings from vertices take besides.
inline constexpr std::string_view of_vertices[] = {"bumpshadow_to_tangent_space", "bumpshadow_bearing_pair",
                                                   "bumpshadow_pick_bearing"};

[[nodiscard]] constexpr bool has_bearing(decoder decode) { return decode <= decoder::overlapping; }
[[nodiscard]] constexpr bool has_shadow(decoder decode) { return decode < decoder::ssbump; }

}  // namespace snippets_detail

// Hands the text of the named functions and of all that they call to write(std::string_view), in an order that
// compiles. False, and nothing written, where a name is not that of a snippet.
template <class Write>
[[nodiscard]] bool compose(std::span<const std::string_view> names, dialect language, const Write& write) {
    snippets_detail::set chosen{};
    for (const std::string_view name : names) {
        const int i = snippets_detail::index_of(name);
        if (i < 0) return false;
        snippets_detail::join(chosen, snippets[i].needs);
    }
    snippets_detail::write_set(chosen, language, write);
    return true;
}

// The same for a choice: the functions of its decoder and, as in the paste files, under short names
//   float bumpshadow_bearing(vec2 v)                                decoders of slices alone
//   float bumpshadow_level(vec3 light)                              all but SSBump and embossing
//   vec2 bumpshadow_vertex_bearing(vec3 light, float most)          decoders of slices, if chosen: bearing and level,
//                                                                   with what the seam takes (shader/vertex.h)
//   float bumpshadow_shadow(float light, float horizon, float k)    all but SSBump and embossing; a hard edge does not
//                                                                   look at k
template <class Write>
void compose(const choice& chosen, dialect language, const Write& write) {
    using namespace snippets_detail;
    set all{};
    for (const std::string_view name : entries(chosen))
        if (!name.empty()) join(all, snippets[index_of(name)].needs);
    const std::string_view bearing = bearings[std::size_t(chosen.bearing)], level = levels[std::size_t(chosen.stored)],
                           shadow = shadows[std::size_t(chosen.shadow)];
    if (has_bearing(chosen.decode)) join(all, snippets[index_of(bearing)].needs);
    if (has_shadow(chosen.decode)) {
        join(all, snippets[index_of(level)].needs);
        join(all, snippets[index_of(shadow)].needs);
        if (chosen.places) join(all, snippets[index_of("bumpshadow_pixel_place")].needs);
    }
    const bool vertex = chosen.vertex && has_bearing(chosen.decode);
    if (vertex)
        for (const std::string_view name : of_vertices) join(all, snippets[index_of(name)].needs);
    write_set(all, language, write);

    const bool glsl = language == dialect::glsl;
    const auto line = [&](auto... parts) { (write(std::string_view(parts)), ...); };
    if (has_bearing(chosen.decode))
        line("float bumpshadow_bearing(", glsl ? "vec2" : "float2", " v) { return ", bearing, "(v); }\n");
    if (!has_shadow(chosen.decode)) return;
    line("float bumpshadow_level(", glsl ? "vec3" : "float3", " light) { return ", level, "(light); }\n");
    if (vertex) {
        const std::string_view two = glsl ? "vec2" : "float2";
        line(two, " bumpshadow_vertex_bearing(", glsl ? "vec3" : "float3", " light, float most) {\n    return ", two,
             "(bumpshadow_bearing(light.xy), clamp(bumpshadow_level(light), -most, most));\n}\n");
    }
    line("float bumpshadow_shadow(float light, float horizon, float k) { return ", shadow, "(light, horizon");
    if (chosen.shadow == edge::hard)
        line("); }\n");
    else
        line(", k, ", chosen.shadow == edge::soft || chosen.shadow == edge::soft_above ? "1.0" : "0.5", "); }\n");
}

}  // namespace bumpshadow::shader_text
