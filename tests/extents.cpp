// Maps of any extent: one texel, one row, primes, rows that lie gigabytes apart, and 16384 x 16384 (suite "slow").

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory_resource>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "support/reserved.hpp"
#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

using list = std::vector<glm::dvec2>;

constexpr edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};

enum class method { exact, cascade, sweep, sweep_classic, neighborhood };
constexpr method fast[] = {method::cascade, method::sweep, method::sweep_classic, method::neighborhood};

template <height_sample Sample>
void bake(method which, const height_map<Sample>& map, const list& directions, const horizon_map& out,
          const bake_options& options = {}) {
    status s;
    switch (which) {
        case method::exact: s = bake_exact(map, directions, out, options); break;
        case method::cascade: s = bake_cascade(map, directions, out, options); break;
        case method::sweep: s = bake_sweep(map, directions, out, options); break;
        case method::sweep_classic: s = bake_sweep_classic(map, directions, out, options); break;
        case method::neighborhood: s = bake_neighborhood(map, directions, out, options); break;
    }
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
}

// Hills a few texels and a few hundred texels wide, steps among them; no multiple of any extent here.
float hilly(int x, int y) {
    const double hills = 3.0 * std::sin(0.11 * x + 0.05 * y) + 2.0 * std::cos(0.23 * y - 0.31 * x);
    return float(hills + 12.0 * std::sin(0.0031 * (x + 2.0 * y)) + ((x / 37 + y / 53) % 5 == 0 ? 1.0 : 0.0));
}

double degrees(double slope) { return std::atan(slope) * 180.0 / std::numbers::pi; }

struct difference {
    double mean = 0.0, percentile_99 = 0.0;
};

// At about `wanted` texels, the corners among them.
template <height_sample Sample>
difference from_exact(const height_map<Sample>& map, const list& directions, const horizon_map& out, int wanted) {
    std::vector<Sample> storage(height_bounds<Sample>::required_size(map.extent));
    const height_bounds<Sample> bounds(map, storage);
    std::vector<double> all;
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (int n = 0; n < wanted; ++n) {
            const std::int64_t texels = std::int64_t(map.extent.x) * map.extent.y;
            const std::int64_t at = n < 2 ? n * (texels - 1) : n * 7919 * ((texels / wanted) | 1) % texels;
            const glm::ivec2 p(at % map.extent.x, at / map.extent.x);
            const double slope = exact_horizon(map, p, directions[i], bake_options{}.radius, {}, &bounds).slope;
            all.push_back(std::abs(degrees(slope) - degrees(double(out.row(int(i), p.y)[p.x]))));
        }
    std::sort(all.begin(), all.end());
    difference d;
    for (const double e : all) d.mean += e / double(all.size());
    d.percentile_99 = all[all.size() * 99 / 100];
    return d;
}

struct bound {
    method which;
    difference most;
};
// What the methods promise on hard maps (tests/stability); the classic sweep promises nothing.
constexpr bound promised[] = {{method::cascade, {0.5, 5.0}}, {method::sweep, {0.15, 2.0}}};

}  // namespace

namespace {

// `sweeps_clamped`: the sweeps on clamped edges, too.
void check_fast_methods(glm::ivec2 extent, bool sweeps_clamped = true) {
    const list directions{{1.0, 0.0}, {-0.3, -1.0}};
    const auto map = shapes::sampled<float>(extent, [](double x, double y) { return hilly(int(x), int(y)); });
    std::vector<float> slopes(required_size(extent, 2));
    const horizon_map out{.values = slopes, .extent = extent, .bearings = 2};
    for (const edge_mode edge : edges)
        for (const method which : fast) {
            const bool is_sweep = which == method::sweep || which == method::sweep_classic;
            if (is_sweep && edge == edge_mode::clamp && !sweeps_clamped) continue;
            CAPTURE(extent.x);
            CAPTURE(extent.y);
            CAPTURE(int(edge));
            CAPTURE(int(which));
            std::fill(slopes.begin(), slopes.end(), -7e9f);
            bake(which, map.view(edge), directions, out);
            const bool signed_slopes = edge == edge_mode::open && which != method::neighborhood;
            std::size_t wrong = 0;
            for (const float s : slopes) wrong += !std::isfinite(s) || s == -7e9f || (!signed_slopes && s < 0.0f);
            CHECK(wrong == 0);
            for (const bound& b : promised) {
                if (b.which != which) continue;
                const difference d = from_exact(map.view(edge), directions, out, 400);
                CHECK(d.mean <= b.most.mean);
                CHECK(d.percentile_99 <= b.most.percentile_99);
            }
        }
}

}  // namespace

