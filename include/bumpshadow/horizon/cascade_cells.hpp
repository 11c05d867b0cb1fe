#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon/cascade_far.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/cascade_near.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>

// One level above 0 of the cascade, from row to row. Part of horizon/cascade.hpp.
namespace bumpshadow::cascade_detail {

inline constexpr int strip =
    (std::max)(256, chunk);            // columns done together, so that the rows they look at stay cached
inline constexpr int block_rows = 64;  // texels of several levels, and the output, are done together
inline constexpr int batch = 8;        // rows of cells, which look at much the same rows of heights

// Where the work of an item lies; one for each item that runs at a time.
struct slot {
    looks around;
    far_row* beyond = nullptr;
    std::ptrdiff_t* lane_zero = nullptr;
    float* ring = nullptr;
    std::array<float*, 2> pair_values{};                               // of odd and of even levels
    float *heights = nullptr, *slopes = nullptr, *inverses = nullptr;  // of a batch of rows of cells
    float* parent_line = nullptr;
    std::size_t line_floats = 0;
    float* block = nullptr;  // rows of the transposed map, slopes and then distances
};

// The most that any direction needs at level j of whole maps.
struct far_size {
    int lanes = 0, rows = 0, window = 0;
    int rows_a_cell = 2;
    int lean = 2;  // lanes a row, rounded up: twice as many where a map that tiles is resampled more along rows

    [[nodiscard]] std::size_t pair_floats() const {
        return std::size_t(lanes) * std::size_t(rows) + 4 * std::size_t(chunk);
    }
    [[nodiscard]] std::size_t ring_floats() const {
        return std::size_t(ring_lanes()) * std::size_t(window) + std::size_t(chunk);
    }
    // The rows of cells that look at a row are `lean` times as many lanes apart as rows, at the most.
    [[nodiscard]] int ring_lanes() const {
        return lanes + lean * (std::min)(window / rows_a_cell + 1, rows) + 3 * simd::width;
    }
};

[[nodiscard]] inline far_size size_far(const pyramid& p, int level) {
    const plane& cells = p.levels[std::size_t(level)].origins;
    far_size s;
    s.lanes = lanes_for(cells.cells.x + 32.0) + lanes_for(0.0);
    s.rows = cells.cells.y + 10;
    s.rows_a_cell = p.levels[std::size_t(level)].rows_a_cell();
    s.lean = p.base.x > p.base.y ? 4 : 2;
    double rows = p.ground_rows * p.base.y / p.levels[std::size_t(level)].occluder_size();
    for (int j = 1; j <= level; ++j) rows *= growth(j, p.ground_rows, p.narrow);
    rows += 4.0;
    s.window = (level == p.count - 1 ? most_rows : int((std::min)(rows, double(most_rows)))) + batch * s.rows_a_cell;
    return s;
}

// The map and its transpose, with their levels: a ray needs the one in which it crosses more rows than columns.
using frames = std::array<pyramid, 2>;

// Calls array(pointer, count) for each array of a slot.
template <class Array>
void for_arrays(const frames& both, slot& s, int steps, Array&& array) {
    const auto most = std::size_t(most_looks(steps));
    array(s.around.corners, most);
    array(s.around.crossings, most);
    array(s.around.columns, most);
    array(s.around.insides, most);
    array(s.beyond, std::size_t(most_rows));
    array(s.lane_zero, 2 * std::size_t(most_rows + 4 * batch));
    std::size_t ring = 0, line = 2 * strip, pair_values[2] = {};
    for (const pyramid& p : both)
        for (int level = 1; level < p.count; ++level) {
            const far_size size = size_far(p, level);
            ring = (std::max)(ring, size.ring_floats());
            line = (std::max)(line, std::size_t(size.ring_lanes()));
            std::size_t& values = pair_values[level & 1];
            values = (std::max)(values, 2 * size.pair_floats());
        }
    array(s.ring, ring);
    array(s.pair_values[0], pair_values[0]);
    array(s.pair_values[1], pair_values[1]);
    s.line_floats = line + 4 * std::size_t(chunk);
    for (float** l : {&s.heights, &s.slopes, &s.inverses}) array(*l, batch * s.line_floats);
    array(s.parent_line, 2 * s.line_floats);
    array(s.block, 2 * std::size_t(block_rows) * std::size_t(strip + chunk));
}

[[nodiscard]] inline double level_row_step(const pyramid& p, const ray& r, int level) {
    return std::abs(r.step.y) * p.base.y /
           p.levels[std::size_t(level)].occluder_size();  // rows of its occluders a unit of length
}

// Which rows of its occluders a level looks at: from a cell, the n-th row on is n - 1/2 rows away, since a cell's
// center lies between two rows.
struct far_rows {
    std::int64_t first = 0;
    int count = 0;

