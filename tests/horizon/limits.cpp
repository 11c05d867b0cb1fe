// Every method at the ends of what it takes: units, sides of texels, relief, extents, sizes of scratch.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/flip.hpp>
#include <bumpshadow/measure/sample.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_int = std::numeric_limits<int>::max();
constexpr edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};
constexpr float unwritten = -7e9f;
using list = std::vector<glm::dvec2>;
using slopes = std::vector<float>;

// Methods by number, 0 is exact.
enum { exact, cascade, fine, sweep, sweep_classic, neighborhood, methods };
constexpr const char* names[methods] = {"exact", "cascade",       "cascade, 48 steps",
                                        "sweep", "sweep-classic", "neighborhood"};

template <height_sample Sample>
status bake(int method, const height_map<Sample>& heights, const list& directions, slopes& values,
            bake_options options = {}) {
    values.assign(required_size(heights.extent, int(directions.size())), unwritten);
    const horizon_map out{.values = values, .extent = heights.extent, .bearings = int(directions.size())};
    if (method == fine) options.steps = 48;
    return method == exact           ? bake_exact(heights, directions, out, options)
           : method == sweep         ? bake_sweep(heights, directions, out, options)
           : method == sweep_classic ? bake_sweep_classic(heights, directions, out, options)
           : method == neighborhood  ? bake_neighborhood(heights, directions, out, options)
                                     : bake_cascade(heights, directions, out, options);
}

bool is_untouched(const slopes& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v == unwritten; });
}
bool are_finite(const slopes& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return is_finite(v) && v != unwritten; });
}

template <height_sample Sample>
void refused_by_all(const height_map<Sample>& heights, const std::string& text) {
    slopes values;
    for (int m = 0; m < methods; ++m) {
        const status s = bake(m, heights, {{1.0, 0.3}}, values);
        CHECK_MESSAGE(s.message().c_str() == text, names[m]);
        CHECK(s.code() == error::out_of_range);
        CHECK(is_untouched(values));
    }
}

// Errors of elevation in degrees, each direction's slopes divided by the steepest of it where that is above 1, so that
// neither steep directions nor gentle ones hide the others. Without the border of open maps: whether a ray that hardly
// leaves its row is on the map or outside it is up to rounding there.
struct difference {
    double mean = 0.0, percentile_99 = 0.0;
};
difference between(const slopes& found, const slopes& truth, glm::ivec2 extent, edge_mode edge) {
    std::vector<double> errors;
    const int margin = edge == edge_mode::open ? 1 : 0;
    const std::size_t texels = required_size(extent, 1);
    for (std::size_t first = 0; first < truth.size(); first += texels) {
        const auto each = [&](auto visit) {
            for (int y = margin; y < extent.y - margin; ++y)
                for (int x = margin; x < extent.x - margin; ++x) visit(first + std::size_t(y * extent.x + x));
        };
        double unit = 1.0;
        each([&](std::size_t i) { unit = std::max(unit, std::abs(double(truth[i]))); });
        each([&](std::size_t i) {
            const double a = std::atan(double(found[i]) / unit), b = std::atan(double(truth[i]) / unit);
            errors.push_back(std::abs(a - b) * 180.0 / std::numbers::pi);
        });
    }
    difference d;
    for (const double e : errors) d.mean += e / double(errors.size());
    std::sort(errors.begin(), errors.end());
    d.percentile_99 = errors[errors.size() * 99 / 100];
    return d;
}

}  // namespace

