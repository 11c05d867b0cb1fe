#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>

#include <glm/common.hpp>

// Fills the tables that shader/bake.h reads, from what the cascade on the CPU computes with. Part of
// shader/bake_plan.hpp.

namespace bumpshadow {

// One dispatch of the kernel. All that one writes has to be visible to the next: a barrier between them.
struct bake_dispatch {
    std::array<std::int32_t, 4> constants{};  // the kernel's uniform or constant buffer
    glm::ivec3 groups{0};                     // of bake_group threads, along x, y and z
};

// Threads of a group along x and y.
inline GLM_CONSTEXPR const glm::ivec2 bake_group{16, 4};
namespace cascade_detail {

// Fills tables, or counts their entries where there is no room.
struct bake_table {
    std::span<glm::ivec4> entries;
    std::size_t count = 0;

    int add(std::size_t wanted) {
        const auto first = int(count);
        count += wanted;
        return first;
    }
    void set(int at, glm::ivec4 entry) const {
        if (std::size_t(at) < entries.size()) entries[std::size_t(at)] = entry;
    }
    int push(glm::ivec4 entry) {
        const int at = add(1);
        set(at, entry);
        return at;
    }
};

[[nodiscard]] inline int bits_of(float value) { return std::bit_cast<std::int32_t>(value); }
[[nodiscard]] inline int bits_of(double value) { return bits_of(float(value)); }

// Where the planes of a frame begin, in floats of the kernel's scratch. They have no overhang.
struct bake_planes {
    int ground = 0;
    struct level_planes {
        int means = 0, maxima = 0, occluders = 0, occluder_row = 0, cells = 0;
    };
    std::array<level_planes, most_levels> levels{};
};

// Writes the records of one plan; each is `record` entries.
class bake_planner {
public:
    static constexpr int record = 5;

    // Fills the spans as far as they go, and counts on.
    bake_planner(const job& j, std::span<glm::ivec4> tables, std::span<bake_dispatch> dispatches)
        : j_(j), table_{tables}, dispatches_(dispatches) {}

    // Returns false where the kernel's indices would overflow.
    [[nodiscard]] bool operator()(const height_map<float>& heights, std::span<const glm::dvec2> directions, bool holes,
                                  slot& s) {
        bool wanted[2] = {};
        for (const glm::dvec2& d : directions) wanted[head(d, j_.both[0].spacing).transposed ? 1 : 0] = true;
        const int frame_count = int(wanted[0]) + int(wanted[1]);
        const auto frame = [&](int i) { return frame_count == 2 ? i : int(wanted[1]); };
        for (int i = 0; i < frame_count; ++i) place_planes(frame(i));
        if (floats_ > most_floats) return false;

        const auto for_frames = [&](int kind, auto&& write) {
            const int first = table_.add(std::size_t(record * frame_count));
            glm::ivec2 threads(0);
            for (int i = 0; i < frame_count; ++i)
                threads = (glm::max)(threads, write(j_.both[std::size_t(frame(i))], planes_[frame(i)],
                                                    first + record * i, frame(i) == 1));
            dispatch(kind, first, threads, frame_count);
        };
        for_frames(0, [&](const pyramid& p, const bake_planes& at, int to, bool transposed) {
            return write_ground(heights, p, at, to, transposed);
        });
        const pyramid& any = j_.both[0];
        if (any.copied && any.count > 1)
            for_frames(1, [&](const pyramid& p, const bake_planes& at, int to, bool) { return write_base(p, at, to); });
        for (int level = 1; level < any.count; ++level)
            for_frames(2, [&](const pyramid& p, const bake_planes& at, int to, bool) {
                return write_level(p, at, level, to);
            });
        return bake(directions, holes, s);
    }

    [[nodiscard]] std::size_t table_count() const { return table_.count; }
    [[nodiscard]] std::size_t dispatch_count() const { return dispatch_count_; }
    [[nodiscard]] std::size_t scratch_floats() const { return std::size_t(floats_); }

private:
    static constexpr std::int64_t most_floats = (std::numeric_limits<std::int32_t>::max)();

    int take(std::int64_t count) {
        const std::int64_t first = floats_;
        floats_ += count;
        return int((std::min)(first, most_floats));
    }
    void dispatch(int kind, int first, glm::ivec2 threads, int layers) {
        const glm::ivec2 groups = (threads + bake_group - 1) / bake_group;
        if (dispatch_count_ < dispatches_.size())
            dispatches_[dispatch_count_] = {{kind, first, 0, 0}, {groups.x, groups.y, layers}};
        ++dispatch_count_;
    }