    // Row that the cells of a row see as their n-th of these.
    [[nodiscard]] std::int64_t seen_from(const level& l, bool down, std::int64_t row, std::int64_t n) const {
        const std::int64_t ratio = l.rows_a_cell(), half = ratio / 2;
        return down ? ratio * row + half - 1 + first + n : ratio * row + half - first - n;
    }
};

// Those at distances in (from, to].
[[nodiscard]] inline far_rows choose_far_rows(const pyramid& p, int level, const ray& r, double from, double to,
                                              far_row* out) {
    const double row_step = level_row_step(p, r, level);
    far_rows rows;
    rows.first = std::int64_t(std::floor(from * row_step + 0.5 + 1e-9)) + 1;
    // The last one is the row nearest to where looking ends, and counts as being there.
    const bool ends = to >= r.farthest;
    const double last_row = std::floor(to * row_step + (ends ? 1.0 : 0.5) + 1e-9);
    const auto last = std::int64_t((std::min)(last_row, double(rows.first + most_rows - 3)));
    rows.count = int((std::max)(last - rows.first + 1, std::int64_t(0)));
    for (int n = 0; n < rows.count; ++n) {
        const double t = ends && rows.first + n == last ? to : (double(rows.first + n) - 0.5) / row_step;
        out[n] = {float(1.0 / t), float(-r.bend * t)};
    }
    return rows;
}

// Columns of a level's occluders that the lanes of their row stand beside those that cells of the same lanes have,
// which are `stride` apart. cells: the lattice of the cells
[[nodiscard]] inline double shift_of_occluders(const level& l, const lattice& cells, std::int64_t row) {
    const double tangent = 0.5 * cells.tangent, middle = 2.0 * l.stride * cells.middle + 0.5 * (2.0 * l.stride - 1.0);
    return 0.5 * (l.stride - 1) + tangent * (double(row) - middle);
}

// From a level above 1 to cells so many columns of the base grid wide, whose parents looked from the distance `to` on.
[[nodiscard]] inline interpolation parents_of_cells(const pyramid& p, const ray& r, int width, double to) {
    return {.lanes = {0.5, -0.25, 0.0}, .spacing = 4.0 * width / (r.step.y * p.base.y), .nearest = to, .bend = r.bend};
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
          bring_(parents_of_cells(p, r, l_.width, to)),
          row_(found.at.first_row),
          far_(choose_far_rows(p, j, r, from, to, s.beyond)),
          count_(far_.count) {
        bring_.parent = parent;
        bring_.line = s.parent_line;
        bring_.line_floats = s.line_floats;
        const int ratio = l_.rows_a_cell();
        window_ = count_ + 2 + ratio * (batch - 1);
        const int rows_together = (std::min)((count_ + 2) / ratio + 1, found.at.rows);
        const int drift = int(std::ceil(std::abs(found.at.tangent) * rows_together));
        stride_ = found.at.count + (drift + 2 * simd::width) / simd::width * simd::width;
        made_ = (std::min)(row_on(row_, 0), row_on(row_, count_ - 1));
        // Lanes of the level below that only fill a pack may have their parents before the first and after the last.
        if constexpr (Holes) {
            std::fill_n(found.a - simd::width, simd::width, hole);
            std::fill_n(found.a + std::ptrdiff_t(found.at.rows) * found.at.count, simd::width, hole);
        }
    }

    // Goes on up to row `end`, or to the last.
    void advance(std::int64_t end) {
        const lattice& at = found_.at;
        end = (std::min)(end, std::int64_t(at.first_row) + at.rows);
        while (row_ < end) {
            const int rows = int((std::min)(end - row_, std::int64_t(batch)));
            look(rows);
            for (int r = 0; r < rows; ++r, ++row_) keep(at.first_lane(row_), std::size_t(r) * s_.line_floats);
        }
    }

private:
    // Row that the cells of a row see as their n-th.
    [[nodiscard]] std::int64_t row_on(std::int64_t row, std::int64_t n) const {
        return far_.seen_from(l_, down_, row, n);
    }
    // First lane of row m that any cells look at.
    [[nodiscard]] std::int64_t first_lane_of(std::int64_t m) const {
        const lattice& at = found_.at;
        const std::int64_t last_row = at.first_row + at.rows - 1, first = far_.first, last = first + count_ - 1;
        const int ratio = l_.rows_a_cell(), shift = l_.stride;  // ratio is 1 << shift
        const std::int64_t a = down_ ? m - ratio / 2 + 1 - last : m - ratio / 2 + first,
                           b = down_ ? m - ratio / 2 + 1 - first : m - ratio / 2 + last;
        return (std::min)(at.first_lane(std::clamp(a >> shift, std::int64_t(at.first_row), last_row)),
                          at.first_lane(std::clamp((b + ratio - 1) >> shift, std::int64_t(at.first_row), last_row)));
    }

    // Looks from a batch of rows, from some lanes of all of them at a time, so that the heights there stay cached.
    void look(int rows) {
        const lattice& at = found_.at;
        std::int64_t lanes[batch], begin = (std::numeric_limits<std::int64_t>::max)(), end = -begin;
        std::ptrdiff_t const* seen[batch] = {};
        if (count_ > 0) make_rows(row_ + rows - 1);
        for (int r = 0; r < rows; ++r) {
            const std::int64_t row = row_ + r;
            lanes[r] = at.first_lane(row);
            begin = (std::min)(begin, lanes[r]);
            end = (std::max)(end, lanes[r] + at.count);
            if (count_ > 0) {
                int slot = next_slot_ - int(made_ - row_on(row, 0));
                if (slot < 0) slot += window_;
                seen[r] = s_.lane_zero + (down_ ? slot : slot + window_);
            }
            sample_row<1>(l_.origins, edge_, row, lanes[r], at.shift(row), at.count,
                          s_.heights + std::size_t(r) * s_.line_floats);
        }
        for (std::int64_t lane = begin; lane < end; lane += chunk)
            for (int r = 0; r < rows; ++r) {
                const std::int64_t from = (std::max)(lane, lanes[r]),
                                   to = (std::min)(lane + chunk, lanes[r] + at.count);
                if (from >= to) continue;
                const std::size_t i = std::size_t(r) * s_.line_floats + std::size_t(from - lanes[r]);
                look_far({s_.ring, seen[r], down_ ? 1 : -1, from}, s_.beyond, far_.first, count_,
                         int(to - from) / simd::width, s_.heights + i, s_.slopes + i, s_.inverses + i);
            }
    }

    // Rows of heights on lanes are kept, in a ring, as long as a batch of rows of cells looks at them: rows made_ -
    // window_ and on. Where their lane 0 lies is noted twice, so that rows that follow each other do so there, too.
    void make_rows(std::int64_t last_row) {
        const int stride = l_.stride;
        const std::int64_t end = (std::max)(row_on(last_row, 0), row_on(last_row, count_ - 1)) + 1;
        for (; made_ < end; ++made_) {
            const std::int64_t first = first_lane_of(made_);
            (stride == 2 ? sample_row<2> : sample_row<1>)(l_.occluders, edge_, made_, stride * first,
                                                          shift_of_occluders(l_, found_.at, made_), stride_,
                                                          s_.ring + std::ptrdiff_t(next_slot_) * stride_);
            s_.lane_zero[next_slot_] = s_.lane_zero[next_slot_ + window_] =
                std::ptrdiff_t(std::int64_t(next_slot_) * stride_ - first);
            if (++next_slot_ == window_) next_slot_ = 0;
        }
    }

    // What the cells have seen, or their parents where that is higher, as pairs.
    //   line: where those of the row begin
    void keep(std::int64_t lane, std::size_t line) {
        float* const a = found_.a + found_.offset(lane, row_);
        float* const b = found_.b + found_.offset(lane, row_);
        const float *const heights = s_.heights + line, *const slopes = s_.slopes + line,
                           *const inverses = s_.inverses + line;
        const int count = found_.at.count;
        const auto keep_pack = [&](int i, bool have_parent, simd::pack parent_a, simd::pack parent_b) {
            const simd::pack height = simd::load(heights + i), slope = simd::load(slopes + i);
            simd::pack own_b = simd::load(inverses + i);
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
                if (heights[i] < hole_limit || a[i] < hole_limit) a[i] = hole, b[i] = 0.0f;
    }

    const level& l_;
    edge_mode edge_;
    bool down_;
    pairs found_;
    slot& s_;
    interpolation bring_;
    std::int64_t row_;
    far_rows far_;
    int count_;
    int window_ = 0, stride_ = 0;
    std::int64_t made_ = 0;
    int next_slot_ = 0;
};

}  // namespace bumpshadow::cascade_detail
