#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade_far.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/cascade_near.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/status.hpp>

// The fast method: horizons of unlimited range at a constant cost a sample.
//
// Near occluders are looked at texel by texel. Farther ones are found for cells of 2, 4, 8 ... texels, each level
// reaching several times as far as the one before and looking at heights averaged over half its own cell. What a cell
// passes down is not a slope but its occluder, as the pair a = H / t, b = 1 / t of the occluder's height H and distance
// t: the slope that it makes for a height h is a - b h, so that pairs may be interpolated between cells and still give
// the right slope for each texel's own height.

namespace bumpshadow {

namespace cascade_detail {

inline constexpr int strip =
    (std::max)(256, chunk);            // columns done together, so that the rows they look at stay cached
inline constexpr int block_rows = 64;  // texels of several levels, and the output, are done together

// The map, or its transpose, with its levels.
struct frame {
    pyramid levels;
    bool transposed = false;
};

// What all items of a bake share.
struct job {
    std::array<frame, 2> frames;
    height_range range;
    const bake_options& options;
    const horizon_map& out;
    rectangle region;
};

[[nodiscard]] constexpr glm::ivec2 swapped(glm::ivec2 v) { return {v.y, v.x}; }
[[nodiscard]] constexpr glm::dvec2 swapped(glm::dvec2 v) { return {v.y, v.x}; }

// How far the levels look. Distances count from the texel, in units of length.
struct reach {
    std::array<double, most_levels> to{};
    int top = 0;  // the highest level that is needed
};

[[nodiscard]] inline double level_row_step(const pyramid& p, const ray& r, int level) {
    return std::abs(r.step.y) * p.base.y / double(1 << (level - 1));  // rows of its occluders a unit of length
}

[[nodiscard]] inline reach plan_reach(const pyramid& p, const ray& r, int steps) {
    reach s;
    for (int j = 0; j < p.count; ++j) {
        const double from = j > 0 ? s.to[std::size_t(j) - 1] : 0.0;
        const double wanted = j == p.count - 1 ? r.farthest : j == 0 ? steps / std::abs(r.step.y) : growth(j) * from;
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
    double farthest = j.options.radius / p.unit;
    const glm::dvec2 extent(p.texels.texels);
    if (p.edge == edge_mode::clamp || p.edge == edge_mode::open) {
        const double x = (extent.x + 1.0) / std::abs(step.x), y = (extent.y + 1.0) / std::abs(step.y);
        if (p.edge == edge_mode::open)
            farthest = (std::min)({farthest, x, y});
        else
            farthest = (std::min)(farthest, step.x == 0.0 ? y : (std::max)(x, y));
    } else if (never_negative || std::isinf(farthest)) {
        const double low = 1024.0 * (double(j.range.highest) - double(j.range.lowest)) + 1.0;
        farthest =
            (std::min)({farthest, low, (std::max)(4096.0, 4.0 * (std::max)(extent.x, extent.y)) / std::abs(step.y)});
    }
    return farthest;
}

// Where the work of an item lies; one for each item that runs at a time.
struct slot {
    looks near;
    far_row* far = nullptr;
    const float** rows = nullptr;
    std::ptrdiff_t* lane_zero = nullptr;
    float* ring = nullptr;
    std::array<float*, 2> pair_values{};                               // of odd and of even levels
    float *heights = nullptr, *slopes = nullptr, *inverses = nullptr;  // of a row of cells
    float* parent_line = nullptr;
    std::size_t line_floats = 0;
    float* block = nullptr;  // rows of the transposed map, slopes and then distances
};

// The most that any direction needs at level j of whole maps.
struct far_size {
    int lanes = 0, rows = 0, window = 0;

    [[nodiscard]] std::size_t pair_floats() const {
        return std::size_t(lanes) * std::size_t(rows) + 4 * std::size_t(chunk);
    }
    [[nodiscard]] std::size_t ring_floats() const {
        return std::size_t(ring_lanes()) * std::size_t(window) + std::size_t(chunk);
    }
    // The rows of cells that look at a row are as many lanes apart as rows, at the most.
    [[nodiscard]] int ring_lanes() const { return lanes + (std::min)(window / 2 + 1, rows) + 3 * simd::width; }
};
[[nodiscard]] inline far_size size_far(const pyramid& p, int level, int steps) {
    const plane& cells = p.levels[std::size_t(level)].origins;
    far_size s;
    s.lanes = lanes_for(cells.cells.x + 16.0) + lanes_for(0.0);
    s.rows = cells.cells.y + 10;
    double rows = 2.0 * steps;
    for (int j = 1; j <= level; ++j) rows *= 0.5 * growth(j);
    rows += 4.0;
    s.window = level == p.count - 1 ? most_rows : int((std::min)(rows, double(most_rows)));
    return s;
}

// Calls carve(float count, ...) style: `array(pointer, count)` for each array of a slot.
template <class Array>
void for_arrays(const job& j, slot& s, int steps, Array&& array) {
    const auto most = std::size_t(most_looks(steps));
    array(s.near.corners, most);
    array(s.near.crossings, most);
    array(s.near.columns, most);
    array(s.near.insides, most);
    array(s.far, std::size_t(most_rows));
    array(s.rows, std::size_t(most_rows));
    array(s.lane_zero, std::size_t(most_rows));
    std::size_t ring = 0, line = 2 * strip, pair_values[2] = {};
    for (const frame& f : j.frames)
        for (int level = 1; level < f.levels.count; ++level) {
            const far_size size = size_far(f.levels, level, steps);
            ring = (std::max)(ring, size.ring_floats());
            line = (std::max)(line, std::size_t(size.ring_lanes()));
            std::size_t& values = pair_values[level & 1];
            values = (std::max)(values, 2 * size.pair_floats());
        }
    array(s.ring, ring);
    array(s.pair_values[0], pair_values[0]);
    array(s.pair_values[1], pair_values[1]);
    s.line_floats = line + 4 * std::size_t(chunk);
    for (float** l : {&s.heights, &s.slopes, &s.inverses}) array(*l, s.line_floats);
    array(s.parent_line, 2 * s.line_floats);
    array(s.block, 2 * std::size_t(block_rows) * std::size_t(strip + chunk));
}

// Finds what the cells of a level see at distances in (from, to], from row to row.
template <bool Holes>
class cells_pass {
public:
    cells_pass(const pyramid& p, int j, const ray& r, double from, double to, const pairs* parent, const pairs& found,
               slot& s)
        : l_(p.levels[std::size_t(j)]),
          edge_(p.edge),
          down_(r.step.y > 0.0),
          found_(found),
          s_(s),
          bring_{parent, {0.5, -0.25, 0.0}, 0.5, 0.5, s.parent_line, s.line_floats},
          row_(found.at.first_row) {
        // The n-th row on is n - 1/2 rows away, since a cell's center lies between two rows.
        const double row_step = level_row_step(p, r, j);
        first_ = std::int64_t(std::floor(from * row_step + 0.5 + 1e-9)) + 1;
        // The last one is the row nearest to where looking ends, and counts as being there.
        const bool ends = to >= r.farthest;
        const double last_row = std::floor(to * row_step + (ends ? 1.0 : 0.5) + 1e-9);
        const auto last = std::int64_t((std::min)(last_row, double(first_ + most_rows - 3)));
        count_ = int((std::max)(last - first_ + 1, std::int64_t(0)));
        for (int n = 0; n < count_; ++n) {
            const double t = ends && first_ + n == last ? to : (double(first_ + n) - 0.5) / row_step;
            s_.far[n] = {float(1.0 / t), float(-r.bend * t)};
        }
        window_ = count_ + 2;
        const int rows_together = (std::min)(window_ / 2 + 1, found.at.rows);
        const int drift = int(std::ceil(std::abs(found.at.tangent) * rows_together));
        stride_ = found.at.count + (drift + 2 * simd::width) / simd::width * simd::width;
        made_ = (std::min)(row_on(row_, 0), row_on(row_, count_ - 1));
    }

    // Goes on up to row `end`, or to the last.
    void advance(std::int64_t end) {
        const lattice& at = found_.at;
        for (end = (std::min)(end, std::int64_t(at.first_row) + at.rows); row_ < end; ++row_) {
            const std::int64_t lane = at.first_lane(row_);
            if (count_ > 0) find_rows(lane);
            sample_row<1>(l_.origins, edge_, row_, double(lane) + at.tangent * (double(row_) - at.middle), at.count,
                          s_.heights);
            look_far(s_.rows, s_.far, first_, count_, at.count, s_.heights, s_.slopes, s_.inverses);
            keep(lane);
        }
    }

private:
    // Row that the cells of a row see as their n-th.
    [[nodiscard]] std::int64_t row_on(std::int64_t row, std::int64_t n) const {
        return down_ ? 2 * row + first_ + n : 2 * row + 1 - first_ - n;
    }
    // First lane of row m that any cells look at.
    [[nodiscard]] std::int64_t first_lane_of(std::int64_t m) const {
        const lattice& at = found_.at;
        const std::int64_t last_row = at.first_row + at.rows - 1, last = first_ + count_ - 1;
        const std::int64_t a = down_ ? m - last : m - 1 + first_, b = down_ ? m - first_ : m - 1 + last;
        return (std::min)(at.first_lane(std::clamp(a >> 1, std::int64_t(at.first_row), last_row)),
                          at.first_lane(std::clamp((b + 1) >> 1, std::int64_t(at.first_row), last_row)));
    }

    // Rows of heights on lanes are kept, in a ring, as long as a row of cells looks at them: rows made_ - window_ and
    // on.
    void find_rows(std::int64_t lane) {
        const double tangent = found_.at.tangent, middle = 2.0 * found_.at.middle + 0.5;
        const std::int64_t near = row_on(row_, 0), end = (std::max)(near, row_on(row_, count_ - 1)) + 1;
        for (; made_ < end; ++made_) {
            const std::int64_t first = first_lane_of(made_);
            sample_row<2>(l_.occluders, edge_, made_, 2.0 * double(first) + 0.5 + tangent * (double(made_) - middle),
                          stride_, s_.ring + std::ptrdiff_t(next_slot_) * stride_);
            s_.lane_zero[next_slot_] = std::ptrdiff_t(next_slot_) * stride_ - first;
            if (++next_slot_ == window_) next_slot_ = 0;
        }
        int slot_of_row = next_slot_ - int(made_ - near);
        for (int n = 0; n < count_; ++n) {
            if (slot_of_row < 0) slot_of_row += window_;
            if (slot_of_row >= window_) slot_of_row -= window_;
            s_.rows[n] = s_.ring + (s_.lane_zero[slot_of_row] + lane);
            slot_of_row += down_ ? 1 : -1;
        }
    }

    // What the cells have seen, or their parents where that is higher, as pairs.
    void keep(std::int64_t lane) {
        float* const a = found_.a + found_.offset(lane, row_);
        float* const b = found_.b + found_.offset(lane, row_);
        const int count = found_.at.count;
        const auto keep_pack = [&](int i, bool have_parent, simd::pack parent_a, simd::pack parent_b) {
            const simd::pack height = simd::load(s_.heights + i), slope = simd::load(s_.slopes + i);
            simd::pack own_b = simd::load(s_.inverses + i);
            simd::pack own_a = simd::multiply_add(own_b, height, slope);
            if (have_parent) {
                const simd::pack theirs = slope_of(parent_a, parent_b, height);
                own_a = simd::select_greater(theirs, slope, parent_a, own_a);
                own_b = simd::select_greater(theirs, slope, parent_b, own_b);
            }
            simd::store(a + i, own_a);
            simd::store(b + i, own_b);
        };
        if (bring_.parent != nullptr)
            bring_.template operator()<Holes>(lane, row_, count,
                                              [&](int i, simd::pack pa, simd::pack pb) { keep_pack(i, true, pa, pb); });
        else
            for (int i = 0; i < count; i += simd::width) keep_pack(i, false, simd::splat(0.0f), simd::splat(0.0f));
        if constexpr (Holes)
            for (int i = 0; i < count; ++i)
                if (s_.heights[i] < hole_limit || a[i] < hole_limit) a[i] = hole, b[i] = 0.0f;
    }

    const level& l_;
    edge_mode edge_;
    bool down_;
    pairs found_;
    slot& s_;
    interpolation bring_;
    std::int64_t row_;
    std::int64_t first_ = 0;  // which row of heights is the first that is looked at
    int count_ = 0;
    int window_ = 0, stride_ = 0;
    std::int64_t made_ = 0;
    int next_slot_ = 0;
};

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
        if (rows == block_rows)
            for (; i + simd::width <= count_; i += simd::width)
                for (int k = 0; k < block_rows; k += simd::width) {
                    simd::pack square[simd::width];
                    for (int n = 0; n < simd::width; ++n) square[n] = simd::load(from + (k + n) * pitch + i);
                    simd::transpose(square);
                    for (int n = 0; n < simd::width; ++n) simd::stream(at(i + n) + k, square[n]);
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

// Bakes a rectangle of texels, in the coordinates of its frame, from what their parents see.
template <bool Holes, bool Track>
void look_from_texels(const pyramid& p, const ray& r, rectangle texels, float floor, const pairs* parent,
                      double tangent, slot& s, writer& to) {
    const glm::dvec2 base = p.base;
    const interpolation bring{parent,
                              {0.5 * base.x, 0.25 * base.x - 0.5 - 0.5 * tangent * (0.5 * base.y - 0.5 - p.middle(0)),
                               -0.5 * tangent * base.y},
                              0.5 * base.y,
                              1.0 / base.y - 0.5,
                              s.parent_line,
                              s.line_floats};
    const glm::ivec2 end = texels.origin + texels.extent;
    const bool open = Holes && p.edge == edge_mode::open;
    // Inverse of the distance at which a ray leaves an open map, on the side that it goes to; a quarter of it is added,
    // since what a cell sees on the border may be as much farther away for it than for its texels.
    const auto inverse_of_end = [](double step, int at, int texels_of_axis) {
        const double way = step > 0.0 ? texels_of_axis - 1 - at : at;
        return step == 0.0 ? 0.0f : way > 0.0 ? float(0.8 * std::abs(step) / way) : inverse_of_zero;
    };
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
                look_around<packs, Track>(s.near, heights + i, floor, slopes + i, inverses + i);
            for (; i < lanes; i += simd::width)
                look_around<1, Track>(s.near, heights + i, floor, slopes + i, inverses + i);
            if (parent != nullptr) {
                bring.template operator()<Holes>(x, y, lanes, [&](int k, simd::pack a, simd::pack b) {
                    const simd::pack own = simd::load(slopes + k);
                    simd::pack theirs = slope_of(a, b, simd::load(heights + k));
                    if (open) {
                        const simd::pack end_of_row = simd::splat(inverse_of_end(r.step.y, y, p.texels.texels.y));
                        const simd::pack end_of_ray = simd::max(simd::load(end_of_columns + k), end_of_row);
                        theirs = simd::select_greater(end_of_ray, b, simd::splat(hole), theirs);
                    }
                    if constexpr (Track)
                        simd::store(inverses + k, simd::select_greater(theirs, own, b, simd::load(inverses + k)));
                    simd::store(slopes + k, simd::max(theirs, own));
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

// Bakes some texels in one direction.
template <bool Holes>
void bake_texels(const job& j, int bearing, glm::dvec2 direction, rectangle texels, slot& s) {
    const heading h = head(direction, j.frames[0].levels.spacing);
    const frame& f = j.frames[h.transposed ? 1 : 0];
    const pyramid& p = f.levels;
    const double curvature = curvature_along(j.options.curvature, h.unit_direction) * p.unit;
    const bool never_negative = horizon_is_never_negative(p.edge, j.options.radius, curvature);
    ray r{.step = h.step, .bend = 0.5 * curvature};
    r.farthest = farthest_distance(j, p, h.step, never_negative);
    const reach range = plan_reach(p, r, j.options.steps);
    if (h.transposed) texels = {swapped(texels.origin), swapped(texels.extent)};

    // Each level needs the cells around those of the level below.
    std::array<lattice, most_levels> at{};
    const double tangent = r.tangent() * p.base.x / p.base.y;
    glm::dvec2 first = (glm::dvec2(texels.origin) + 0.5) * p.base - 0.5;
    glm::dvec2 last = (glm::dvec2(texels.origin + texels.extent) - 0.5) * p.base - 0.5;
    for (int i = 1; i <= range.top; ++i) {
        first = {0.5 * first.x - 2.25, std::floor(0.5 * first.y - 0.25)};
        last = {0.5 * last.x + 2.75, std::floor(0.5 * last.y - 0.25) + 1.0};
        at[std::size_t(i)] = {
            tangent, p.middle(i), first.x, int(first.y), int(last.y - first.y) + 1, lanes_for(last.x - first.x)};
    }
    // All of the levels above 1 first; then level 1 and the texels in step, so that what both look at is still cached.
    const auto pass = [&](int i, const pairs* parent) {
        pairs found{.at = at[std::size_t(i)]};
        found.a = s.pair_values[std::size_t(i & 1)] + chunk;
        found.b = found.a + size_far(p, i, j.options.steps).pair_floats();
        return std::pair(found, cells_pass<Holes>(p, i, r, range.to[std::size_t(i) - 1], range.to[std::size_t(i)],
                                                  parent, found, s));
    };
    pairs parent;
    for (int i = range.top; i > 1; --i) {
        auto [found, cells] = pass(i, i == range.top ? nullptr : &parent);
        cells.advance(std::numeric_limits<std::int64_t>::max());
        parent = found;
    }
    const double near = j.options.steps / std::abs(h.step.y);
    choose_looks(r, p.texels, p.edge, range.to[0], near / 4.0, near / 8.0, Holes, most_looks(j.options.steps) - 2,
                 s.near);
    const float floor = never_negative ? 0.0f : hole;
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
            cells.advance(std::int64_t(std::floor(0.5 * last_row - 0.25)) + 2);
            look(band, &found);
        }
    }
    simd::stream_end();
}

// Bands of rows are made only where there are too few directions to keep the executor busy.
[[nodiscard]] inline int band_count(std::size_t directions, int rows, int concurrency) {
    if (concurrency <= 1) return 1;
    const std::size_t wanted = (4 * std::size_t(concurrency) + directions - 1) / directions;
    return int((std::min)(wanted, std::size_t((std::max)(rows / 64, 1))));
}

template <height_sample Sample>
[[nodiscard]] job make_job(const height_map<Sample>& heights, const horizon_map& out, const bake_options& options) {
    job j{.frames = {},
          .range = {},
          .options = options,
          .out = out,
          .region = region_or_all(options.region, heights.extent)};
    j.frames[0].levels = shape_pyramid(heights.extent, heights.texel_size, heights.edge, options.steps);
    j.frames[1].levels =
        shape_pyramid(swapped(heights.extent), swapped(heights.texel_size), heights.edge, options.steps);
    j.frames[1].transposed = true;
    return j;
}

[[nodiscard]] inline std::size_t scratch_bytes(const job& j, int steps, int slots) {
    scratch_layout layout;
    for (const frame& f : j.frames) add_pyramid(f.levels, layout);
    slot s;
    for (int i = 0; i < slots; ++i)
        for_arrays(j, s, steps, [&]<class T>(T*&, std::size_t count) { layout.add<T>(count); });
    layout.add<slot>(std::size_t(slots));
    return layout.bytes();
}

}  // namespace cascade_detail

// Bytes of scratch that bake_cascade takes for these heights on an executor of that concurrency, at the most; no more
// for more directions.
template <height_sample Sample>
[[nodiscard]] std::size_t cascade_scratch_size(const height_map<Sample>& heights, const bake_options& options = {},
                                               int concurrency = 1) {
    const cascade_detail::job j = cascade_detail::make_job(heights, {}, options);
    return cascade_detail::scratch_bytes(j, options.steps, slot_pool::slots(concurrency, slot_pool::max_slots));
}

// Bakes horizons of a height map in any list of directions.
//   out: slopes [direction][y][x] of the region; distances of the occluders on request (options)
//   options.steps: how many texels are looked at one by one, the knob of error against run time; README has a table
// Any extent, edge mode, texel size, radius, curvature. The result is the same for any executor, for any region that a
// texel is baked in and for any set of directions baked together, bit for bit.
// Errors: those of check_bake; not_finite with the place of the first such height; scratch too small or out of memory.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status bake_cascade(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                  const horizon_map& out, const bake_options& options = {}, Executor&& execute = {}) {
    using namespace cascade_detail;
    if (status s = check_bake(heights, directions, out, options); !s) return s;
    if (status s = check_samples(heights); !s) return s;

    job j = make_job(heights, out, options);
    const int bands = band_count(directions.size(), j.region.extent.y, execute.concurrency());
    const std::size_t items = directions.size() * std::size_t(bands);
    const int slots = slot_pool::slots(execute.concurrency(), items);
    scratch_block block;
    if (status s = block.allocate(options, scratch_bytes(j, options.steps, slots), "the cascade's scratch"); !s)
        return s;

    const bool holes = heights.no_data.has_value() || heights.edge == edge_mode::open;
    bool wanted[2] = {};
    for (const glm::dvec2 d : directions) wanted[head(d, j.frames[0].levels.spacing).transposed ? 1 : 0] = true;
    std::array<pyramid_scratch, 2> building;
    for (std::size_t i = 0; i < 2; ++i) building[i] = carve_pyramid(j.frames[i].levels, block);
    j.range = fill_ground(heights, j.frames[0].levels);
    execute(2, [&](std::size_t i) {
        if (!wanted[i]) return;
        if (i == 1) transpose_ground(j.frames[0].levels, j.frames[1].levels);
        build_pyramid(j.frames[i].levels, holes, building[i]);
    });
    slot* const slot_list = block.carve<slot>(std::size_t(slots));
    for (int i = 0; i < slots; ++i)
        for_arrays(j, slot_list[i], options.steps,
                   [&]<class T>(T*& array, std::size_t count) { array = block.carve<T>(count); });

    slot_pool pool(slots);
    execute(items, [&](std::size_t item) {
        const int bearing = int(item / std::size_t(bands)), band = int(item % std::size_t(bands));
        const int from = int(std::int64_t(j.region.extent.y) * band / bands);
        const int to = int(std::int64_t(j.region.extent.y) * (band + 1) / bands);
        const rectangle rows{{j.region.origin.x, j.region.origin.y + from}, {j.region.extent.x, to - from}};
        const auto lease = pool.acquire();
        (holes ? bake_texels<true> : bake_texels<false>)(j, bearing, directions[std::size_t(bearing)], rows,
                                                         slot_list[lease.index()]);
    });
    return {};
}

// Texels whose horizons may be others when heights in a rectangle of the map change: what to bake again, bit for bit
// the same as baking everything. All of the map unless the radius is finite; on a map that tiles, all of an axis where
// the rectangle would cross a border.
template <height_sample Sample>
[[nodiscard]] rectangle influence(const height_map<Sample>& heights, rectangle changed, const bake_options& options) {
    const rectangle all{glm::ivec2(0), heights.extent};
    if (std::isinf(options.radius)) return all;
    // Cells of the highest level that looks within the radius, which take part in those next to them.
    const glm::dvec2 radius = options.radius / heights.texel_size;
    double reach = options.steps, cell = 1.0;
    for (int level = 1; reach < (std::max)(radius.x, radius.y); ++level) {
        reach *= cascade_detail::growth(level);
        cell *= 2.0;
    }
    const bool tiles = heights.edge == edge_mode::repeat || heights.edge == edge_mode::mirror;
    const auto along = [&](int from, int count, double reach_of_axis, int texels) {
        const double margin = reach_of_axis + 6.0 * cell + 2.0;
        const double first = from - margin, last = double(from) + count + margin;
        if (tiles && (first < 0.0 || last > texels)) return glm::ivec2(0, texels);
        const int begin = int((std::max)(first, 0.0)), end = int((std::min)(last, double(texels)));
        return glm::ivec2(begin, end - begin);
    };
    const glm::ivec2 x = along(changed.origin.x, changed.extent.x, radius.x, heights.extent.x);
    const glm::ivec2 y = along(changed.origin.y, changed.extent.y, radius.y, heights.extent.y);
    return {{x.x, y.x}, {x.y, y.y}};
}

}  // namespace bumpshadow
