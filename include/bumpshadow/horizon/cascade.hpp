#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/horizon/cascade_taps.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/status.hpp>

// The fast method: horizons of unlimited range at a constant cost a sample.
//
// Near occluders are looked at texel by texel. Farther ones are found for cells of 2, 4, 8 ... texels, each level
// reaching four times as far as the one before and looking at heights averaged to half its own cell. What a cell passes
// down is not a slope but its occluder, as the pair a = H / t, b = 1 / t of the occluder's height H and distance t: the
// slope that it makes for a height h is a - b h, so that pairs may be interpolated between cells and still give the
// right slope for each texel's own height.

namespace bumpshadow {

namespace cascade_detail {

// Occluders of a rectangle of cells, as pairs (a, b).
struct pairs {
    float* a = nullptr;
    float* b = nullptr;
    rectangle cells = {};  // may begin before the map's first cell
    std::ptrdiff_t stride = 0;

    [[nodiscard]] std::ptrdiff_t offset(int x, int y) const {
        return (y - cells.origin.y) * stride + (x - cells.origin.x);
    }
};

// Rectangles begin at even columns, so that chunks of a level and of its parent keep step.
[[nodiscard]] inline rectangle even(rectangle r) {
    const int shift = r.origin.x & 1;
    return {{r.origin.x - shift, r.origin.y}, {r.extent.x + shift, r.extent.y}};
}

[[nodiscard]] constexpr std::ptrdiff_t pair_stride(int cells) { return (cells + chunk - 1) / chunk * chunk + chunk; }

[[nodiscard]] inline std::size_t pair_capacity(const grid& cells) {
    return std::size_t(pair_stride(cells.cells.x + border)) * std::size_t(cells.cells.y + border);
}

// Where a cell lies between the cells of the level above.
struct parent_axis {
    double scale;  // its own size over the parent's

    [[nodiscard]] double at(int i) const { return (i + 0.5) * scale - 0.5; }
    [[nodiscard]] int first(int i) const { return int(std::floor(at(i))); }
    [[nodiscard]] float part(int i) const { return float(at(i) - std::floor(at(i))); }
};

[[nodiscard]] inline rectangle parents_of(rectangle cells, parent_axis x, parent_axis y) {
    const glm::ivec2 last = cells.origin + cells.extent - 1;
    const glm::ivec2 from(x.first(cells.origin.x), y.first(cells.origin.y));
    const glm::ivec2 to(x.first(last.x) + 1, y.first(last.y) + 1);
    return even({from, to - from + 1});
}

inline constexpr int strip =
    (std::max)(256, chunk);  // columns done together, so that the rows they look at stay cached

// A strip of one row of pairs, brought from the parent's cells to the level's.
class interpolation {
public:
    interpolation(const pairs* parent, parent_axis x, parent_axis y, int first, int count)
        : parent_(parent), y_(y), halves_(x.scale == 0.5), count_(count) {
        from_ = x.first(first);
        wanted_ = x.first(first + count - 1) + 2 - from_;
        if (halves_) return;
        for (int i = 0; i < count; ++i) {
            index_[i] = x.first(first + i) - from_;
            part_[i] = x.part(first + i);
        }
    }

    template <bool Holes>
    void row(int y, float* a, float* b) {
        if constexpr (Holes) return row_with_holes(y, a, b);
        const std::ptrdiff_t at = parent_->offset(from_, y_.first(y));
        const float part = y_.part(y);
        blend(parent_->a + at, part, a);
        blend(parent_->b + at, part, b);
    }

private:
    // The same where some parents saw nothing: those do not take part, and where none is left nothing is seen.
    void row_with_holes(int y, float* a, float* b) const {
        const std::ptrdiff_t at = parent_->offset(from_, y_.first(y));
        const float below = y_.part(y);
        for (int i = 0; i < count_; ++i) {
            const int x = halves_ ? (i + 1) / 2 : index_[i];
            const float right = halves_ ? (i % 2 == 0 ? 0.75f : 0.25f) : part_[i];
            float sum = 0.0f, sum_a = 0.0f, sum_b = 0.0f;
            for (int corner = 0; corner < 4; ++corner) {
                const std::ptrdiff_t p = at + x + (corner & 1) + (corner >> 1) * parent_->stride;
                const float weight =
                    ((corner & 1) != 0 ? right : 1.0f - right) * ((corner >> 1) != 0 ? below : 1.0f - below);
                if (parent_->a[p] < hole_limit || weight == 0.0f) continue;
                sum += weight;
                sum_a += weight * parent_->a[p];
                sum_b += weight * parent_->b[p];
            }
            a[i] = sum > 0.0f ? sum_a / sum : hole;
            b[i] = sum > 0.0f ? sum_b / sum : 0.0f;
        }
    }