TEST_CASE("one texel, two by three, one row, one column, primes: finite, and as exact as anywhere") {
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {2, 3}, {1, 1024}, {1024, 1}, {127, 131}, {521, 13}})
        check_fast_methods(extent);
}

TEST_CASE("65536 by one and long primes" * doctest::test_suite("slow")) {
    MESSAGE("skipped: sweeps with clamped edges, which follow each slanted line along the whole border: minutes");
    for (const glm::ivec2 extent : {glm::ivec2(1, 65536), {65536, 1}, {127, 8191}}) check_fast_methods(extent, false);
}

TEST_CASE("bake_exact of the smallest maps and of a row in a long one is exact_horizon()") {
    const list directions{{1.0, 0.0}, {-0.3, -1.0}};
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {2, 3}, {1, 65536}, {65536, 1}})
        for (const edge_mode edge : edges) {
            const auto map = shapes::sampled<float>(extent, [](double x, double y) { return hilly(int(x), int(y)); });
            bake_options options;
            const auto at_most_5 = [](int texels) { return std::min((texels + 1) / 2, 5); };
            options.region = {extent / 2, {at_most_5(extent.x), at_most_5(extent.y)}};
            std::vector<float> slopes(required_size(options.region.extent, 2));
            const horizon_map out{.values = slopes, .extent = options.region.extent, .bearings = 2};
            bake(method::exact, map.view(edge), directions, out, options);
            for (int i = 0; i < 2; ++i)
                for (int y = 0; y < out.extent.y; ++y)
                    for (int x = 0; x < out.extent.x; ++x) {
                        const float slope = out.row(i, y)[x];
                        CHECK(std::isfinite(slope));
                        CHECK(slope == float(exact_horizon(map.view(edge), options.region.origin + glm::ivec2(x, y),
                                                           directions[std::size_t(i)])
                                                 .slope));
                    }
        }
}

namespace {

constexpr std::int64_t beyond = (std::int64_t(1) << 31) + 64;

template <height_sample Sample>
void check_far_rows() {
    const glm::ivec2 extent(70, 3);
    const list directions{{1.0, 0.0}, {-0.3, -1.0}, {0.2, 1.0}};
    const auto tight = shapes::sampled<Sample>(
        extent, [](double x, double y) { return std::floor(double(hilly(int(x), int(y))) * 4.0) + 90.0; });
    // Samples from row to row, then floats: both more than 2^31, in three rows and three slices of three rows.
    const reserved heights(std::size_t(2 * beyond + extent.x) * sizeof(Sample));
    const reserved output(std::size_t(2 * beyond + 3 * extent.x) * sizeof(float));
    const reserved slices(std::size_t(2 * beyond + 3 * extent.x) * sizeof(float));
    if (heights.data() == nullptr || output.data() == nullptr || slices.data() == nullptr) {
        MESSAGE("skipped: no address space of so many gigabytes here");
        return;
    }
    auto* const samples = static_cast<Sample*>(heights.data());
    for (int y = 0; y < extent.y; ++y) std::copy_n(&tight.at(0, y), extent.x, samples + y * beyond);

    for (const method which :
         {method::exact, method::cascade, method::sweep, method::sweep_classic, method::neighborhood})
        for (const edge_mode edge : edges) {
            CAPTURE(int(which));
            CAPTURE(int(edge));
            height_map<Sample> near = tight.view(edge);
            near.height_scale = 0.25 * (sizeof(Sample) == 1 ? 255.0 : 1.0);
            height_map<Sample> far = near;
            far.samples = samples;
            far.row_stride = beyond;
            std::vector<float> expected(required_size(extent, 3));
            bake(which, near, directions, {.values = expected, .extent = extent, .bearings = 3});

            // No room is left for further slices behind such rows, so one direction at a time.
            for (std::size_t i = 0; i < directions.size(); ++i) {
                auto* const values = static_cast<float*>(output.data());
                const horizon_map out{.values = {values, std::size_t(2 * beyond + extent.x)},
                                      .extent = extent,
                                      .bearings = 1,
                                      .row_stride = std::size_t(beyond)};
                bake(which, far, {directions[i]}, out);
                for (int y = 0; y < extent.y; ++y)
                    CHECK(std::equal(out.row(0, y), out.row(0, y) + extent.x,
                                     expected.begin() + std::ptrdiff_t(i * 210) + y * extent.x));
            }
            auto* const values = static_cast<float*>(slices.data());
            const horizon_map out{.values = {values, std::size_t(2 * beyond + 3 * extent.x)},
                                  .extent = extent,
                                  .bearings = 3,
                                  .slice_stride = std::size_t(beyond)};
            bake(which, far, directions, out);
            for (int i = 0; i < 3; ++i)
                CHECK(std::equal(out.row(i, 0), out.row(i, 0) + 210, expected.begin() + i * 210));
        }
}

}  // namespace