TEST_CASE("heights and texels from 10^-30 to 10^30: what is not refused is finite and as good as promised") {
    constexpr glm::ivec2 extent{37, 29};
    constexpr difference promised[methods] = {{}, {0.5, 5.0}, {0.15, 2.0}, {0.15, 2.0}, {180.0, 180.0}, {180.0, 180.0}};
    // Tiles; as smooth as what the promise is checked on for a single unit.
    const auto map = shapes::sampled<float>(extent, [&](double x, double y) {
        const double u = 2.0 * std::numbers::pi * x / extent.x, v = 2.0 * std::numbers::pi * y / extent.y;
        return 2.0 * std::sin(u) + 3.0 * std::cos(v + u) + std::sin(2.0 * u - v);
    });
    const auto [low, high] = std::minmax_element(map.samples.begin(), map.samples.end());
    const double relief = double(*high) - double(*low), above = double(*high) - double(map.samples[0]),
                 below = double(map.samples[0]) - double(*low);
    const list directions = shapes::directions(5, 0.03);
    slopes truth, found;
    for (const int height : {-30, 0, 10, 20, 30})
        for (const int x : {-30, -20, 0, 30})
            for (const int y : {-30, -20, 0, 30})
                for (const edge_mode edge : edges) {
                    height_map<float> heights = map.view(edge);
                    heights.height_scale = std::pow(10.0, height);
                    heights.texel_size = {std::pow(10.0, x), std::pow(10.0, y)};
                    const double side = std::pow(10.0, std::min(x, y)), steep = heights.height_scale / side;
                    CAPTURE(height);
                    CAPTURE(x);
                    CAPTURE(y);
                    CAPTURE(int(edge));
                    for (int m = 0; m < methods; ++m) {
                        CAPTURE(std::string(names[m]));
                        const status s = bake(m, heights, directions, m == exact ? truth : found);
                        const double deepest = (m == cascade || m == fine) && edge == edge_mode::open ? 5e19 : 1e35;
                        const bool too_high =
                            m == exact ? relief * steep > 1e38 : above * steep > 1e35 || below * steep > deepest;
                        CHECK(bool(s) == !too_high);
                        if (!s) {
                            CHECK(s.code() == error::out_of_range);
                            CHECK(is_untouched(m == exact ? truth : found));
                            continue;
                        }
                        CHECK(are_finite(m == exact ? truth : found));
                        if (m == exact) continue;
                        const difference d = between(found, truth, extent, edge);
                        CHECK(d.mean <= promised[m].mean);
                        // The lines beside a texel leave an open map before its own ray does, which counts on a small
                        // one: 2.3 degrees with the plainest of units, too.
                        const double most = m == sweep && edge == edge_mode::open ? 3.0 : promised[m].percentile_99;
                        CHECK(d.percentile_99 <= most);
                    }
                }
}

TEST_CASE("a plane under texels of any shape") {
    // Rises by 0.5 along one axis: by 0.5 cos in any other direction.
    for (const double ratio : {1e3, 1e12, 1e15, 1e19, 1e30, 1e60, 1e200})
        for (const bool along_y : {false, true}) {
            const auto map = shapes::sampled<float>({12, 12}, [&](double x, double y) { return along_y ? y : x; });
            height_map<float> heights = map.view(edge_mode::open);
            heights.height_scale = 0.5 / std::sqrt(ratio);
            heights.texel_size = {1.0 / std::sqrt(ratio), std::sqrt(ratio)};
            if (along_y) std::swap(heights.texel_size.x, heights.texel_size.y);
            list directions = {{1.0, 0.0}, {1.0, 0.3}, {1.0, -3.0}, {1e-3, 1.0}, {1e-5, -1.0}, {1e-10, 1.0}};
            list expected_of = directions;
            if (along_y)
                for (glm::dvec2& d : directions) std::swap(d.x, d.y);
            for (const int m : {exact, cascade, sweep, sweep_classic}) {
                slopes values;
                REQUIRE(bake(m, heights, directions, values));
                for (std::size_t i = 0; i < directions.size(); ++i) {
                    CAPTURE(std::string(names[m]));
                    CAPTURE(ratio);
                    CAPTURE(along_y);
                    CAPTURE(i);
                    const glm::dvec2 d = expected_of[i];
                    const double expected = 0.5 * d.x / std::hypot(d.x, d.y), found = double(values[i * 144 + 66]);
                    CHECK(std::abs(found - expected) <= 1e-6 * expected + 1e-9);
                }
            }
        }
}

TEST_CASE("lengths beyond the stated range are refused") {
    const double sample[4] = {};
    const auto refused = [&](const char* text, auto change) {
        height_map<double> heights = tight_height_map(sample, {2, 2});
        change(heights);
        refused_by_all(heights, text);
    };
    refused("texel_size.x is 1e-310, which is out of range (limit 1e-150)", [](auto& h) {
        h.texel_size = {1e-310, 1e-310};
    });
    refused("texel_size.y is 9e-151, which is out of range (limit 1e-150)", [](auto& h) { h.texel_size.y = 9e-151; });
    refused("texel_size.x is 2e+150, which is out of range (limit 1e+150)", [](auto& h) { h.texel_size.x = 2e150; });
    refused("texel_size.y is 1e+300, which is out of range (limit 1e+150)", [](auto& h) { h.texel_size.y = 1e300; });
    refused("height_scale is 1e+151, which is out of range (limit 1e+150)", [](auto& h) { h.height_scale = 1e151; });
    refused("height_scale is -1e+151, which is out of range (limit 1e+150)", [](auto& h) { h.height_scale = -1e151; });
}

