#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade_build.hpp>
#include <bumpshadow/horizon/cascade_cells.hpp>
#include <bumpshadow/horizon/cascade_far.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/cascade_near.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/simd.hpp>

// One direction of the cascade, from its highest level down to texels and the output. Part of horizon/cascade.hpp.
namespace bumpshadow::cascade_detail {

// What all items of a bake share.
struct job {
    const frames& both;
    height_range range;
    const bake_options& options;
    const horizon_map& out;
    rectangle region;
};

[[nodiscard]] inline glm::ivec2 swapped(glm::ivec2 v) { return {v.y, v.x}; }
[[nodiscard]] inline glm::dvec2 swapped(glm::dvec2 v) { return {v.y, v.x}; }

// How far the levels look. Distances count from the texel, in units of length.
struct reach {
    std::array<double, most_levels> to{};
    int top = 0;  // the highest level that is needed
};

[[nodiscard]] inline reach plan_reach(const pyramid& p, const ray& r, int steps) {
    reach s;
    for (int j = 0; j < p.count; ++j) {
        const double from = j > 0 ? s.to[std::size_t(j) - 1] : 0.0;
        const double wanted = j == p.count - 1 ? r.farthest
                              : j == 0         ? p.ground_rows / std::abs(r.step.y)
                                               : growth(j, p.ground_rows, p.narrow) * from;
        const double most =
            j == 0 ? double(most_looks(steps)) / std::abs(r.step.y) : double(most_rows) / level_row_step(p, r, j);
        s.to[std::size_t(j)] = (std::min)({wanted, r.farthest, from + most});
        s.top = j;
        if (s.to[std::size_t(j)] >= r.farthest) break;
    }
    return s;
}

// Occluders farther than this are beyond the radius or all borders, or make slopes of less than 1/1024 (0.06 degrees)
// on a map that repeats and has been seen four times over.
[[nodiscard]] inline double farthest_distance(const job& j, const pyramid& p, glm::dvec2 step, bool never_negative) {
    const bool endless = is_infinite(j.options.radius);
    double farthest = endless ? (std::numeric_limits<double>::max)() : j.options.radius / p.unit;
    const glm::dvec2 extent(p.texels.texels);
    if (p.edge == edge_mode::clamp || p.edge == edge_mode::open) {
        const double x = (extent.x + 1.0) / std::abs(step.x), y = (extent.y + 1.0) / std::abs(step.y);
        if (p.edge == edge_mode::open)
            farthest = (std::min)({farthest, x, y});
        else
            farthest = (std::min)(farthest, step.x == 0.0 ? y : (std::max)(x, y));
    } else if (never_negative || endless) {
        const double low = 1024.0 * (double(j.range.highest) - double(j.range.lowest)) + 1.0;
        farthest =
            (std::min)({farthest, low, (std::max)(4096.0, 4.0 * (std::max)(extent.x, extent.y)) / std::abs(step.y)});
    }
    return farthest;
}

// Writes pieces of rows to the output: at once, or a block at a time where rows of the frame are columns of the output.
class writer {
public:
    writer(const job& j, int bearing, bool transposed, float* block)
        : j_(j),
          bearing_(bearing),
          transposed_(transposed),
          with_distances_(!j.options.distances.values.empty()),
          block_(block) {}

    // Where the slopes, and the inverse distances, of a piece of a row go. All pieces of a block begin at the same x.
    [[nodiscard]] float* slopes() { return block_ + filled_ * (strip + chunk); }
    [[nodiscard]] float* inverses() { return slopes() + block_rows * (strip + chunk); }

    void wrote(int x, int y, int count) {
        if (!transposed_) {
            store(j_.out, x, y, count, slopes());
            if (with_distances_) store(j_.options.distances, x, y, count, inverses());
            return;
        }
        if (filled_ == 0) {
            first_ = y;
            // The first block ends where the output is aligned, so that the others write whole cache lines.
            const int odd = before_alignment(j_.out.row(bearing_, x - j_.region.origin.y) + (y - j_.region.origin.x));
            limit_ = odd == 0 ? block_rows : odd;
        }
        x_ = x;
        count_ = count;
        if (++filled_ == limit_) flush();
    }