    void blend(const float* above, float part, float* to) {
        const float* below = above + parent_->stride;
        const simd::pack lower = simd::splat(part), upper = simd::splat(1.0f - part);
        for (int i = 0; i < wanted_; i += simd::width)
            simd::store(line_ + i,
                        simd::multiply_add(simd::load(below + i), lower, simd::multiply(simd::load(above + i), upper)));
        if (halves_) {
            const simd::pack quarter = simd::splat(0.25f), most = simd::splat(0.75f);
            for (int i = 0; i < (count_ + 1) / 2; i += simd::width) {
                const simd::pack middle = simd::multiply(simd::load(line_ + i + 1), most);
                simd::store(left_ + i, simd::multiply_add(simd::load(line_ + i), quarter, middle));
                simd::store(right_ + i, simd::multiply_add(simd::load(line_ + i + 2), quarter, middle));
            }
            for (int i = 0; i < (count_ + 1) / 2; ++i) {
                to[2 * i] = left_[i];
                to[2 * i + 1] = right_[i];
            }
            return;
        }
        for (int i = 0; i < count_; ++i) {
            left_[i] = line_[index_[i]];
            right_[i] = line_[index_[i] + 1];
        }
        for (int i = 0; i < count_; i += simd::width) {
            const simd::pack left = simd::load(left_ + i);
            simd::store(to + i,
                        simd::multiply_add(simd::subtract(simd::load(right_ + i), left), simd::load(part_ + i), left));
        }
    }