TEST_CASE("sides beyond the stated range are refused") {
    const double sample = 0.0;
    for (const int side : {largest_side + 1, most_int}) {
        for (const glm::ivec2 extent : {glm::ivec2(side, 1), {1, side}}) {
            const status s = check(tight_height_map(&sample, extent));
            CHECK(s.code() == error::out_of_range);
            CHECK(std::string(s.argument()) == (extent.x == side ? "heights.extent.x" : "heights.extent.y"));
            CHECK(s.value() == double(side));
            CHECK(s.limit() == 1073741824.0);
        }
    }
    CHECK(check(tight_height_map(&sample, {largest_side, largest_side})));
}

TEST_CASE("samples beyond the stated range are refused") {
    constexpr double lowest = std::numeric_limits<double>::lowest();
    auto map = shapes::sampled({6, 5}, shapes::plane(3.0));
    map.at(4, 2) = -1.5e300;
    refused_by_all(map.view(), "sample is -1.5e+300, which is out of range (limit 1e+300)");
    CHECK(check_samples(map.view()).texel() == glm::ivec2(4, 2));
    // Unless they mark holes.
    map.at(4, 2) = lowest;
    height_map<double> heights = map.view();
    heights.no_data = lowest;
    slopes values;
    for (int m = 0; m < methods; ++m) {
        CHECK(bake(m, heights, {{1.0, 0.3}}, values));
        CHECK(are_finite(values));
        CHECK(std::count(values.begin(), values.end(), no_horizon) == 1);
    }
}

TEST_CASE("the ends of the range of lengths are as good as its middle") {
    // All by a power of two: the same slopes, bit for bit.
    const auto unit = shapes::sampled({19, 14}, shapes::waves({19, 14}));
    const list directions = shapes::directions(5, 0.03);
    slopes truth, found;
    for (const double size : {0x1p498, 0x1p-498})
        for (const edge_mode edge : edges)
            for (int m = 0; m < methods; ++m) {
                CAPTURE(size);
                CAPTURE(std::string(names[m]));
                REQUIRE(bake(m, unit.view(edge), directions, truth));
                height_map<double> heights = unit.view(edge);
                heights.texel_size *= size;
                heights.height_scale *= size;
                REQUIRE(bake(m, heights, directions, found));
                CHECK(found == truth);
                // The same size by the samples.
                auto large = unit;
                for (double& h : large.samples) h *= size;
                heights = large.view(edge);
                heights.texel_size *= size;
                REQUIRE(bake(m, heights, directions, found));
                CHECK(found == truth);
            }
    // Flat ones, wherever they lie.
    for (const double height : {1e300, -1e300})
        for (const double scale : {1e150, -1e150, 1e-150, 0.0})
            for (const double size : {1e150, 1e-150})
                for (int m = 0; m < methods; ++m) {
                    const auto flat = shapes::sampled({5, 4}, shapes::plane(height));
                    height_map<double> heights = flat.view();
                    heights.height_scale = scale;
                    heights.texel_size = {size, 1.0 / size};
                    REQUIRE(bake(m, heights, directions, found));
                    CHECK(std::count(found.begin(), found.end(), 0.0f) == std::ptrdiff_t(found.size()));
                }
    // And all of the range that samples have, where the scale is 0.
    auto map = shapes::sampled({5, 4}, shapes::plane(1e300));
    map.at(2, 2) = -1e300;
    height_map<double> heights = map.view();
    heights.height_scale = 0.0;
    for (int m = 0; m < methods; ++m) {
        REQUIRE(bake(m, heights, directions, found));
        CHECK(std::count(found.begin(), found.end(), 0.0f) == std::ptrdiff_t(found.size()));
    }
}

