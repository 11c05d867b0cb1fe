#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// The cheapest set-up that is good enough for a scene: what plan() returns.

namespace bumpshadow {

// What a recipe is predicted to cost and to get wrong.
struct plan_figures {
    double mismatch = 0.0;  // share of wrong answers; of pixels of many texels, mean difference of the shadow factor
    double interval = 0.0;  // half width of the 95 % confidence interval of mismatch
    double degrees = 0.0;   // mean error of the horizon's elevation in the lights' bearings
    double bytes = 0.0;     // a texel of the height map
    double bake_seconds = 0.0;  // of the whole map, on one thread
    double pack_seconds = 0.0;  // likewise: from horizons to the texture
    double gpu_cost = 0.0;      // cycles a wave, as shader_cost prints them for RDNA2
    // Texture fetches of a pixel.
    int fetches = 0;
};

// What stands between a scene and its error where no recipe meets it.
// textures: light comes from many bearings, but the platform has neither volumes nor arrays to hold slices.
enum class plan_obstacle : unsigned char { none, mismatch, degrees, bytes, bake_seconds, gpu_cost, textures };

// Its name as it is written here.
[[nodiscard]] constexpr const char* name_of(plan_obstacle o) {
    constexpr const char* names[] = {"none", "mismatch", "degrees", "bytes", "bake_seconds", "gpu_cost", "textures"};
    return names[std::size_t(o)];
}

// One choice and why, with the number that decided.
struct plan_line {
    char text[160] = "";  // ends with a 0
};

// A set-up: how to bake, what to store, how to shade.
struct recipe {
    // False where no light of the scene is ever blocked: no bake, no texture, no code. Nothing else counts then.
    bool shadows = true;
    // The error that was asked for is met; else `obstacle` says what stands in the way, and this is the best there is.
    plan_obstacle obstacle = plan_obstacle::none;

    // The bake, by the cascade: bake_options::steps.
    int steps = bake_options{}.steps;
    double radius = bake_options{}.radius;  // in the unit of texel_size
    int reduced_heights = 1;                // heights are averaged over squares of this side before the bake
    int directions = 32;                    // see fill_directions()

    // The texture.
    int reduction = 1;  // horizons are averaged over squares of this side, of the baked extent
    // What the texture holds.
    tangent_volume encoding = {};
    // How slices come of the directions baked.
    slice_fit fit = slice_fit::least_squares;
    // plan() leaves it false: a scene says how near its views come, not how far they go, and a texture that is reduced
    // to its nearest view has done the mips' first work. To be set where views from farther away shimmer; not for the
    // volume of an arc, and of a volume of all bearings not with slice_fit::point.
    bool mips = false;

    // The shader: shape of the shadow's edge.
    shadow_edge edge = {};
    // Of pixels that cover many texels, the factors of taps x taps places are averaged (bumpshadow_pixel_place).
    int taps = 1;
    bool above = true;  // lights never shine from below the surface

    bool wants_normals = false;  // a normal map is missing
    bool wants_masks = false;    // lightmaps are there: masks (encode/ssbump.hpp) shadow them

    // Share of the map's tiles of 32 x 32 texels that no light of the scene shadows: tile_horizons() finds them.
    double free_tiles = 0.0;

    // Of this recipe, from the sample that plan() drew.
    plan_figures predicted = {};
    // The choices and their reasons, `lines` of them.
    std::array<plan_line, 20> why = {};
    // Lines of `why` that are there.
    int lines = 0;

    // Adds a line, as printf does; without values as it is.
    template <class... Values>
    void say(const char* format, Values... values) {
        if (std::size_t(lines) == why.size()) return;
        char* const text = why[std::size_t(lines++)].text;
        if constexpr (sizeof...(values) == 0)
            std::snprintf(text, sizeof plan_line::text, "%s", format);
        else
            std::snprintf(text, sizeof plan_line::text, format, values...);
    }
};

// Cycles a wave on RDNA2, net of the empty shader, as shader_cost prints them (`shader_cost --check` compares): with a
// hard edge, of several places with a centered one for lights above the surface. A soft one for lights above the
// surface takes 4 less.
[[nodiscard]] constexpr double gpu_cost_of(const tangent_volume& encoding, int taps = 1) {
    const bool arc = is_arc(encoding.slices), array = encoding.kind == texture_kind::array;
    const bool flat = encoding.kind == texture_kind::flat;
    // Each further place of a pixel: what it fetches, and its edge. The loop, and what the other edge saves or costs.
    const double places = taps == 1 ? 0.0 : (flat ? -6.0 : 6.0) + double(taps * taps - 1) * (array ? 10.67 : 6.67);
    if (flat) return 20.0 + places;
    const double around = (array ? (arc ? 16.0 : 18.0) : (arc ? 4.0 : 0.0)) + places;
    switch (encoding.slices.function) {
        case bearing_function::exact: return 38.0 + around;
        case bearing_function::octant: return 26.0 + around;
        case bearing_function::cubic: return 30.0 + around;
        default: return 32.0 + around;
    }
}

// Heights averaged over squares, as reduced_heights says, in the unit of texel_size, above the map's reference; holes
// count for nothing, and squares of holes alone are NaN, the result's no_data. Its extent is reduced_extent(): where
// that is no multiple, the last rows and columns of `from` are in none.
//   out: [y][x], tight, where the result's samples go: in smaller sides of `from`'s texels, so that any unit fits
//   floats
template <height_sample Sample>
[[nodiscard]] height_map<float> average_heights(const height_map<Sample>& from, int side, float* out) {
    const glm::ivec2 extent = reduced_extent(from.extent, side);
    const double length = (std::min)(from.texel_size.x, from.texel_size.y), unit = unit_height(from) / length;
    const double reference = reference_sample(from), most = double((std::numeric_limits<float>::max)());
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) {
            double sum = 0.0;
            int count = 0;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    const Sample sample = sample_at(from, x * side + i, y * side + j);
                    if (is_no_data(from, sample)) continue;
                    sum += double(sample) - reference;
                    ++count;
                }
            out[std::size_t(y) * std::size_t(extent.x) + std::size_t(x)] =
                count > 0 ? float((std::clamp)(unit * (sum / count), -most, most))
                          : std::numeric_limits<float>::quiet_NaN();
        }
    height_map<float> map = tight_height_map<float>(out, extent);
    map.height_scale = length;
    map.texel_size = from.texel_size * double(side);
    map.edge = from.edge;
    if (from.no_data) map.no_data = std::numeric_limits<float>::quiet_NaN();
    return map;
}

// Extent that horizons are baked at, of a height map of this extent; texels.
[[nodiscard]] inline GLM_CONSTEXPR glm::ivec2 baked_extent(const recipe& r, glm::ivec2 extent) {
    return reduced_extent(extent, r.reduced_heights);
}
// Layout of the texture for a height map of this extent.
[[nodiscard]] inline texture_layout layout_of(const recipe& r, glm::ivec2 extent) {
    const glm::ivec2 stored = reduced_extent(baked_extent(r, extent), r.reduction);
    return layout_of(r.encoding, stored, r.mips ? default_mips(stored) : 1);
}

// Directions to bake: those of `directions` slices of the encoding's arc and bearing function, as many as out has.
inline void fill_directions(const recipe& r, std::span<glm::dvec2> out) {
    slice_set all = r.encoding.slices;
    all.count = int(out.size());
    fill_directions(out, all);
}

}  // namespace bumpshadow