    void place_planes(int frame) {
        const pyramid& p = j_.both[std::size_t(frame)];
        bake_planes& at = planes_[frame];
        const auto take_plane = [&](glm::ivec2 cells) { return take(std::int64_t(cells.x) * cells.y); };
        at.ground = take(std::int64_t(p.texels.size()));
        for (int i = 1; i < p.count; ++i) {
            const level& l = p.levels[std::size_t(i)];
            auto& to = at.levels[std::size_t(i)];
            const auto& below = at.levels[std::size_t(i) - 1];
            to.occluder_row = l.occluders.cells.x;
            if (i == 1 && !p.copied) {
                to.occluders = at.ground + int(p.texels.offset(0, 0));
                to.occluder_row = int(p.texels.row_step);
            } else {
                to.occluders = take_plane(l.occluders.cells);
            }
            to.cells = take_plane(l.origins.cells);
            to.means = to.maxima = i == 1 ? to.occluders : below.means;
            if (i > 1) to.maxima = below.maxima;
            if (l.width > 1) {
                to.means = take_plane(l.squares);
                to.maxima = take_plane(l.squares);
            }
        }
    }

    glm::ivec2 write_ground(const height_map<float>& heights, const pyramid& p, const bake_planes& at, int to,
                            bool transposed) const {
        const ground& g = p.texels;
        const glm::ivec2 size = g.texels + 2 * g.halo;
        const int row = int(heights.row_stride);
        table_.set(to, {at.ground, int(g.row_step), size.x, size.y});
        table_.set(to + 1, {g.halo.x, g.halo.y, g.texels.x, g.texels.y});
        table_.set(to + 2, {transposed ? row : 1, transposed ? 1 : row, int(p.edge), 0});
        table_.set(to + 3, {bits_of(unit_height(heights) / p.unit), bits_of(heights.datum / p.unit), 0, 0});
        return size;
    }

    glm::ivec2 write_base(const pyramid& p, const bake_planes& at, int to) const {
        const ground& g = p.texels;
        const glm::ivec2 size = p.levels[1].occluders.cells;
        table_.set(to, {at.levels[1].occluders, size.x, size.y, int(p.edge)});
        table_.set(to + 1, {at.ground + int(g.offset(0, 0)), int(g.row_step), g.texels.x, g.texels.y});
        table_.set(to + 2, {bits_of(resampled_bias), 0, 0, 0});
        return size;
    }

    glm::ivec2 write_level(const pyramid& p, const bake_planes& at, int i, int to) const {
        const level& l = p.levels[std::size_t(i)];
        const auto& here = at.levels[std::size_t(i)];
        const auto& below = at.levels[std::size_t(i) - 1];
        const bool halved = l.width > 1;
        // Level 1 is made from its own occluders, which are the base grid.
        const bool from_base = i == 1 || p.levels[std::size_t(i) - 1].width == 1;
        const auto& base = at.levels[1];
        table_.set(to, from_base ? glm::ivec4(base.occluders, base.occluders, base.occluder_row, 0)
                                 : glm::ivec4(below.means, below.maxima, p.levels[std::size_t(i) - 1].squares.x, 0));
        table_.set(to + 1,
                   {halved ? here.means : -1, halved ? here.maxima : -1, i > 1 ? here.occluders : -1, here.cells});
        table_.set(to + 2, {l.squares.x, l.squares.y, l.ratio.x, l.ratio.y});
        table_.set(to + 3, {bits_of(occluder_bias), 0, 0, 0});
        return l.origins.cells;
    }

    // A shift in columns, brought into the first period if the edge has one.
    struct shifted {
        int whole;
        float part;
    };
    [[nodiscard]] shifted shift_of(double shift, int columns) const {
        const place at = place_of(shift);
        const edge_mode edge = j_.both[0].edge;
        if (edge == edge_mode::clamp || edge == edge_mode::open) return {int(at.cell), float(at.part)};
        const std::int64_t period = edge == edge_mode::mirror ? 2 * std::int64_t(columns) : columns;
        return {int(resolve_edge(at.cell, period, edge_mode::repeat)), float(at.part)};
    }
    // A row of a plane on lanes.
    [[nodiscard]] glm::ivec4 row_on_lanes(int plane, int row_step, glm::ivec2 cells, std::int64_t row, double shift,
                                          std::int64_t lane) const {
        const std::int64_t from = resolve_edge(row, cells.y, j_.both[0].edge);
        const shifted by = shift_of(shift, cells.x);
        return {from < 0 ? -1 : plane + int(from) * row_step, by.whole, bits_of(by.part), int(lane)};
    }