TEST_CASE("relief that floats cannot hold is refused") {
    auto map = shapes::sampled({8, 6}, shapes::plane(0.0));
    slopes values;
    const auto text = [&](int m, double height, double scale, glm::dvec2 texel_size) {
        map.at(4, 3) = height;
        height_map<double> heights = map.view();
        heights.height_scale = scale;
        heights.texel_size = texel_size;
        const status s = bake(m, heights, {{1.0, 0.0}, {1.0, 1.0}}, values);
        CHECK((s ? are_finite(values) : is_untouched(values)));
        return std::string(s.message().c_str());
    };
    for (const int m : {cascade, fine, sweep, sweep_classic, neighborhood}) {
        CAPTURE(std::string(names[m]));
        const std::string highest = "highest height above reference_texel(), in texels is ",
                          lowest = "lowest height above reference_texel(), in texels is ";
        CHECK(text(m, 0x1p117, 1.0, {1.0, 1.0}) ==
              highest + "1.66153499e+35, which is out of range (limit 1.00000004e+35)");
        CHECK(text(m, 0x1p117, -1.0, {1.0, 1.0}) ==
              lowest + "-1.66153499e+35, which is out of range (limit -1.00000004e+35)");
        CHECK(text(m, 1e40, 1.0, {1.0, 1e30}) == highest + "inf, which is out of range (limit 1.00000004e+35)");
        CHECK(text(m, -1e300, 1e150, {1e-150, 1e150}) ==
              lowest + "-inf, which is out of range (limit -1.00000004e+35)");
        for (const double height : {9e34, -9e34}) CHECK(text(m, height, 1e10, {1e10, 1e10}) == "ok");
    }
    CHECK(text(exact, 2e38, 1.0, {1.0, 1.0}) ==
          "range of heights, in texels is 2e+38, which is out of range (limit 1e+38)");
    CHECK(text(exact, -2e38, -1.0, {5.0, 1.0}) ==
          "range of heights, in texels is 2e+38, which is out of range (limit 1e+38)");
    CHECK(text(exact, 1e300, 1e150, {1e-150, 1e150}) ==
          "range of heights, in texels is inf, which is out of range (limit 1e+38)");
    for (const double height : {1e38, -1e38}) CHECK(text(exact, height, 1.0, {1.0, 1.0}) == "ok");
    // Beside the pit of that depth: down and up again, one texel away.
    CHECK(values[3 * 8 + 3] == 0.0f);
    CHECK(values[3 * 8 + 4] == 1e38f);
    // A hollow base, as hollow as allowed, adds to the slopes.
    height_map<double> heights = map.view(edge_mode::open);
    const bake_options hollow{.radius = 4.0, .curvature = glm::dvec2(-8.5e37)};
    REQUIRE(bake(exact, heights, {{1.0, 0.0}, {1.0, 1.0}}, values, hollow));
    CHECK(are_finite(values));

    const glm::ivec2 texel(0, 0);
    const glm::dvec2 direction(1.0, 0.0);
    float slope = unwritten;
    map.at(4, 3) = 2e38;
    const status s = sample_horizons(map.view(), std::span(&texel, 1), std::span(&direction, 1), std::span(&slope, 1));
    CHECK(std::string(s.message().c_str()) ==
          "range of heights, in texels is 2e+38, which is out of range (limit 1e+38)");
    CHECK(slope == unwritten);
}