    // Has to be called before pieces begin elsewhere.
    void flush() {
        const int rows = filled_;
        filled_ = 0;
        if (rows == 0) return;
        store_transposed(j_.out, rows, slopes());
        if (with_distances_) store_transposed(j_.options.distances, rows, inverses());
    }

private:
    // Floats up to the next place that is aligned for a pack.
    [[nodiscard]] static int before_alignment(const float* p) {
        return int((std::uintptr_t(0) - reinterpret_cast<std::uintptr_t>(p)) % sizeof(simd::pack) / sizeof(float));
    }
    void store(const horizon_map& to, int x, int y, int count, const float* from) const {
        const glm::ivec2 origin = j_.region.origin;
        float* const row = to.row(bearing_, y - origin.y) + (x - origin.x);
        int i = 0;
        for (const int end = (std::min)(before_alignment(row), count); i < end; ++i) row[i] = from[i];
        for (; i + simd::width <= count; i += simd::width) simd::stream(row + i, simd::load(from + i));
        for (; i < count; ++i) row[i] = from[i];
    }
    void store_transposed(const horizon_map& to, int rows, const float* from) const {
        const glm::ivec2 origin = j_.region.origin;
        const auto at = [&](int i) { return to.row(bearing_, x_ + i - origin.y) + (first_ - origin.x); };
        constexpr int pitch = strip + chunk;
        int i = 0;
        // Rows before the first that begins a cache line of the output are not a multiple of the pack width.
        const int single = rows % simd::width;
        const int first = rows == limit_ ? single : 0, end = first + rows - single;
        if (end > first)
            for (; i + simd::width <= count_; i += simd::width) {
                for (int k = first; k < end; k += simd::width) {
                    simd::pack square[simd::width];
                    for (int n = 0; n < simd::width; ++n) square[n] = simd::load(from + (k + n) * pitch + i);
                    simd::transpose(square);
                    for (int n = 0; n < simd::width; ++n) simd::stream(at(i + n) + k, square[n]);
                }
                for (int n = i; n < i + simd::width; ++n) {
                    for (int k = 0; k < first; ++k) at(n)[k] = from[k * pitch + n];
                    for (int k = end; k < rows; ++k) at(n)[k] = from[k * pitch + n];
                }
            }
        for (; i < count_; ++i)
            for (int k = 0; k < rows; ++k) at(i)[k] = from[k * pitch + i];
    }