    const pairs* parent_;
    parent_axis y_;
    bool halves_;
    int count_;
    int from_ = 0, wanted_ = 0;
    int index_[strip];
    alignas(64) float part_[strip + chunk];
    alignas(64) float line_[strip + 2 * chunk];
    alignas(64) float left_[strip + chunk];
    alignas(64) float right_[strip + chunk];
};

// What one direction needs of every level: how far it looks there, and the highest level that is needed at all.
struct schedule {
    std::array<double, most_levels> from{}, to{};
    int top = 0;
};

// One item of a bake: some rows of one direction.
struct job {
    const levels_shape& shape;
    const height_range& range;
    const bake_options& options;
    int capacity;
};

// Farther occluders than this make slopes of less than 1/4096 (0.014 degrees), or lie beyond all borders.
[[nodiscard]] inline double farthest_distance(const job& j, glm::dvec2 d, bool never_negative) {
    const grid& g = j.shape.levels[0].occluders;
    double farthest = j.options.radius / j.shape.unit;
    if (j.shape.edge == edge_mode::clamp || j.shape.edge == edge_mode::open) {
        const glm::dvec2 size = glm::dvec2(g.cells + 1) * g.spacing;
        const double x = d.x == 0.0 ? -1.0 : size.x / std::abs(d.x), y = d.y == 0.0 ? -1.0 : size.y / std::abs(d.y);
        const bool both = x >= 0.0 && y >= 0.0 && j.shape.edge == edge_mode::open;
        farthest = (std::min)(farthest, both ? (std::min)(x, y) : (std::max)(x, y));
    }
    if (never_negative || std::isinf(farthest))
        farthest = (std::min)(farthest, 4096.0 * (double(j.range.highest) - double(j.range.lowest)) + 1.0);
    return farthest;
}

[[nodiscard]] inline schedule make_schedule(const job& j, glm::dvec2 direction, double farthest) {
    schedule s;
    for (int i = 0; i < j.shape.count; ++i) {
        const ray r = make_ray(j.shape.levels[std::size_t(i)], j.shape.edge, direction, 0.0);
        double& from = s.from[std::size_t(i)];
        double& to = s.to[std::size_t(i)];
        if (i > 0) from = s.to[std::size_t(i - 1)];
        to = i == j.shape.count - 1 ? farthest : i == 0 ? j.options.steps / r.main_step : growth * from;
        const int most = i == 0 ? (std::max)(most_crossings, j.options.steps) : most_crossings;
        to = (std::min)({to, farthest, from + most / r.main_step});
        s.top = i;
        if (to >= farthest || !(r.main_step > 0.0)) break;
    }
    return s;
}

// slopes = max(slopes, a - b * height), and the inverse distances that go with them.
inline void take_parents(const float* a, const float* b, const float* heights, int count, float* slopes,
                         float* inverses) {
    for (int i = 0; i < count; i += simd::width) {
        const simd::pack inverse = simd::load(b + i), own = simd::load(slopes + i);
        const simd::pack depth = simd::subtract(simd::splat(0.0f), simd::load(heights + i));
        const simd::pack slope = simd::multiply_add(inverse, depth, simd::load(a + i));
        simd::store(inverses + i, simd::select_greater(slope, own, inverse, simd::load(inverses + i)));
        simd::store(slopes + i, simd::max(slope, own));
    }
}

// Finds the horizons of a rectangle of a level's cells, strip by strip, and hands each piece of a row to
//   store(x, y, count, heights, slopes, inverses)
// Track: whether inverse distances are wanted. parent: null at the highest level.
template <bool Track, bool Holes, class Store>
void scan_level(const level& l, const looks& look, rectangle cells, const pairs* parent, parent_axis px, parent_axis py,
                float floor, Store&& store) {
    alignas(64) float slopes[strip + chunk], inverses[strip + chunk], a[strip + chunk], b[strip + chunk];
    for (int x = cells.origin.x, end = x + cells.extent.x; x < end; x += strip) {
        const int count = (std::min)(strip, end - x);
        interpolation between_parents(parent, px, py, x, count);
        for (int y = cells.origin.y; y < cells.origin.y + cells.extent.y; ++y) {
            const float* heights = l.origins.values + l.origins.offset(x, y);
            const float* occluders =
                l.occluders.values + l.occluders.offset(std::int64_t(x) * l.ratio.x, std::int64_t(y) * l.ratio.y);
            for (int i = 0; i < count; i += chunk)
                scan_chunk<Track>(look, occluders + i, heights + i, floor, slopes + i, inverses + i);
            if (parent != nullptr) {
                between_parents.template row<Holes>(y, a, b);
                take_parents(a, b, heights, count, slopes, inverses);
            }
            store(x, y, count, heights, slopes, inverses);
        }
    }
}

// Where an item's work lies; one for each item that runs at a time.
struct slot {
    looks look;
    std::array<float*, 2> pair_values{};
};

[[nodiscard]] inline std::size_t pair_size(const levels_shape& s, int parity) {
    return int(s.count) > 1 + parity ? 2 * pair_capacity(s.levels[std::size_t(1 + parity)].origins) : 0;
}

inline void add_slot(const levels_shape& s, int most, scratch_layout& layout) {
    layout.add<crossing>(std::size_t(most)).add<group>(std::size_t(most)).add<inside>(std::size_t(most));
    layout.add<float>(pair_size(s, 0)).add<float>(pair_size(s, 1));
}

[[nodiscard]] inline slot carve_slot(const levels_shape& s, int most, scratch_block& block) {
    slot t;
    t.look.crossings = block.carve<crossing>(std::size_t(most));
    t.look.groups = block.carve<group>(std::size_t(most));
    t.look.insides = block.carve<inside>(std::size_t(most));
    t.pair_values = {block.carve<float>(pair_size(s, 0)), block.carve<float>(pair_size(s, 1))};
    return t;
}

// Bakes some rows of one direction.
template <bool Holes>
void bake_rows(const job& j, int bearing, glm::dvec2 direction, rectangle texels, const horizon_map& out,
               glm::ivec2 out_origin, slot& t) {
    const levels_shape& s = j.shape;
    const double largest = (std::max)(std::abs(direction.x), std::abs(direction.y));
    const glm::dvec2 scaled = direction / largest, d = scaled / std::hypot(scaled.x, scaled.y);
    const double curvature = curvature_along(j.options.curvature, d) * s.unit;
    const bool never_negative = horizon_is_never_negative(s.edge, j.options.radius, curvature);
    const double farthest = farthest_distance(j, d, never_negative);
    const schedule plan = make_schedule(j, d, farthest);
    const double radius = j.options.radius / s.unit;

    std::array<rectangle, most_levels> cells;
    cells[0] = even(texels);
    const auto parent_x = [&](int i) {
        return parent_axis{s.levels[std::size_t(i)].origins.spacing.x / s.levels[std::size_t(i + 1)].origins.spacing.x};
    };
    const auto parent_y = [&](int i) {
        return parent_axis{s.levels[std::size_t(i)].origins.spacing.y / s.levels[std::size_t(i + 1)].origins.spacing.y};
    };
    for (int i = 0; i < plan.top; ++i)
        cells[std::size_t(i + 1)] = parents_of(cells[std::size_t(i)], parent_x(i), parent_y(i));

    pairs parent;
    for (int i = plan.top; i >= 0; --i) {
        const level& l = s.levels[std::size_t(i)];
        const rectangle& here = cells[std::size_t(i)];
        const ray r = make_ray(l, s.edge, d, curvature);
        look_at_lines(r, plan.from[std::size_t(i)], plan.to[std::size_t(i)], i == 0 ? j.capacity / 2 : most_crossings,
                      t.look);
        if (i == plan.top && r.main_step > 0.0 && radius <= plan.to[std::size_t(i)])
            t.look.insides[t.look.inside_count++] = look_between_lines(r, radius);
        const pairs* above = i == plan.top ? nullptr : &parent;
        const parent_axis px = above != nullptr ? parent_x(i) : parent_axis{1.0};
        const parent_axis py = above != nullptr ? parent_y(i) : parent_axis{1.0};
        if (i > 0) {
            pairs found{.cells = here, .stride = pair_stride(here.extent.x)};
            found.a = t.pair_values[std::size_t(~i & 1)];
            found.b = found.a + pair_capacity(l.origins);
            scan_level<true, Holes>(
                l, t.look, here, above, px, py, hole,
                [&](int x, int y, int count, const float* heights, const float* slopes, const float* inverses) {
                    float* a = found.a + found.offset(x, y);
                    float* b = found.b + found.offset(x, y);
                    for (int k = 0; k < count; k += simd::width) {
                        const simd::pack inverse = simd::load(inverses + k);
                        simd::store(a + k,
                                    simd::multiply_add(inverse, simd::load(heights + k), simd::load(slopes + k)));
                        simd::store(b + k, inverse);
                    }
                    if constexpr (Holes)
                        for (int k = 0; k < count; ++k)
                            if (heights[k] < hole_limit || slopes[k] < hole_limit) a[k] = hole, b[k] = 0.0f;
                });
            parent = found;
            continue;
        }
        const double near = double(j.options.steps) / (r.main_step > 0.0 ? r.main_step : 1.0);
        look_closer(r, (std::min)(near / 4.0, plan.to[0]), (std::min)(near / 8.0, plan.to[0]), j.capacity, t.look);
        const float floor = never_negative ? 0.0f : hole;
        const auto finish = [&](int x, int y, int count, const float* heights, float* slopes, float* inverses) {
            if constexpr (Holes)
                for (int k = 0; k < count; ++k)
                    if (heights[k] < hole_limit || slopes[k] < hole_limit) slopes[k] = no_horizon, inverses[k] = 0.0f;
            const int skip = (std::max)(texels.origin.x - x, 0);
            const int column = x + skip - out_origin.x, row = y - out_origin.y;
            std::memcpy(out.row(bearing, row) + column, slopes + skip, std::size_t(count - skip) * sizeof(float));
            if (j.options.distances.values.empty()) return;
            float* distances = j.options.distances.row(bearing, row) + column;
            for (int k = skip; k < count; ++k)
                distances[k - skip] = inverses[k] >= inverse_of_zero ? 0.0f
                                      : inverses[k] > 0.0f           ? float(s.unit / double(inverses[k]))
                                                                     : std::numeric_limits<float>::infinity();
        };
        if (j.options.distances.values.empty())
            scan_level<false, Holes>(l, t.look, here, above, px, py, floor, finish);
        else
            scan_level<true, Holes>(l, t.look, here, above, px, py, floor, finish);
    }
}

// Items of a bake: bands of rows are made only where there are too few directions to keep the executor busy.
[[nodiscard]] inline int band_count(std::size_t directions, int rows, int concurrency) {
    if (concurrency <= 1) return 1;
    const std::size_t wanted = (4 * std::size_t(concurrency) + directions - 1) / directions;
    return int((std::min)(wanted, std::size_t((std::max)(rows / 64, 1))));
}

}  // namespace cascade_detail

// Bytes of scratch that bake_cascade takes for these heights, whatever the number of directions.
template <height_sample Sample>
[[nodiscard]] std::size_t cascade_scratch_size(const height_map<Sample>& heights, const bake_options& options = {},
                                               int concurrency = 1) {
    const auto shape = cascade_detail::shape_levels(heights.extent, heights.texel_size, heights.edge, options.steps);
    scratch_layout layout;
    cascade_detail::add_levels(shape, layout);
    for (int i = 0; i < slot_pool::slots(concurrency, std::size_t(slot_pool::max_slots)); ++i)
        cascade_detail::add_slot(shape, cascade_detail::capacity(options.steps), layout);
    return layout.bytes();
}

// Bakes horizons of a height map in any list of directions.
//   out: slopes [direction][y][x] of the region; distances of the occluders on request (options)
//   options.steps: how many texels are looked at one by one, the knob of error against run time; README has a table
// Any extent, edge mode, texel size, radius, curvature. Identical for any executor and for any region, bit for bit.
// Errors: those of check_bake; not_finite with the first such height; scratch too small or out of memory.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status bake_cascade(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                  const horizon_map& out, const bake_options& options = {}, Executor&& execute = {}) {
    using namespace cascade_detail;
    if (status s = check_bake(heights, directions, out, options); !s) return s;
    if (status s = check_samples(heights); !s) return s;

