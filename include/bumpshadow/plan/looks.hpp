#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/plan/scene.hpp>

#include <glm/common.hpp>

// The sample that a plan is judged by: pixels in patches of the map, lights of the scene, and what exact says of them.
// Part of plan.hpp.
namespace bumpshadow::plan_detail {

inline constexpr int patch_side = 32;                                 // texels; a multiple of every reduction
inline constexpr int most_patches = 512, most_patches_of_one = 2048;  // the latter where one direction is baked
inline constexpr int most_reduction = 8;
// Where the middles of pixels are: in the middle of a patch, so that reduced texels on all sides of them are there.
inline constexpr int core_first = 12, core_side = 8;
inline constexpr int elevations = 4;                     // of an arc, in each bearing
inline constexpr int bearings = 8, baked_bearings = 12;  // of an arc
// Rays of exact, each of which takes a microsecond or two; the latter where each of them is asked about one light
// alone.
inline constexpr int most_rays = 16384, most_rays_of_one = 32768;

// Squares of a map, which stand side by side where they are packed. Any number of them from the first on is spread over
// the map, too. Of maps with borders that do not repeat the outer 12 texels are in no pixel: the sample speaks for the
// rest.
struct patches {
    glm::ivec2 extent{0};       // of one
    glm::bvec2 repeats{false};  // a patch as wide as a map that repeats
    int count = 0;
    int pixel = 1;  // texels along the side of a pixel
    std::array<glm::ivec2, most_patches_of_one> origins;

    [[nodiscard]] glm::ivec2 row() const { return {extent.x * count, extent.y}; }
    // Whether patches can be reduced by it.
    [[nodiscard]] bool divides(int by) const {
        return by <= most_reduction && extent.x % by == 0 && extent.y % by == 0;
    }
    [[nodiscard]] bool whole() const { return extent == glm::ivec2(patch_side); }

    // What of a patch is packed, in texels reduced by `by`: all that pixels are filtered from, whole blocks of 4 x 4.
    // Of maps smaller than a patch all.
    [[nodiscard]] rectangle part(int by) const {
        if (!whole()) return {glm::ivec2(0), extent / by};
        const int side = by == 8 ? 4 : by == 1 && pixel > 1 ? 16 : 8;
        return {glm::ivec2((patch_side / by - side) / 2), glm::ivec2(side)};
    }
    // Of the first `of` patches.
    [[nodiscard]] glm::ivec2 packed(int by, int of) const {
        const glm::ivec2 side = part(by).extent;
        return {side.x * of, side.y};
    }
};

// Spread over the map, on multiples of the largest reduction where there is room for it.
[[nodiscard]] inline patches choose_patches(glm::ivec2 map, edge_mode edge, int most, std::uint32_t seed) {
    patches all;
    all.extent = (glm::min)(map, glm::ivec2(patch_side));
    all.repeats = glm::bvec2(edge == edge_mode::repeat && map.x == all.extent.x,
                             edge == edge_mode::repeat && map.y == all.extent.y);
    const glm::ivec2 places = (map - all.extent) / most_reduction + 1;
    all.count = int((std::min)(std::int64_t(most), std::int64_t(places.x) * places.y));
    std::array<glm::ivec2, most_patches_of_one> drawn;
    const status s = sample_texels(places, seed, std::span(drawn).first(std::size_t(all.count)));
    BUMPSHADOW_ASSERT(bool(s));
    static_cast<void>(s);
    // Drawn row by row; steps of the golden section spread the first of them.
    int step = int(0.618 * all.count) + 1;
    while (std::gcd(step, all.count) != 1) ++step;
    for (int i = 0; i < all.count; ++i)
        all.origins[std::size_t(i)] = drawn[std::size_t(std::int64_t(i) * step % all.count)] * most_reduction;
    return all;
}

// A pixel and a bearing with up to `elevations` lights.
struct look {
    glm::vec2 place;  // of the pixel's middle in its patch, in texels
    int patch;
    glm::vec2 direction;  // of unit length
    float horizon;        // a slope, not below 0; of the pixel's texels the mean
    double reach;         // how far occluders of these lights are, at the most, in the unit of texel_size; 0: unknown
    float light[elevations];
    float lit[elevations];  // share of the pixel that is lit
};

struct view {
    int lights = elevations;  // that a look has
    int pixels = 0;           // of a patch
    int rays = 1;             // bearings of a pixel

