#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slice_fit.hpp>
#include <bumpshadow/encode/slice_reweight.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

// How rows of many directions become rows of a few slices, a band at a time; encode/slices.hpp is what callers use.

namespace bumpshadow {

// What happened to the samples that a pack read.
struct pack_report {
    std::size_t clamped = 0;  // steeper than max_slope, stored as it
    float steepest = 0.0f;    // slope (tangent) of the steepest; 0 where none is above 0
};

// What every function that packs horizons takes besides them.
struct pack_options {
    slice_fit fit = slice_fit::least_squares;  // how stored slices come of the horizons baked
    pack_report* report = nullptr;             // where to count what was clamped; null: nowhere
    // Row of level 0 of the texture that the horizons' first row is, so that a map may be packed in bands of rows, each
    // baked with bake_options::region: memory is then O(width * directions * rows of the band). The bytes are those of
    // packing the whole map. Looked at by the functions named pack_; 0 for several levels; for bc4 a multiple of 4.
    int first_row = 0;
    // As in bake_options. Sizes: slice_scratch_size.
    std::span<std::byte> scratch = {};
    std::pmr::memory_resource* memory = nullptr;  // null: std::pmr::get_default_resource()
};

// Rows of stored values in [0, 1], all slices of them; valid during the call that hands them over.
struct slice_rows {
    int y = 0;                                 // first row
    int count = 0;                             // rows
    const float* values = nullptr;             // of slice 0 of the first row
    std::size_t row_step = 0, slice_step = 0;  // floats from one to the next

