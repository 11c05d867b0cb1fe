#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <span>
#include <utility>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/plan/looks.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/status.hpp>

// What a recipe does, tried on the patches of a map. Part of plan.hpp.
namespace bumpshadow::plan_detail {

// Directions whose horizons of the whole map are held at a time.
inline constexpr int directions_at_once = 8;
inline constexpr int most_directions = 97;

// Heights averaged over squares.
template <height_sample Sample>
void average_heights(const height_map<Sample>& from, int side, glm::ivec2 extent, float* out) {
    const double unit = unit_height(from), reference = reference_sample(from);
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
                count > 0 ? float(unit * sum / count) : std::numeric_limits<float>::quiet_NaN();
        }
}

// Bakes a map in some directions and keeps the patches.
//   reduced: the side of the squares that its heights were averaged over, and that the patches shrink by
//   slices: of the whole map, directions_at_once of them; out: the stack, one slice a direction
//   steepest: raised to the steepest horizon of the whole map
template <height_sample Sample>
[[nodiscard]] status bake_patches(const height_map<Sample>& heights, const patches& all, int reduced,
                                  std::span<const glm::dvec2> directions, const bake_options& options,
                                  std::span<float> slices, const horizon_map& out, float& steepest) {
    const glm::ivec2 side = all.extent / reduced;
    for (std::size_t first = 0; first < directions.size(); first += directions_at_once) {
        const std::size_t count = (std::min)(directions.size() - first, std::size_t(directions_at_once));
        const horizon_map whole{.values = slices, .extent = heights.extent, .bearings = int(count)};
        if (status s = bake_cascade(heights, directions.subspan(first, count), whole, options); !s) return s;
        steepest = (std::max)(steepest, steepest_slope(whole));
        for (std::size_t i = 0; i < count; ++i)
            for (int p = 0; p < all.count; ++p) {
                const glm::ivec2 origin = all.origins[std::size_t(p)] / reduced;
                for (int y = 0; y < side.y; ++y)
                    std::copy_n(whole.row(int(i), origin.y + y) + origin.x, side.x,
                                out.row(int(first + i), p * side.y + y));
            }
    }
    return {};
}

// Copies what of the patches is packed.
inline void crop_patches(const horizon_map& from, const patches& all, int reduced, const horizon_map& out) {
    const rectangle part = all.part(reduced);
    const int side = all.extent.y / reduced;
    for (int b = 0; b < from.bearings; ++b)
        for (int p = 0; p < all.count; ++p)
            for (int y = 0; y < part.extent.y; ++y)
                std::copy_n(from.row(b, p * side + part.origin.y + y) + part.origin.x, part.extent.x,
                            out.row(b, p * part.extent.y + y));
}

struct verdict {
    double mismatch = 1.0, interval = 0.0, degrees = 90.0;
    shadow_edge edge = {};
};

// Every light of every look under one edge.
[[nodiscard]] inline verdict judge(std::span<const look> looks, const float* horizons, const recipe& r, const view& v,
                                   int patch_count, const shadow_edge& edge) {
    const std::size_t each = looks.size() / std::size_t(patch_count);
    const double answers = double(each) * v.lights;
    double sum = 0.0, squares = 0.0;
    for (int p = 0; p < patch_count; ++p) {
        double wrong = 0.0;
        for (std::size_t i = std::size_t(p) * each; i < (std::size_t(p) + 1) * each; ++i)
            for (int e = 0; e < v.lights; ++e) {
                const float level =
                    quantity_of_slope(r.encoding.scale.stored, looks[i].light[e]) * stored_scale(r.encoding.scale);
                wrong += double(std::abs(shadow_detail::edge_factor(level, horizons[i], edge) - looks[i].lit[e]));
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

// Packs horizons of the stack as the recipe says and looks at them as its shader does.
//   slopes: in `directions`, reduced and cropped; texels: scratch for the texture; horizons: scratch, one a look
[[nodiscard]] inline status try_recipe(const horizon_map& slopes, std::span<const glm::dvec2> directions,
                                       const recipe& r, int reduction, const view& v, const patches& all,
                                       std::span<const look> looks, std::span<std::byte> texels, float* horizons,
                                       std::pmr::memory_resource* memory, verdict& found) {
    const texture_layout layout = layout_of(r.encoding, slopes.extent);
    const texture packed{texels.first(layout.required_size()), layout};
    pack_options options;
    options.fit = r.fit;
    options.memory = memory;
    if (status s = pack_tangent_volume(slopes, directions, r.encoding, options, packed); !s) return s;
    const const_texture from{packed.bytes, layout};
    const rectangle part = all.part(reduction);
    const sampler how{.x = address_mode::clamp, .y = address_mode::clamp};
    double degrees = 0.0;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const look& l = looks[i];
        const glm::vec3 light(l.direction.x, l.direction.y, l.light[0]);
        const glm::vec2 in_part = l.place / float(reduction) - glm::vec2(part.origin);
        const glm::vec2 uv = (in_part + glm::vec2(0.0f, float(l.patch * part.extent.y))) / glm::vec2(slopes.extent);
        horizons[i] = horizon(r.encoding, from, how, uv, light);
        const double slope = double(slope_of_stored(r.encoding.scale, horizons[i]));
        degrees +=
            std::abs(std::atan(slope) - std::atan((std::min)(double(l.horizon), double(r.encoding.scale.max_slope))));
    }
    found = judge(looks, horizons, r, v, all.count, {});
    // A pixel of many texels is lit in part: the edge that is as wide as their horizons differ.
    for (const float k : {64.0f, 32.0f, 16.0f, 12.0f, 8.0f, 6.0f, 4.0f, 3.0f, 2.0f, 1.0f})
        for (const float c : {0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f}) {
            if (v.pixel == 1) break;
            const verdict soft = judge(looks, horizons, r, v, all.count, {k, c});
            if (soft.mismatch < found.mismatch) found = soft;
        }
    found.degrees = degrees / double(looks.size()) * (180.0 / std::numbers::pi);
    return {};
}

}  // namespace bumpshadow::plan_detail
