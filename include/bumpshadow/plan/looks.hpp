#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/plan/scene.hpp>

// The sample that a plan is judged by: pixels in patches of the map, lights of the scene, and what exact says of them.
// Part of plan.hpp.
namespace bumpshadow::plan_detail {

inline constexpr int patch_side = 32;  // texels; a multiple of every reduction
inline constexpr int most_patches = 128;
inline constexpr int most_reduction = 8;
// The texels that are looked at: the middle of a patch, so that reduced texels on all sides of them are there.
inline constexpr int core_first = 12, core_side = 8;
inline constexpr int elevations = 4;  // of an arc, in each bearing
inline constexpr int bearings = 16;   // of an arc, in each patch
// Rays of exact: each takes a microsecond or two.
inline constexpr int most_rays = 16384;

// Squares of a map, stacked on top of each other.
struct patches {
    glm::ivec2 extent{0};  // of one
    int count = 0;
    std::array<glm::ivec2, most_patches> origins;

    [[nodiscard]] glm::ivec2 stack() const { return {extent.x, extent.y * count}; }
    // Whether patches can be reduced by it.
    [[nodiscard]] bool divides(int by) const {
        return by <= most_reduction && extent.x % by == 0 && extent.y % by == 0;
    }
    [[nodiscard]] bool whole() const { return extent == glm::ivec2(patch_side); }

    // What of a patch is packed, in texels reduced by `by`: all that the core is filtered from, whole blocks of 4 x 4.
    // Of maps smaller than a patch all.
    [[nodiscard]] rectangle part(int by) const {
        if (!whole()) return {glm::ivec2(0), extent / by};
        const int side = by == 8 ? 4 : 8;
        return {glm::ivec2((patch_side / by - side) / 2), glm::ivec2(side)};
    }
    [[nodiscard]] glm::ivec2 packed(int by) const {
        const glm::ivec2 side = part(by).extent;
        return {side.x, side.y * count};
    }
};

// Spread over the map, on multiples of the largest reduction where there is room for it.
[[nodiscard]] inline patches choose_patches(glm::ivec2 map, std::uint32_t seed) {
    patches all;
    all.extent = (glm::min)(map, glm::ivec2(patch_side));
    const glm::ivec2 places = (map - all.extent) / most_reduction + 1;
    all.count = int((std::min)(std::int64_t(most_patches), std::int64_t(places.x) * places.y));
    std::array<glm::ivec2, most_patches> drawn;
    const status s = sample_texels(places, seed, std::span(drawn).first(std::size_t(all.count)));
    BUMPSHADOW_ASSERT(bool(s));
    static_cast<void>(s);
    // Drawn row by row; in this order the first half of them is spread over the map, too.
    const int step = all.count % 37 == 0 ? 1 : 37;
    for (int i = 0; i < all.count; ++i)
        all.origins[std::size_t(i)] = drawn[std::size_t(i * step % all.count)] * most_reduction;
    return all;
}

// A pixel and a bearing with up to `elevations` lights.
struct look {
    glm::vec2 place;  // of the pixel's middle in its patch, in texels
    int patch;
    glm::vec2 direction;  // of unit length
    float horizon;        // the exact one, a slope; of the pixel's texels the mean
    float reach;          // how far occluders of these lights are, at the most; in the unit of texel_size
    float light[elevations];
    float lit[elevations];  // share of the pixel that is lit
};

struct view {
    int lights = elevations;  // that a look has
    int pixel = 1;            // texels along the side of a pixel
    int pixels = 0;           // of a patch
    int rays = 1;             // bearings of a pixel
    int samples = 1;          // texels of a pixel that exact is asked about

