#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <span>

#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/plan/looks.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/reference/pixel_shadow.hpp>
#include <bumpshadow/reference/tangent_shadow.hpp>
#include <bumpshadow/status.hpp>

// What a recipe does, tried on the patches of a map. Part of plan.hpp.
namespace bumpshadow::plan_detail {

// A packed texture as numbers, [slice][y][x], and where the looks' patches are in it. It reads what horizon() of
// reference/tangent_shadow.hpp reads from the texture itself, many times as fast.
struct unpacked {
    const tangent_volume& encoding;
    const_texture packed;
    const float* values;
    rectangle part;  // of a patch
    glm::bvec2 repeats;
    int reduction, pixel;  // in texels

    // What a look sees of the slices around its bearing.
    [[nodiscard]] sampler_detail::tap slices_at(glm::vec2 direction) const {
        if (encoding.kind == texture_kind::flat) return {};
        const float bearing = shadow_detail::bearing_of(encoding.slices.function, direction);
        if (encoding.kind == texture_kind::array) return shadow_detail::layers_at(encoding, packed, bearing);
        return sampler_detail::linear_tap(shadow_detail::coordinate_at(encoding, bearing), encoding.slices.count,
                                          shadow_detail::address_of(encoding), filter_weights::exact);
    }

    // Horizons at taps x taps places of the look's pixel, as they are stored.
    void read(const look& l, int taps, float* horizons) const {
        const sampler_detail::tap slices = slices_at(l.direction);
        const glm::ivec2 extent = packed.layout.extent;
        const std::size_t of_slice = std::size_t(extent.x) * std::size_t(extent.y);
        const float* const patch = values + std::size_t(l.patch * part.extent.x);
        const float *const a = patch + std::size_t(slices.first) * of_slice, *const b =
                                                                                 patch +
                                                                                 std::size_t(slices.second) * of_slice;
        const auto along = [](float at, int size, bool repeat) {
            const float floor = std::floor(at);
            const int i = int(floor);
            const auto inside = [&](int n) { return repeat ? (n + size) % size : (std::clamp)(n, 0, size - 1); };
            return sampler_detail::tap{inside(i), inside(i + 1), at - floor};
        };
        const glm::vec2 middle = l.place / float(reduction) - glm::vec2(part.origin) - 0.5f;
        const float step = float(pixel) / float(reduction);
        for (int i = 0; i < taps * taps; ++i) {
            const glm::vec2 at = middle + step * tap_offset(i, taps);
            const auto x = along(at.x, part.extent.x, repeats.x), y = along(at.y, part.extent.y, repeats.y);
            const auto in_row = [&](const float* slice, int row) {
                const float* const from = slice + std::size_t(row) * std::size_t(extent.x);
                return from[x.first] + (from[x.second] - from[x.first]) * x.weight;
            };
            const auto in_slice = [&](const float* slice) {
                const float first = in_row(slice, y.first);
                return first + (in_row(slice, y.second) - first) * y.weight;
            };
            const float first = in_slice(a);
            horizons[i] = slices.weight == 0.0f ? first : first + (in_slice(b) - first) * slices.weight;
        }
    }
};

struct verdict {
    double mismatch = 1.0, interval = 0.0, degrees = 90.0;
    double pack_seconds = 0.0;  // of the patches
    shadow_edge edge = {};
};

// Every light of every look under one edge.
//   horizons: taps * taps of each look
[[nodiscard]] inline verdict judge(std::span<const look> looks, const float* horizons, const recipe& r, const view& v,
                                   int patch_count, const shadow_edge& edge) {
    const std::size_t each = looks.size() / std::size_t(patch_count), places = std::size_t(r.taps * r.taps);
    const double answers = double(each) * v.lights;
    double sum = 0.0, squares = 0.0;
    for (int p = 0; p < patch_count; ++p) {
        double wrong = 0.0;
        for (std::size_t i = std::size_t(p) * each; i < (std::size_t(p) + 1) * each; ++i)
            for (int e = 0; e < v.lights; ++e) {
                const float level =
                    quantity_of_slope(r.encoding.scale.stored, looks[i].light[e]) * stored_scale(r.encoding.scale);
                float lit = 0.0f;
                for (std::size_t t = i * places; t < (i + 1) * places; ++t)
                    lit += shadow_detail::edge_factor(level, horizons[t], edge);
                wrong += double(std::abs(lit / float(places) - looks[i].lit[e]));
            }
        sum += wrong / answers;
        squares += wrong / answers * (wrong / answers);
    }
    verdict found;
    const double n = patch_count;
    found.mismatch = sum / n;
    found.interval =
        n < 2.0 ? std::numeric_limits<double>::infinity()
                : standard_errors_95(n - 1.0) * std::sqrt((std::max)(squares - sum * sum / n, 0.0) / (n - 1.0) / n);
    found.edge = edge;
    return found;
}

// A pixel of many texels is lit in part: the centered edge that is as wide as their horizons differ.
template <class Judge>
[[nodiscard]] verdict find_edge(const Judge& judge_edge) {
    constexpr float widths[] = {64.0f, 45.0f, 32.0f, 23.0f, 16.0f, 11.0f, 8.0f, 5.6f, 4.0f, 2.8f, 2.0f, 1.4f, 1.0f};
    constexpr int count = int(std::size(widths));
    int best = 6;
    verdict found = judge_edge(shadow_edge{widths[best], 0.5f});
    for (const int step : {-1, 1})
        for (int next = best + step; next >= 0 && next < count; next += step) {
            const verdict other = judge_edge(shadow_edge{widths[next], 0.5f});
            if (!(other.mismatch < found.mismatch)) break;
            found = other;
            best = next;
        }
    return found;
}

// Packs horizons of patches as the recipe says and looks at them as its shader does.
//   slopes: in `directions`, reduced and cropped, side by side; texels, values: scratch for the texture; horizons:
//   scratch, taps * taps of a look
[[nodiscard]] inline status try_recipe(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                       const recipe& r, int reduction, const view& v, const patches& all,
                                       std::span<const look> looks, std::span<std::byte> texels, float* values,
                                       float* horizons, std::pmr::memory_resource* memory, verdict& found) {
    const texture_layout layout = layout_of(r.encoding, slopes.extent);
    const texture packed{texels.first(layout.required_size()), layout};
    pack_options options;
    options.fit = r.fit;
    options.memory = memory;
    const auto start = std::chrono::steady_clock::now();
    if (status s = pack_tangent_volume(slopes, directions, r.encoding, options, packed); !s) return s;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

    const const_texture from{packed.bytes, layout};
    float* to = values;
    for (int slice = 0; slice < r.encoding.slices.count; ++slice)
        for (int y = 0; y < layout.extent.y; ++y, to += layout.extent.x)
            tangent_volume_detail::read_texels(from, 0, slice, 0, y, layout.extent.x, to);
    const rectangle part = all.part(reduction);
    const unpacked texture{r.encoding, from, values, part, all.repeats, reduction, all.pixel};
    const int places = r.taps * r.taps;
    double degrees = 0.0;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        float* const at = horizons + i * std::size_t(places);
        texture.read(looks[i], r.taps, at);
        double slope = 0.0;
        for (int t = 0; t < places; ++t) slope += double(slope_of_stored(r.encoding.scale, at[t])) / places;
        degrees += std::abs(std::atan(slope) -
                            std::atan((std::min)(double(looks[i].horizon), double(r.encoding.scale.max_slope))));
    }
    const int count = slopes.extent.x / part.extent.x;
    const auto judge_edge = [&](const shadow_edge& edge) { return judge(looks, horizons, r, v, count, edge); };
    found = all.pixel == 1 ? judge_edge({}) : find_edge(judge_edge);
    found.degrees = degrees / double(looks.size()) * (180.0 / std::numbers::pi);
    found.pack_seconds = time.count();
    return {};
}

}  // namespace bumpshadow::plan_detail