    levels_shape shape = shape_levels(heights.extent, heights.texel_size, heights.edge, options.steps);
    const rectangle region = region_or_all(options.region, heights.extent);
    const int bands = band_count(directions.size(), region.extent.y, execute.concurrency());
    const std::size_t items = directions.size() * std::size_t(bands);
    const int slots = slot_pool::slots(execute.concurrency(), items);
    const int most = capacity(options.steps);
    scratch_layout layout;
    add_levels(shape, layout);
    for (int i = 0; i < slots; ++i) add_slot(shape, most, layout);
    layout.add<slot>(std::size_t(slots));
    scratch_block block;
    if (status s = block.allocate(options, layout.bytes(), "the cascade's scratch"); !s) return s;

    for (int i = 0; i < shape.count; ++i) {
        level& l = shape.levels[std::size_t(i)];
        l.occluders.values = block.carve<float>(l.occluders.size());
        l.origins.values = i == 0 ? l.occluders.values : block.carve<float>(l.origins.size());
    }
    const height_range range = fill_base(heights, shape.unit, shape.levels[0].occluders);
    fill_halo(shape.levels[0].occluders, shape.edge);
    const bool holes = range.holes || shape.edge == edge_mode::open;
    {
        const std::size_t base = std::size_t(shape.x.cells) * std::size_t(shape.y.cells);
        float* const first = block.carve<float>(base);
        float* const second = block.carve<float>(base);
        float* const row = block.carve<float>(2 * std::size_t(shape.x.cells) + 4 * std::size_t(chunk));
        (holes ? build_levels<true> : build_levels<false>)(shape, {first, second}, row);
    }
    slot* const slot_list = block.carve<slot>(std::size_t(slots));
    for (int i = 0; i < slots; ++i) slot_list[i] = carve_slot(shape, most, block);

    const job j{shape, range, options, most};
    slot_pool pool(slots);
    execute(items, [&](std::size_t item) {
        const int bearing = int(item / std::size_t(bands)), band = int(item % std::size_t(bands));
        const int from = int(std::int64_t(region.extent.y) * band / bands);
        const int to = int(std::int64_t(region.extent.y) * (band + 1) / bands);
        const rectangle rows{{region.origin.x, region.origin.y + from}, {region.extent.x, to - from}};
        const auto lease = pool.acquire();
        (holes ? bake_rows<true> : bake_rows<false>)(j, bearing, directions[std::size_t(bearing)], rows, out,
                                                     region.origin, slot_list[lease.index()]);
    });
    return {};
}

}  // namespace bumpshadow