TEST_CASE("rows and slices more than 2^31 samples apart") {
    check_far_rows<std::uint8_t>();
    check_far_rows<float>();
}

namespace {

// Knows the most that was out at a time.
class peak : public std::pmr::memory_resource {
public:
    std::size_t out = 0, most = 0;

private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override {
        void* const block = std::pmr::new_delete_resource()->allocate(bytes, alignment);
        out += bytes;
        most = std::max(most, out);
        return block;
    }
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
        out -= bytes;
        std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

// Memory that the machine has left, where it says so; else 0.
std::size_t memory_left() {
    std::size_t kilobytes = 0;
    if (std::FILE* const file = std::fopen("/proc/meminfo", "r"); file != nullptr) {
        char line[128];
        while (std::fgets(line, sizeof line, file) != nullptr)
            if (std::sscanf(line, "MemAvailable: %zu", &kilobytes) == 1) break;
        std::fclose(file);
    }
    return kilobytes * 1024;
}

}  // namespace

TEST_CASE("16384 x 16384" * doctest::test_suite("slow")) {
    const glm::ivec2 extent(16384);
    const list directions{{0.3, 1.0}};
    height_map<float> map = tight_height_map(static_cast<const float*>(nullptr), extent);
    const std::size_t scratch = cascade_scratch_size(map), plane = required_size(extent, 1) * sizeof(float);
    const std::size_t needed = scratch + 2 * plane;
    MESSAGE("heights and slopes of ", plane, " bytes each, scratch of ", scratch, " (",
            double(scratch) / double(required_size(extent, 1)), " a texel)");
    if (memory_left() < needed + needed / 8) {
        MESSAGE("skipped: it needs ", needed, " bytes, and ", memory_left(), " are left or known to be");
        return;
    }
    // 4096 hills repeat without a seam.
    std::vector<float> heights(required_size(extent, 1)), slopes(heights.size());
    std::vector<float> wave(4096), swell(16384);
    for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = 4.0f * std::sin(float(i) * 0.09817477f);
    for (std::size_t i = 0; i < swell.size(); ++i) swell[i] = 300.0f * std::sin(float(i) * 3.8349519e-4f);
    for (std::size_t y = 0, next = 0; y < 16384; ++y)
        for (std::size_t x = 0; x < 16384; ++x, ++next)
            heights[next] = wave[(3 * x + 5 * y) % 4096] + wave[(7 * y + 16384 - x) % 4096] + swell[x] + swell[y];
    map.samples = heights.data();
    const horizon_map out{.values = slopes, .extent = extent, .bearings = 1};
    peak memory;
    bake_options options;
    options.memory = &memory;
    bake(method::cascade, map, directions, out, options);
    CHECK(memory.most == scratch);
    CHECK(memory.out == 0);
    std::size_t wrong = 0;
    for (const float s : slopes) wrong += std::isfinite(s) && s >= 0.0f ? 0 : 1;
    CHECK(wrong == 0);
    const difference d = from_exact(map, directions, out, 300);
    MESSAGE("mean ", d.mean, ", 99 % ", d.percentile_99, " degrees");
    CHECK(d.mean <= 0.5);
    CHECK(d.percentile_99 <= 5.0);
}