    [[nodiscard]] std::size_t looks(int patch_count) const {
        return std::size_t(patch_count) * std::size_t(pixels) * std::size_t(rays);
    }
};

[[nodiscard]] inline view shape_view(const scene& s, const patches& all) {
    view v;
    v.pixel = 1;
    while (2 * v.pixel <= s.texels_per_pixel && all.divides(2 * v.pixel)) v.pixel *= 2;
    v.samples = v.pixel * v.pixel;
    const std::size_t fixed = !s.lights.empty() ? s.lights.size() : s.positions.size();
    const int most = v.pixel > 1 ? bearings / 4 : bearings;
    v.rays = fixed == 0 ? most : int((std::min)(fixed, std::size_t(most)));
    v.lights = fixed == 0 ? elevations : 1;
    v.pixels = std::clamp(most_rays / (all.count * v.rays * v.samples), 1, core_side * core_side);
    return v;
}

// The light `ray` of a look, at a place of the map: towards it, and its slopes.
struct lamp {
    glm::dvec2 direction{1.0, 0.0};
    double slopes[elevations] = {};
};

[[nodiscard]] inline double part(int i, int of, measure_detail::generator& random) {
    return (double(i) + double(random.below(1 << 20)) / double(1 << 20)) / double(of);
}

[[nodiscard]] inline lamp choose_lamp(const scene& s, const view& v, int ray, glm::dvec2 place,
                                      measure_detail::generator& random) {
    lamp l;
    const auto from = [&](glm::dvec3 towards) {
        const double flat = std::hypot(towards.x, towards.y);
        if (flat > 0.0) l.direction = glm::dvec2(towards) / flat;
        l.slopes[0] = flat > 0.0 ? towards.z / flat : 1e9;
    };
    if (!s.lights.empty()) {
        from(s.lights[std::size_t(ray) * s.lights.size() / std::size_t(v.rays)]);
    } else if (!s.positions.empty()) {
        from(s.positions[std::size_t(ray) * s.positions.size() / std::size_t(v.rays)] - glm::dvec3(place, 0.0));
    } else {
        const light_arc& a = s.arc;
        const double bearing = a.first_bearing + (a.last_bearing - a.first_bearing) * part(ray, v.rays, random);
        l.direction = exact_direction(bearing - std::floor(bearing));
        for (int e = 0; e < elevations; ++e) {
            const double degrees = a.lowest + (a.highest - a.lowest) * part(e, elevations, random);
            l.slopes[e] = std::tan((std::min)(degrees, 89.9999) * (std::numbers::pi / 180.0));
        }
    }
    return l;
}

// Asks exact about the looks of one patch. out: v.pixels * v.rays of them, pixel by pixel.
template <height_sample Sample>
void look_at_patch(const height_map<Sample>& heights, const height_bounds<Sample>& bounds, const scene& s,
                   const patches& all, const view& v, int patch, std::uint32_t seed, look* out) {
    measure_detail::generator random((std::uint64_t(seed) << 32) + std::uint64_t(patch) + 1);
    const glm::ivec2 origin = all.origins[std::size_t(patch)];
    // Pixels stand where reduced texels do, their middles in the core.
    const glm::ivec2 cells = all.extent / v.pixel;
    const int first = all.whole() ? (2 * core_first + v.pixel - 1) / (2 * v.pixel) : 0;
    const glm::ivec2 room =
        all.whole() ? glm::ivec2((std::max)(core_side / v.pixel, 2)) : (glm::max)(cells, glm::ivec2(1));
    for (int i = 0; i < v.pixels; ++i) {
        const glm::ivec2 cell(first + random.below(room.x), first + random.below(room.y));
        const glm::ivec2 corner = cell * v.pixel;
        const glm::vec2 middle = glm::vec2(corner) + 0.5f * float(v.pixel);
        for (int ray = 0; ray < v.rays; ++ray) {
            look& l = out[i * v.rays + ray];
            const glm::dvec2 place = (glm::dvec2(origin) + glm::dvec2(middle) - 0.5) * heights.texel_size;
            const lamp light = choose_lamp(s, v, ray, place, random);
            l = {middle, patch, glm::vec2(light.direction), 0.0f, 0.0f, {}, {}};
            for (int e = 0; e < v.lights; ++e) l.light[e] = float(light.slopes[e]);
            const exact_detail::rays<Sample> rays(heights, bounds, light.direction, bake_options{}.radius, {});
            double sum = 0.0;
            for (int k = 0; k < v.samples; ++k) {
                const glm::ivec2 inside(k % v.pixel, k / v.pixel);
                const auto [slope, distance] = rays((glm::min)(origin + corner + inside, heights.extent - 1));
                sum += (std::max)(slope, 0.0);
                for (int e = 0; e < v.lights; ++e) {
                    const bool blocked = light.slopes[e] < slope;
                    l.lit[e] += blocked ? 0.0f : 1.0f / float(v.samples);
                    if (blocked) l.reach = (std::max)(l.reach, float(distance));
                }
            }
            l.horizon = float(sum / v.samples);
        }
    }
}

}  // namespace bumpshadow::plan_detail