    [[nodiscard]] std::size_t looks(int patch_count) const {
        return std::size_t(patch_count) * std::size_t(pixels) * std::size_t(rays);
    }
};

// Pixels of many texels under far lights are all looked at in the same bearings, whose horizons are baked.
[[nodiscard]] inline bool is_baked(const scene& s, const patches& all) { return all.pixel > 1 && s.positions.empty(); }

[[nodiscard]] inline view shape_view(const scene& s, patches& all) {
    while (2 * all.pixel <= s.texels_per_pixel && all.divides(2 * all.pixel)) all.pixel *= 2;
    view v;
    const std::size_t fixed = !s.lights.empty() ? s.lights.size() : s.positions.size();
    const bool baked = is_baked(s, all);
    const int most = all.pixel == 1 ? bearings : baked ? baked_bearings : 1;
    v.rays = fixed == 0 ? most : int((std::min)(fixed, std::size_t(most)));
    v.lights = fixed == 0 ? elevations : 1;
    const int each = baked ? 1 : all.pixel * all.pixel;
    v.pixels = (std::clamp)((fixed == 0 ? most_rays : most_rays_of_one) / (all.count * v.rays * each), 1,
                            core_side * core_side / 2);
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

// where: draws a bearing of an arc; random: elevations
[[nodiscard]] inline lamp choose_lamp(const scene& s, const view& v, int ray, glm::dvec2 place,
                                      measure_detail::generator& where, measure_detail::generator& random) {
    lamp l;
    const auto from = [&](glm::dvec3 towards) {
        const double flat = std::hypot(towards.x, towards.y);
        if (flat > 0.0) l.direction = glm::dvec2(towards) / flat;
        l.slopes[0] = flat > 0.0 ? towards.z / flat : 1e9;
    };
    // Of more lights than rays, others in each pixel.
    const auto one_of = [&](const auto& all) {
        const std::size_t first = std::size_t(ray) * all.size() / std::size_t(v.rays),
                          last = std::size_t(ray + 1) * all.size() / std::size_t(v.rays);
        return all[first + std::size_t(where.below(int(last - first)))];
    };
    if (!s.lights.empty()) {
        from(one_of(s.lights));
    } else if (!s.positions.empty()) {
        from(one_of(s.positions) - glm::dvec3(place, 0.0));
    } else {
        const light_arc& a = s.arc;
        const double bearing = a.first_bearing + (a.last_bearing - a.first_bearing) * part(ray, v.rays, where);
        l.direction = exact_direction(bearing - std::floor(bearing));
        for (int e = 0; e < elevations; ++e) {
            const double degrees = a.lowest + (a.highest - a.lowest) * part(e, elevations, random);
            l.slopes[e] = std::tan((std::min)(degrees, 89.9999) * (std::numbers::pi / 180.0));
        }
    }
    return l;
}

// What horizons of a pixel's texels say of a look.
struct exposure {
    double sum = 0.0;
    int texels = 0;
    int blocked[elevations] = {};

    void add(const view& v, const look& l, double slope) {
        sum += (std::max)(slope, 0.0);
        ++texels;
        for (int e = 0; e < v.lights; ++e) blocked[e] += double(l.light[e]) < slope ? 1 : 0;
    }
    void write(const view& v, look& l) const {
        l.horizon = float(sum / texels);
        for (int e = 0; e < v.lights; ++e) l.lit[e] = float(texels - blocked[e]) / float(texels);
    }
};

[[nodiscard]] inline measure_detail::generator generator_of(std::uint32_t seed, int i) {
    return measure_detail::generator((std::uint64_t(seed) << 32) + std::uint64_t(i) + 1);
}

// The looks of one patch, not yet at anything. out: v.pixels * v.rays of them, pixel by pixel.
inline void choose_looks(const scene& s, const patches& all, const view& v, glm::dvec2 texel_size, int patch,
                         std::uint32_t seed, look* out) {
    measure_detail::generator random = generator_of(seed, patch);
    const bool baked = is_baked(s, all);
    const glm::ivec2 first = all.whole() ? glm::ivec2(core_first - all.pixel / 2) : glm::ivec2(0);
    const glm::ivec2 room = all.whole() ? glm::ivec2(core_side) : all.extent - all.pixel + 1;
    for (int i = 0; i < v.pixels; ++i) {
        const glm::ivec2 corner(first.x + random.below(room.x), first.y + random.below(room.y));
        const glm::vec2 middle = glm::vec2(corner) + 0.5f * float(all.pixel);
        const glm::dvec2 place = (glm::dvec2(all.origins[std::size_t(patch)]) + glm::dvec2(middle) - 0.5) * texel_size;
        for (int ray = 0; ray < v.rays; ++ray) {
            measure_detail::generator shared = generator_of(seed, -2 - ray);
            const lamp light = choose_lamp(s, v, ray, place, baked ? shared : random, random);
            look& l = out[i * v.rays + ray];
            l = {middle, patch, glm::vec2(light.direction), 0.0f, 0.0, {}, {}};
            for (int e = 0; e < v.lights; ++e) l.light[e] = float(light.slopes[e]);
        }
    }
}

// First texel of a look's pixel, in the map.
[[nodiscard]] inline glm::ivec2 corner_of(const look& l, const patches& all) {
    return all.origins[std::size_t(l.patch)] + glm::ivec2(l.place - 0.5f * float(all.pixel) + 0.25f);
}

// Asks exact about a look.
template <height_sample Sample>
void ask_exact(const height_map<Sample>& heights, const height_bounds<Sample>& bounds, const patches& all,
               const view& v, look& l) {
    const exact_detail::rays<Sample> rays(heights, bounds, glm::dvec2(l.direction), bake_options{}.radius, {});
    const glm::ivec2 corner = corner_of(l, all);
    exposure e;
    for (int y = 0; y < all.pixel; ++y)
        for (int x = 0; x < all.pixel; ++x) {
            const auto [slope, distance] = rays(corner + glm::ivec2(x, y));
            e.add(v, l, slope);
            for (int i = 0; i < v.lights; ++i)
                if (double(l.light[i]) < slope) l.reach = (std::max)(l.reach, distance);
        }
    e.write(v, l);
}

}  // namespace bumpshadow::plan_detail