    // Where the pairs of a level are, and the lattice that they are of.
    struct bake_pairs {
        lattice at;
        int count = 0;  // lanes of a row
        int first = 0;  // float

        [[nodiscard]] int lane_zero(std::int64_t row) const {
            return first + 2 * int((row - at.first_row) * count - at.first_wanted(row));
        }
    };
    // What bumpshadow_bake_parents reads of a row.
    void write_parents(int to, const interpolation& bring, std::int64_t row, const bake_pairs& parent) const {
        const double y = bring.place_of_row(row), above = std::floor(y), shift = bring.lanes.shift(row);
        const interpolation::rows_between rows(bring, y - above);
        table_.set(to, {parent.lane_zero(std::int64_t(above)), parent.lane_zero(std::int64_t(above) + 1),
                        int(std::floor(shift)), bits_of(shift - std::floor(shift))});
        table_.set(to + 1,
                   {bits_of(rows.weight[0]), bits_of(rows.weight[1]), bits_of(rows.ahead[0]), bits_of(rows.ahead[1])});
    }

    // Cells and texels of all directions.
    [[nodiscard]] bool bake(std::span<const glm::dvec2> directions, bool holes, slot& s) {
        const int count = int(directions.size()), levels = j_.both[0].count;
        const int texels = table_.add(std::size_t(record) * directions.size());
        const int cells = table_.add(std::size_t(record) * directions.size() * std::size_t(levels - 1));
        std::array<glm::ivec2, most_levels> threads{};
        for (int i = 0; i < count; ++i) {
            const aim a = take_aim(j_, directions[std::size_t(i)]);
            const int frame = a.head.transposed ? 1 : 0;
            const pyramid& p = j_.both[std::size_t(frame)];
            const double tangent = a.along.tangent() * p.base.x / p.base.y;
            const auto lattices = place_lattices(p, {glm::ivec2(0), p.texels.texels}, a.range.top, tangent);
            bake_pairs parent;
            for (int level = levels - 1; level > 0; --level) {
                const int to = cells + record * ((level - 1) * count + i);
                table_.set(to, glm::ivec4(0));
                if (level > a.range.top) continue;
                bake_pairs found{.at = lattices[std::size_t(level)]};
                found.count = int(found.at.columns) + 3;
                found.first = take(2 * std::int64_t(found.count) * found.at.rows);
                if (floats_ > most_floats) return false;
                write_cells(to, p, planes_[frame], a, level, found, parent, s);
                glm::ivec2& most = threads[std::size_t(level)];
                most = (glm::max)(most, glm::ivec2(found.count, found.at.rows));
                parent = found;
            }
            write_texels(texels + record * i, i, p, planes_[frame], a, tangent, parent, holes, s);
            threads[0] = (glm::max)(threads[0], p.texels.texels);
        }
        for (int level = levels - 1; level > 0; --level)
            if (threads[std::size_t(level)].y > 0)
                dispatch(3, cells + record * (level - 1) * count, threads[std::size_t(level)], count);
        dispatch(4, texels, threads[0], count);
        return true;
    }

    void write_cells(int to, const pyramid& p, const bake_planes& planes, const aim& a, int i, const bake_pairs& found,
                     const bake_pairs& parent, slot& s) {
        const level& l = p.levels[std::size_t(i)];
        const auto& from = planes.levels[std::size_t(i)];
        const lattice& at = found.at;
        const bool down = a.along.step.y > 0.0;
        const double end = a.range.to[std::size_t(i)];
        const far_rows looks = choose_far_rows(p, i, a.along, a.range.to[std::size_t(i) - 1], end, s.beyond);
        const interpolation bring = parents_of_cells(p, a.along, l.width, end);
        const int rows = table_.add(3 * std::size_t(at.rows));
        for (int k = 0; k < at.rows; ++k) {
            const std::int64_t row = std::int64_t(at.first_row) + k;
            table_.set(rows + 3 * k, row_on_lanes(from.cells, l.origins.cells.x, l.origins.cells, row, at.shift(row),
                                                  at.first_wanted(row)));
            if (i < a.range.top) write_parents(rows + 3 * k + 1, bring, row, parent);
        }
        const std::int64_t last_row = std::int64_t(at.first_row) + at.rows - 1, last = looks.count - 1;
        const std::int64_t first_seen = looks.seen_from(l, down, at.first_row, down ? 0 : last);
        const std::int64_t last_seen = looks.seen_from(l, down, last_row, down ? last : 0);
        const int seen = int(table_.count);
        for (std::int64_t row = first_seen; row <= last_seen; ++row)
            table_.push(row_on_lanes(from.occluders, from.occluder_row, l.occluders.cells, row,
                                     shift_of_occluders(l, at, row), 0));
        const int distances = int(table_.count);
        for (int n = 0; n < looks.count;) {
            const int size = group_of(looks.first + n, looks.count - n);
            const float shared = 0.5f * (s.beyond[n].inverse + s.beyond[n + size - 1].inverse);
            for (const int end_of_group = n + size; n < end_of_group; ++n)
                table_.push({bits_of(s.beyond[n].inverse), bits_of(shared), 0, 0});
        }
        table_.set(to, {found.count, at.rows, rows, found.first});
        table_.set(to + 1, {seen + int(looks.seen_from(l, down, at.first_row, 0) - first_seen), l.rows_a_cell(),
                            down ? 1 : -1, looks.count});
        table_.set(to + 2, {l.occluders.cells.x, l.origins.cells.x, l.stride, int(p.edge)});
        table_.set(to + 3, {distances, i < a.range.top ? 1 : 0, 0, 0});
    }