    const job& j_;
    int bearing_;
    bool transposed_, with_distances_;
    float* block_;
    int filled_ = 0, limit_ = block_rows, first_ = 0, x_ = 0, count_ = 0;
};

// From level 1 to texels. tangent: columns a row of the base grid
[[nodiscard]] inline interpolation parents_of_texels(const pyramid& p, const ray& r, double tangent) {
    const glm::dvec2 base = p.base;
    const int width = p.levels[1].width, height = 2 * width;
    return {
        .lanes = {base.x / width,
                  pyramid::in_cells(0.5 * base.x - 0.5, width) - tangent * (0.5 * base.y - 0.5 - p.middle(1)) / width,
                  -tangent * base.y / width},
        .row_scale = base.y / height,
        .row_start = 0.5 * height / base.y - 0.5,
        .spacing = height / (r.step.y * base.y),
        .nearest = p.ground_rows / std::abs(r.step.y),
        .bend = r.bend};
}

// Inverse of the distance at which a ray leaves an open map, on the side that it goes to; a quarter of it is added,
// since what a cell sees on the border may be as much farther away for it than for its texels.
[[nodiscard]] inline float inverse_of_end(double step, int at, int texels_of_axis) {
    const double way = step > 0.0 ? texels_of_axis - 1 - at : at;
    return step == 0.0 ? 0.0f : way > 0.0 ? float(0.8 * std::abs(step) / way) : inverse_of_zero;
}

// Bakes a rectangle of texels, in the coordinates of its frame, from what their parents see.
template <bool Holes, bool Track>
void look_from_texels(const pyramid& p, const ray& r, rectangle texels, float floor, const pairs* parent,
                      double tangent, slot& s, writer& to) {
    interpolation bring = parents_of_texels(p, r, tangent);
    bring.parent = parent;
    bring.line = s.parent_line;
    bring.line_floats = s.line_floats;
    const glm::ivec2 end = texels.origin + texels.extent;
    const bool open = Holes && p.edge == edge_mode::open;
    float end_of_columns[strip + chunk];
    for (int x = texels.origin.x; x < end.x; x += strip) {
        const int count = (std::min)(strip, end.x - x);
        const int lanes = (count + simd::width - 1) / simd::width * simd::width;
        for (int i = 0; open && i < lanes; ++i)
            end_of_columns[i] = inverse_of_end(r.step.x, (std::min)(x + i, end.x - 1), p.texels.texels.x);
        for (int y = texels.origin.y; y < end.y; ++y) {
            const float* const heights = p.texels.values + p.texels.offset(x, y);
            float *const slopes = to.slopes(), *const inverses = to.inverses();
            int i = 0;
            for (; i + chunk <= lanes; i += chunk)
                look_around<packs, Track>(s.around, heights + i, floor, slopes + i, inverses + i);
            for (; i < lanes; i += simd::width)
                look_around<1, Track>(s.around, heights + i, floor, slopes + i, inverses + i);
            if (parent != nullptr) {
                bring.template operator()<Holes>(x, y, lanes, [&](int k, simd::pack a, simd::pack b) {
                    const simd::pack own = simd::load(slopes + k);
                    simd::pack theirs = slope_of(a, b, simd::load(heights + k));
                    if (open) {
                        const simd::pack end_of_row = simd::splat(inverse_of_end(r.step.y, y, p.texels.texels.y));
                        const simd::pack end_of_ray = simd::larger(simd::load(end_of_columns + k), end_of_row);
                        theirs = simd::select_greater(end_of_ray, b, simd::splat(hole), theirs);
                    }
                    if constexpr (Track)
                        simd::store(inverses + k, simd::select_greater(theirs, own, b, simd::load(inverses + k)));
                    simd::store(slopes + k, simd::larger(theirs, own));
                });
            }
            if constexpr (Holes)
                for (int k = 0; k < count; ++k)
                    if (heights[k] < hole_limit || slopes[k] < hole_limit) {
                        slopes[k] = no_horizon;
                        if constexpr (Track) inverses[k] = 0.0f;
                    }
            if constexpr (Track)
                for (int k = 0; k < count; ++k)
                    inverses[k] = inverses[k] >= inverse_of_zero ? 0.0f
                                  : inverses[k] > 0.0f           ? float(p.unit / double(inverses[k]))
                                                                 : std::numeric_limits<float>::infinity();
            to.wrote(x, y, count);
        }
        to.flush();
    }
}

// The direction in texels a unit of length, and the frame it needs.
struct heading {
    glm::dvec2 unit_direction;
    glm::dvec2 step;
    bool transposed;
};
[[nodiscard]] inline heading head(glm::dvec2 direction, glm::dvec2 spacing) {
    const glm::dvec2 scaled = direction / (std::max)(std::abs(direction.x), std::abs(direction.y));
    const glm::dvec2 d = scaled / std::hypot(scaled.x, scaled.y), step = d / spacing;
    const bool transposed = std::abs(step.x) > std::abs(step.y);
    return {d, transposed ? swapped(step) : step, transposed};
}

// A direction in the frame that it needs, and how far is looked.
struct aim {
    heading head;
    bool never_negative = true;
    ray along = {};
    reach range = {};
};
[[nodiscard]] inline aim take_aim(const job& j, glm::dvec2 direction) {
    aim a{.head = head(direction, j.both[0].spacing)};
    const pyramid& p = j.both[a.head.transposed ? 1 : 0];
    const double curvature = curvature_along(j.options.curvature, a.head.unit_direction) * p.unit;
    a.never_negative = horizon_is_never_negative(p.edge, j.options.radius, curvature);
    a.along = {.step = a.head.step, .bend = 0.5 * curvature};
    a.along.farthest = farthest_distance(j, p, a.head.step, a.never_negative);
    a.range = plan_reach(p, a.along, j.options.steps);
    return a;
}

// The looks of texels.
inline void choose_near_looks(const pyramid& p, const aim& a, int steps, bool holes, looks& out) {
    const double nearest = p.ground_rows / std::abs(a.head.step.y);
    const double inside = p.narrow ? 1.0 / 3.0 : 0.25;  // part of it where more than rows is looked at
    choose_looks(a.along, p.texels, p.edge, a.range.to[0], nearest * inside, 0.5 * nearest * inside, holes,
                 most_looks(steps) - 2, out);
}

// So that no row is left out that a texel takes for the one above or below it.
inline constexpr double row_rounding = 1e-9;

// The cells of each level that texels need: those around the ones of the level below.
//   tangent: columns a row of the base grid
[[nodiscard]] inline std::array<lattice, most_levels> place_lattices(const pyramid& p, rectangle texels, int top,
                                                                     double tangent) {
    std::array<lattice, most_levels> at{};
    glm::dvec2 first = (glm::dvec2(texels.origin) + 0.5) * p.base - 0.5;
    glm::dvec2 last = (glm::dvec2(texels.origin + texels.extent) - 0.5) * p.base - 0.5;
    const double lean = (std::max)(std::abs(2.0 * tangent), 1.0);
    for (int i = 1; i <= top; ++i) {
        const int width = i == 1 ? p.levels[1].width : 2, height = i == 1 ? 2 * width : 2;
        first = {pyramid::in_cells(first.x, width) - 1.0 - lean,
                 std::floor(pyramid::in_cells(first.y, height) - row_rounding)};
        last = {pyramid::in_cells(last.x, width) + 2.0 + lean,
                std::floor(pyramid::in_cells(last.y, height) + row_rounding) + 1.0};
        at[std::size_t(i)] = {2.0 * tangent,
                              p.middle(2 * p.levels[std::size_t(i)].width),
                              first.x,
                              last.x - first.x,
                              int(first.y),
                              int(last.y - first.y) + 1,
                              lanes_for(last.x - first.x)};
    }
    return at;
}

// Bakes some texels in one direction.
template <bool Holes>
void bake_texels(const job& j, int bearing, glm::dvec2 direction, rectangle texels, slot& s) {
    const aim a = take_aim(j, direction);
    const heading& h = a.head;
    const ray& r = a.along;
    const reach& range = a.range;
    const pyramid& p = j.both[h.transposed ? 1 : 0];
    if (h.transposed) texels = {swapped(texels.origin), swapped(texels.extent)};

    const double tangent = r.tangent() * p.base.x / p.base.y;
    const std::array<lattice, most_levels> at = place_lattices(p, texels, range.top, tangent);
    // All of the levels above 1 first; then level 1 and the texels in step, so that what both look at is still cached.
    const auto pass = [&](int i, const pairs* parent) {
        pairs found{.at = at[std::size_t(i)]};
        found.a = s.pair_values[std::size_t(i & 1)] + chunk;
        found.b = found.a + size_far(p, i).pair_floats();
        return std::pair(found, cells_pass<Holes>(p, i, r, range.to[std::size_t(i) - 1], range.to[std::size_t(i)],
                                                  parent, found, s));
    };
    pairs parent;
    for (int i = range.top; i > 1; --i) {
        auto [found, cells] = pass(i, i == range.top ? nullptr : &parent);
        cells.advance((std::numeric_limits<std::int64_t>::max)());
        parent = found;
    }
    choose_near_looks(p, a, j.options.steps, Holes, s.around);
    const float floor = a.never_negative ? 0.0f : hole;
    writer to(j, bearing, h.transposed, s.block);
    const auto look = [&](rectangle band, const pairs* above) {
        if (j.options.distances.values.empty())
            look_from_texels<Holes, false>(p, r, band, floor, above, tangent, s, to);
        else
            look_from_texels<Holes, true>(p, r, band, floor, above, tangent, s, to);
    };
    if (range.top == 0) {
        look(texels, nullptr);
    } else {
        auto [found, cells] = pass(1, range.top == 1 ? nullptr : &parent);
        // Not where rows are columns of the output, which is better written strip by strip.
        const int band_rows = h.transposed ? texels.extent.y : block_rows;
        for (int y = 0; y < texels.extent.y; y += band_rows) {
            const rectangle band{{texels.origin.x, texels.origin.y + y},
                                 {texels.extent.x, (std::min)(band_rows, texels.extent.y - y)}};
            const double last_row = (band.origin.y + band.extent.y - 0.5) * p.base.y - 0.5;
            cells.advance(std::int64_t(std::floor(pyramid::in_cells(last_row, 2 * p.levels[1].width) + row_rounding)) +
                          2);
            look(band, &found);
        }
    }
    simd::stream_end();
}

}  // namespace bumpshadow::cascade_detail