    // Values of a row of a slice. r: 0 to count - 1
    [[nodiscard]] const float* row(int slice, int r) const {
        return values + std::size_t(slice) * slice_step + std::size_t(r) * row_step;
    }
};

namespace slice_detail {

inline constexpr int rows_of_item = 16;

// most = max(most, value), from any thread.
inline void raise(std::atomic<float>& most, float value) {
    float seen = most.load(std::memory_order_relaxed);
    while (value > seen && !most.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

// 1 / sqrt(1 + s^2) on [0, 1e18]; relative error 8e-7. std::sqrt may set errno, which keeps loops from being
// vectorized. Source of the constants: Kadlec, Improving the fast inverse square root (2010).
[[nodiscard]] inline float cosine_of_slope(float s) {
    const float square = 1.0f + s * s;
    float r = std::bit_cast<float>(0x5f1ffff9u - (std::bit_cast<std::uint32_t>(square) >> 1));
    r = 0.703952253f * r * (2.38924456f - square * r * r);
    return r * (1.5f - 0.5f * square * r * r);
}

[[nodiscard]] inline float sine_of_slope(float s) { return s * cosine_of_slope(s); }

// Arc tangent on [0, 1e18], by half the angle, whose tangent is at most 1. Error: 1e-6.
// Source: Abramowitz and Stegun, Handbook of Mathematical Functions (1964), 4.4.49.
[[nodiscard]] inline float angle_of_slope(float s) {
    const float cosine = cosine_of_slope(s), t = s * cosine / (1.0f + cosine), q = t * t;
    float a = 0.0028662257f;
    a = a * q - 0.0161657367f;
    a = a * q + 0.0429096138f;
    a = a * q - 0.0752896400f;
    a = a * q + 0.1065626393f;
    a = a * q - 0.1420889944f;
    a = a * q + 0.1999355085f;
    a = a * q - 0.3333314528f;
    return 2.0f * t * (a * q + 1.0f);
}

[[nodiscard]] inline float at_most_one(float v) { return v < 1.0f ? v : 1.0f; }

// What a chunk of all directions saw, lane by lane: counts are exact in floats.
struct lanes_seen {
    simd::pack clamped = simd::splat(0.0f), steepest = simd::splat(0.0f);
};

inline void add(pack_report& seen, const lanes_seen& lanes) {
    float clamped[simd::width], steepest[simd::width];
    simd::store(clamped, lanes.clamped);
    simd::store(steepest, lanes.steepest);
    for (int i = 0; i < simd::width; ++i) {
        seen.clamped += std::size_t(clamped[i]);
        seen.steepest = (std::max)(seen.steepest, steepest[i]);
    }
}

inline constexpr int fetch_distance = 8;  // directions

// Asks for memory that is read soon, where the compiler has a word for it.
inline void fetch(const float* from, int count) {
#if defined(__GNUC__)
    for (int i = 0; i < count; i += 16) __builtin_prefetch(from + i, 0, 2);
#else
    static_cast<void>(from), static_cast<void>(count);
#endif
}

// Slopes to stored values in [0, 1]; count is at most `chunk`; `to` is padded.
inline void convert(const horizon_scale& scale, const float* from, int count, float* to, lanes_seen& seen) {
    using namespace simd;
    const float limit = scale.stored == quantity::slope ? scale.max_slope : (std::min)(scale.max_slope, 1e18f);
    const float factor = scale.stored == quantity::slope ? 1.0f / scale.max_slope : 1.0f;
    const pack zero = splat(0.0f), one = splat(1.0f), most = splat(limit), to_unit = splat(factor);
    const pack ceiling = scale.stored == quantity::slope ? one : most;  // a rounded factor could lead above 1
    pack clamped = seen.clamped, steepest = seen.steepest;
    const auto step = [&](const float* slopes, float* stored) {
        const pack slope = load(slopes);
        const pack positive = select_greater(slope, zero, slope, zero);  // NaN becomes 0
        clamped = multiply_add(select_greater(positive, most, one, zero), one, clamped);
        steepest = larger(steepest, positive);
        const pack value = multiply(select_greater(positive, most, most, positive), to_unit);
        store(stored, select_greater(value, ceiling, ceiling, value));
    };
    int x = 0;
    for (; x + width <= count; x += width) step(from + x, to + x);
    if (x < count) {
        float rest[width] = {}, stored[width];
        std::copy(from + x, from + count, rest);
        step(rest, stored);
        std::copy(stored, stored + width, to + x);
        x += width;
    }
    seen = {clamped, steepest};
    const std::size_t end = padded(count);
    std::fill(to + x, to + (std::max)(std::size_t(x), end), 0.0f);
    const float scaled = scale.stored == quantity::slope ? 1.0f : stored_scale(scale);
    if (scale.stored == quantity::sine)
        for (std::size_t i = 0; i < end; ++i) to[i] = at_most_one(sine_of_slope(to[i]) * scaled);
    else if (scale.stored == quantity::angle)
        for (std::size_t i = 0; i < end; ++i) to[i] = at_most_one(angle_of_slope(to[i]) * scaled);
}

// All slices of one row; values: [slice] at slice_step, padded; work: work_size floats.
// source(index, x, y, count, to, seen) writes `count` stored values and pads them.
template <class Source>
void make_row(const plan& p, int width, int y, const Source& source, float* values, std::size_t slice_step, float* work,
              pack_report& report) {
    const int step = p.fitted ? fit_chunk : chunk;
    const std::span<const contribution> all = p.contributions;
    for (int x = 0; x < width; x += step) {
        const int count = (std::min)(step, width - x);
        const std::size_t padded_count = padded(count);
        float* const out = values + x;
        lanes_seen seen;
        if (!p.fitted) {
            for (const contribution& c : all)
                source(c.source, x, y, count, out + std::size_t(c.slice) * slice_step, seen);
            add(report, seen);
            continue;
        }
        for (int i = 0; i < p.slices.count; ++i) std::fill_n(out + std::size_t(i) * slice_step, padded_count, 0.0f);
        for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
            const contribution* const c = &all[from];
            // What is looked at again has to stay.
            float* const rows = p.reweighted ? work + from * work_step : work;
            for (; to < all.size() && to < from + work_rows && all[to].slice == c->slice; ++to)
                source(all[to].source, x, y, count, rows + (to - from) * work_step, seen);
            add_rows(c, int(to - from), rows, out + std::size_t(c->slice) * slice_step,
                     out + std::size_t(c->next) * slice_step, padded_count);
        }
        add(report, seen);
        solve(p.columns, out, slice_step, padded_count);
        if (p.reweighted) reweight(p, work, out, slice_step, work + all.size() * work_step, padded_count);
    }
}

// Floats of work: enough for any fit.
[[nodiscard]] constexpr std::size_t work_size(std::size_t directions, int slices) {
    return (std::max)(work_rows * work_step, reweight_size(directions, std::size_t(slices)));
}

// Floats from slice to slice of a band.
[[nodiscard]] constexpr std::size_t slice_step(int width, int rows) {
    return saturated_sum(saturated_product(padded(width), std::size_t(rows)), 16);
}

[[nodiscard]] inline std::size_t scratch_bytes(int width, std::size_t directions, int slices, int rows, int slots) {
    scratch_layout layout;
    layout.add<contribution>((std::max)(directions, std::size_t(slices))).add<column>(std::size_t(slices));
    layout.add<double>(3, std::size_t(slices)).add<glm::dvec2>(std::size_t(slices));
    for (int i = 0; i < slots; ++i)
        layout.add<float>(std::size_t(slices), slice_step(width, rows)).add<float>(work_size(directions, slices));
    return layout.add<float*>(2 * std::size_t(slots)).bytes();
}

struct request {
    glm::ivec2 extent;
    std::size_t sources;
    slice_set slices;
    int rows;  // of a band

    [[nodiscard]] std::size_t items() const { return std::size_t(part_count(extent.y, rows_of_item)); }
    [[nodiscard]] std::size_t bytes(int concurrency) const {
        return scratch_bytes(extent.x, sources, slices.count, rows, slot_pool::slots(concurrency, items()));
    }
};

// Takes the scratch of the largest of several runs, from the resource unless the options have some, and makes it that
// of the options: memory cannot run out when a part of the output is written.
[[nodiscard]] inline status take_scratch(const request& largest, int concurrency, scratch_block& block,
                                         pack_options& options) {
    if (!options.scratch.empty()) return {};
    bake_options where;
    where.memory = options.memory;
    const std::size_t bytes = largest.bytes(concurrency);
    if (status s = block.allocate(where, scratch_layout().add<std::byte>(bytes).bytes(), "the scratch of slices"); !s)
        return s;
    options.scratch = {block.carve<std::byte>(bytes), bytes};
    return {};
}

// Runs the bands. make_plan(plan&, std::span<glm::dvec2> one a slice, double* work) says how.
template <class MakePlan, class Source, executor Executor, class Sink>
[[nodiscard]] status run(const request& wanted, const pack_options& options, const MakePlan& make_plan,
                         const Source& source, Executor&& execute, const Sink& sink) {
    const int width = wanted.extent.x, height = wanted.extent.y, rows = wanted.rows;
    const std::size_t count = std::size_t(wanted.slices.count);
    const std::size_t items = wanted.items();
    const int slots = slot_pool::slots(execute.concurrency(), items);
    bake_options where;
    where.scratch = options.scratch;
    where.memory = options.memory;
    scratch_block block;
    if (status s = block.allocate(where, wanted.bytes(execute.concurrency()), "the scratch of slices"); !s) return s;
    plan p{.slices = wanted.slices, .contributions = {}, .columns = {}};
    const std::size_t contributions = (std::max)(wanted.sources, count);
    p.contributions = {block.carve<contribution>(contributions), contributions};
    p.columns = {block.carve<column>(count), count};
    double* const work = block.carve<double>(3 * count);
    if (status s = make_plan(p, std::span<glm::dvec2>(block.carve<glm::dvec2>(count), count), work); !s) return s;

    const std::size_t row_step = padded(width), step = slice_step(width, rows);
    float** const buffers = block.carve<float*>(2 * std::size_t(slots));
    for (int i = 0; i < slots; ++i) {
        buffers[2 * i] = block.carve<float>(count * step);
        buffers[2 * i + 1] = block.carve<float>(work_size(wanted.sources, wanted.slices.count));
    }
    std::atomic<std::size_t> clamped{0};
    std::atomic<float> steepest{0.0f};
    slot_pool pool(slots);
    execute(items, [&](std::size_t item) {
        const auto lease = pool.acquire();
        float* const values = buffers[2 * lease.index()];
        pack_report seen;
        const int first = int(item) * rows_of_item, end = first + (std::min)(rows_of_item, height - first);
        for (int y = first; y < end; y += rows) {
            const int here = (std::min)(rows, end - y);
            for (int r = 0; r < here; ++r)
                make_row(p, width, y + r, source, values + std::size_t(r) * row_step, step,
                         buffers[2 * lease.index() + 1], seen);
            sink(slice_rows{y, here, values, row_step, step});
        }
        clamped.fetch_add(seen.clamped, std::memory_order_relaxed);
        raise(steepest, seen.steepest);
    });
    if (options.report != nullptr) *options.report = {clamped.load(), steepest.load()};
    return {};
}

}  // namespace slice_detail

}  // namespace bumpshadow