    void write_texels(int to, int bearing, const pyramid& p, const bake_planes& planes, const aim& a, double tangent,
                      const bake_pairs& parent, bool holes, slot& s) {
        const glm::ivec2 size = p.texels.texels;
        const bool has_parents = a.range.top > 0, open = p.edge == edge_mode::open, transposed = a.head.transposed;
        const int rows = table_.add(has_parents ? 3 * std::size_t(size.y) : 0);
        if (has_parents) {
            const interpolation bring = parents_of_texels(p, a.along, tangent);
            for (int y = 0; y < size.y; ++y) {
                table_.set(rows + 3 * y, {bits_of(open ? inverse_of_end(a.along.step.y, y, size.y) : 0.0f), 0, 0, 0});
                write_parents(rows + 3 * y + 1, bring, y, parent);
            }
        }
        choose_near_looks(p, a, j_.options.steps, holes, s.around);
        const looks& around = s.around;
        const int crossings = int(table_.count);
        const auto add_crossing = [&](const crossing& c) {
            table_.push({int(c.offset), bits_of(c.weight[0]), bits_of(c.weight[1]), bits_of(c.inverse)});
        };
        std::for_each_n(around.corners, around.corner_count, add_crossing);
        std::for_each_n(around.crossings, around.crossing_count, add_crossing);
        const int others = int(table_.count);
        for (int i = 0; i < around.column_count; ++i) {
            const look<2>& c = around.columns[i];
            table_.push({int(c.offset[0]), int(c.offset[1]), 0, 0});
            table_.push({bits_of(c.weight[0]), bits_of(c.weight[1]), 0, 0});
            table_.push({bits_of(c.own), 0, 0, 0});
        }
        for (int i = 0; i < around.inside_count; ++i) {
            const look<4>& c = around.insides[i];
            table_.push({int(c.offset[0]), int(c.offset[1]), int(c.offset[2]), int(c.offset[3])});
            table_.push({bits_of(c.weight[0]), bits_of(c.weight[1]), bits_of(c.weight[2]), bits_of(c.weight[3])});
            table_.push({bits_of(c.own), 0, 0, 0});
        }
        const int width = transposed ? size.y : size.x, slice = bearing * size.x * size.y;
        const int base_cells = p.levels[1].occluders.cells.x;
        // With the distance that is one texel away, what it is for others follows by a division.
        const float leaves =
            open ? inverse_of_end(a.along.step.x, a.along.step.x > 0.0 ? size.x - 2 : 1, size.x) : 0.0f;
        table_.set(to, {size.x, size.y, planes.ground + int(p.texels.offset(0, 0)), int(p.texels.row_step)});
        table_.set(to + 1,
                   {slice, transposed ? width : 1, transposed ? 1 : width, bits_of(a.never_negative ? 0.0f : hole)});
        table_.set(to + 2, {crossings, around.corner_count + around.crossing_count, others,
                            around.column_count + around.inside_count});
        const bool tiles = p.edge == edge_mode::repeat || p.edge == edge_mode::mirror;
        table_.set(to + 3, {tiles ? base_cells : size.x, size.x * p.levels[1].width, rows, has_parents ? 1 : 0});
        table_.set(to + 4, {bits_of(a.along.step.x > 0.0 ? leaves : -leaves), 0, 0, 0});
    }

    const job& j_;
    bake_table table_;
    std::span<bake_dispatch> dispatches_;
    std::size_t dispatch_count_ = 0;
    bake_planes planes_[2];
    std::int64_t floats_ = 0;
};

}  // namespace cascade_detail

}  // namespace bumpshadow