TEST_CASE("sizes of scratch for any extent, texel size and option") {
    const float sample = 0.0f;
    const glm::dvec2 direction(1.0, 0.3);
    const std::span<const glm::dvec2> directions(&direction, 1);
    const auto sizes = [&](const height_map<float>& h, const bake_options& options = {}) {
        return std::vector<std::size_t>{
            exact_scratch_size(h),
            sample_scratch_size(h),
            cascade_scratch_size(h, options),
            cascade_scratch_size(h, options, most_int),
            sweep_scratch_size(h, directions),
            sweep_classic_scratch_size(h, directions),
            neighborhood_scratch_size(h, directions, options),
        };
    };
    const std::vector<std::size_t> none(7, 0);
    for (const glm::ivec2 extent : {glm::ivec2(0, 0), {0, 5}, {5, 0}, {-3, 4}, {-most_int - 1, 7}}) {
        CHECK(sizes(tight_height_map(&sample, extent)) == none);
        CHECK(height_bounds<float>::required_size(extent) == 0);
        CHECK(flip_scratch_size(extent) == 0);
    }
    for (const glm::ivec2 extent : {glm::ivec2(most_int, 1), {1, most_int}, {most_int, most_int}})
        CHECK(sizes(tight_height_map(&sample, extent)) == none);
    height_map<float> heights = tight_height_map(&sample, {5, 4});
    for (const double size : {0.0, -1.0, std::nan(""), infinity, 1e-310, 1e300})
        for (int i = 0; i < 2; ++i) {
            heights.texel_size = glm::dvec2(1.0);
            heights.texel_size[i] = size;
            CHECK(sizes(heights) == none);
        }

    // One texel needs one bound of 4 bytes, aligned, wherever the block begins.
    const height_map<float> one = tight_height_map(&sample, {1, 1});
    CHECK(height_bounds<float>::required_size({1, 1}) == 1);
    CHECK(exact_scratch_size(one) == 2 * scratch_alignment);
    CHECK(flip_scratch_size({1, 1}) > 0);
    CHECK(elevation_scratch_size(0, 0) == scratch_alignment);
    CHECK(elevation_scratch_size(1, 1) == 2 * scratch_alignment);
    // And what is asked for is enough.
    slopes value;
    std::vector<std::byte> memory;
    for (int m = 0; m < methods; ++m) {
        const std::vector<std::size_t> of_one = sizes(one, {.steps = m == fine ? 48 : 12});
        const std::size_t which[methods] = {0, 2, 2, 4, 5, 6};
        memory.assign(of_one[which[m]], std::byte(0));
        REQUIRE(bake(m, one, {{1.0, 0.3}}, value, {.scratch = memory}));
        CHECK(value[0] == 0.0f);
    }

    // Halved until one block is left: 2^27 + 2^26 + ... + 1 blocks of 8 texels.
    CHECK(height_bounds<float>::required_size({largest_side, 1}) == (std::size_t(1) << 28) - 1);
    CHECK(height_bounds<float>::required_size({most_int, 1}) == (std::size_t(1) << 29) - 1);
    // At least the samples, and not the 2^64 that a wrapped sum gives.
    for (const glm::ivec2 extent : {glm::ivec2(largest_side, 1), {1, largest_side}}) {
        const height_map<float> large = tight_height_map(&sample, extent);
        for (const std::size_t size : sizes(large)) CHECK(size < std::size_t(1) << 50);
        for (const std::size_t size : {cascade_scratch_size(large), sweep_scratch_size(large, directions)})
            CHECK(size > std::size_t(4) << 30);
    }
    // No more bands than run at a time.
    CHECK(flip_scratch_size({1, most_int}, {}, 4) == flip_scratch_size({1, 256}, {}, 4));

    heights.texel_size = glm::dvec2(1.0);
    for (const auto& [wrong, right] : {std::pair(0, 1), {-1, 1}, {-most_int - 1, 1}, {65537, 65536}, {most_int, 65536}})
        CHECK(cascade_scratch_size(heights, {.steps = wrong}) == cascade_scratch_size(heights, {.steps = right}));
    // No neighbors.
    for (const double radius : {0.0, -1.0, 1e-300})
        CHECK(neighborhood_scratch_size(heights, directions, {.radius = radius}) ==
              neighborhood_scratch_size(heights, directions, {.radius = 0.5}));
    CHECK(neighborhood_scratch_size(heights, directions, {.radius = std::nan("")}) > 0);
}

TEST_CASE("what a change influences, for any option") {
    const auto map = shapes::sampled<float>({200, 200}, shapes::waves({200, 200}));
    const rectangle changed{{100, 100}, {1, 1}}, all{{0, 0}, {200, 200}};
    const auto of = [&](const bake_options& options, edge_mode edge = edge_mode::clamp) {
        const rectangle r = influence(map.view(edge), changed, options);
        return std::vector<int>{r.origin.x, r.origin.y, r.extent.x, r.extent.y};
    };
    const std::vector<int> whole{0, 0, 200, 200};
    for (const auto& [wrong, right] : {std::pair(0, 1), {-1, 1}, {-most_int - 1, 1}, {65537, 65536}, {most_int, 65536}})
        CHECK(of({.steps = wrong, .radius = 3.0}) == of({.steps = right, .radius = 3.0}));
    CHECK(of({.steps = 1, .radius = 3.0}) != whole);
    for (const double radius : {0.0, -1.0, std::nan(""), infinity, 1e300})
        for (const edge_mode edge : edges) CHECK(of({.radius = radius}, edge) == whole);
    height_map<float> heights = map.view();
    heights.texel_size.x = std::nan("");
    CHECK(influence(heights, changed, {.radius = 3.0}).extent == all.extent);
    heights.extent = {-3, 4};
    CHECK(influence(heights, changed, {.radius = 3.0}).empty());
}

TEST_CASE("a sample of texels of the largest extents") {
    for (const glm::ivec2 extent : {glm::ivec2(most_int, 3), {3, most_int}, {most_int, most_int}})
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            std::vector<glm::ivec2> texels(300);
            REQUIRE(sample_texels(extent, seed, texels));
            for (const glm::ivec2 t : texels) {
                CHECK(t.x >= 0);
                CHECK(t.y >= 0);
                CHECK(t.x < extent.x);
                CHECK(t.y < extent.y);
            }
            std::sort(texels.begin(), texels.end(),
                      [](glm::ivec2 a, glm::ivec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
            CHECK(std::adjacent_find(texels.begin(), texels.end()) == texels.end());
        }
}
