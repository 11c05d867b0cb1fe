#include <bumpshadow/plan.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/measure/mismatch.hpp>
#include <bumpshadow/measure/sample.hpp>

#include "plan/maps.hpp"
#include "support/counting.hpp"

using namespace bumpshadow;
using namespace plans;

// ---- What is predicted ----

namespace {

// Means of squares, as reduced_heights has them; the extent is a multiple of the side.
shapes::field<float> averaged(const shapes::field<float>& from, int side) {
    return shapes::sampled<float>(from.extent / side, [&](double x, double y) {
        double sum = 0.0;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) sum += double(from.at(int(x) * side + i, int(y) * side + j));
        return sum / (side * side);
    });
}

// Bakes what a recipe says, all of it, and asks texels all over the map.
mismatch_figures measured(const shapes::field<float>& heights, const recipe& r, const light_grid& grid) {
    const shapes::field<float> baked = averaged(heights, r.reduced_heights);
    auto map = baked.view();
    map.texel_size *= double(r.reduced_heights);
    CHECK(map.extent == baked_extent(r, heights.extent));
    std::vector<glm::dvec2> directions(static_cast<std::size_t>(r.directions));
    fill_directions(r, directions);
    std::vector<float> values(required_size(map.extent, r.directions)), less;
    horizon_map slopes{.values = values, .extent = map.extent, .bearings = r.directions};
    REQUIRE(bake_cascade(map, directions, slopes, {.steps = r.steps, .radius = r.radius}));
    if (r.reduction > 1) {
        horizon_map smaller = slopes;
        smaller.extent = reduced_extent(map.extent, r.reduction);
        less.resize(required_size(smaller.extent, r.directions));
        smaller.values = less;
        REQUIRE(reduce(slopes, r.encoding.scale, smaller));
        slopes = smaller;
    }
    const texture_layout layout = layout_of(r, heights.extent);
    std::vector<std::byte> bytes(layout.required_size());
    CHECK(double(bytes.size()) == doctest::Approx(r.predicted.bytes * heights.extent.x * heights.extent.y));
    pack_options options;
    options.fit = r.fit;
    const status packed = pack_tangent_volume(slopes, directions, r.encoding, options, texture{bytes, layout});
    REQUIRE_MESSAGE(bool(packed), packed.message().c_str());

    std::vector<glm::ivec2> texels(600);
    REQUIRE(sample_texels(heights.extent, 4711, texels));
    std::vector<float> exact(texels.size() * grid.directions.size());
    REQUIRE(sample_horizons(heights.view(), texels, grid.directions, exact));
    mismatch_figures found;
    REQUIRE(shadow_mismatch(texels, grid, exact, r.encoding, const_texture{bytes, layout}, sampler{}, heights.extent,
                            found));
    return found;
}

}  // namespace

TEST_CASE("the predicted error is the measured one") {
    struct path {
        double first, last, lowest, highest, mismatch;
    };
    const shapes::field<float> maps[] = {hills(128), heap(), studs()};
    for (const path& p :
         {path{0.0, 1.0, 5.0, 90.0, 0.015}, {0.25, 0.75, 5.0, 60.0, 0.03}, {0.39, 0.39, 25.0, 25.0, 0.02}})
        for (const auto& map : maps) {
            const lights one = {light_at(p.first, p.lowest)};
            scene s = with_arc({p.first, p.last, p.lowest, p.highest}, p.mismatch);
            if (p.first == p.last) s = with_lights(one), s.mismatch = p.mismatch;
            const recipe r = planned(map.view(), s);
            if (!r.shadows) continue;
            std::vector<glm::dvec2> directions;
            std::vector<double> elevations;
            const int sides = p.first == p.last ? 1 : 24, levels = p.first == p.last ? 1 : 8;
            for (int i = 0; i < sides; ++i)
                directions.push_back(shapes::direction(p.first + (p.last - p.first) * (i + 0.5) / sides));
            for (int i = 0; i < levels; ++i)
                elevations.push_back(p.lowest + (p.highest - p.lowest) * (i + 0.5) / levels);
            const mismatch_figures found = measured(map, r, {directions, elevations});
            const double apart = std::abs(found.share - r.predicted.mismatch),
                         bearable = std::max(0.2 * found.share, 0.001) + found.interval + r.predicted.interval;
            CHECK_MESSAGE(apart <= bearable, found.share << " +- " << found.interval << ", predicted "
                                                         << r.predicted.mismatch << " +- " << r.predicted.interval);
            CHECK(found.share <= 1.1 * p.mismatch + found.interval);
        }
}

// ---- The call ----

namespace {

// All that is not a time.
bool is_same(const recipe& a, const recipe& b) {
    const slice_set &s = a.encoding.slices, &t = b.encoding.slices;
    const plan_figures &p = a.predicted, &q = b.predicted;
    return a.shadows == b.shadows && a.obstacle == b.obstacle && a.steps == b.steps && a.radius == b.radius &&
           a.reduced_heights == b.reduced_heights && a.directions == b.directions && a.reduction == b.reduction &&
           s.count == t.count && s.phase == t.phase && s.function == t.function && s.arc == t.arc &&
           a.encoding.format == b.encoding.format && a.encoding.kind == b.encoding.kind &&
           a.encoding.scale.max_slope == b.encoding.scale.max_slope && a.fit == b.fit && a.edge.k == b.edge.k &&
           a.edge.c == b.edge.c && a.taps == b.taps && a.free_tiles == b.free_tiles && p.mismatch == q.mismatch &&
           p.interval == q.interval && p.degrees == q.degrees && p.bytes == q.bytes && p.gpu_cost == q.gpu_cost &&
           p.fetches == q.fetches && a.lines == b.lines &&
           std::equal(a.why.begin(), a.why.begin() + a.lines, b.why.begin(),
                      [](const plan_line& v, const plan_line& w) {
                          return std::string_view(v.text) == std::string_view(w.text);
                      });
}

}  // namespace

TEST_CASE("the same seed, the same recipe") {
    const auto map = heap(64);
    for (const std::uint32_t seed : {1u, 99u}) {
        const scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.02);
        CHECK(is_same(planned(map.view(), s, {.seed = seed}), planned(map.view(), s, {.seed = seed})));
    }
}

TEST_CASE("any unit of length") {
    // By a power of two all is the same but what is a length.
    const auto map = heap(64);
    const auto in_double = shapes::sampled({64, 64}, [&](double x, double y) { return map.at(int(x), int(y)); });
    // Averages of heights are among what is tried for pixels of many texels.
    for (const double texels : {1.0, 8.0}) {
        scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.02);
        s.texels_per_pixel = texels;
        const recipe expected = planned(in_double.view(), s);
        for (const double size : {0x1p400, 0x1p-400}) {
            auto large = in_double;
            for (double& h : large.samples) h *= size;
            auto heights = large.view();
            heights.texel_size *= size;
            recipe r = planned(heights, s);
            r.radius /= size;
            CHECK(r.lines == expected.lines);
            // Which are told with their lengths.
            r.why = expected.why;
            CHECK(is_same(r, expected));
        }
    }
}

TEST_CASE("averaged heights") {
    auto map = shapes::sampled({5, 4}, [](double x, double y) { return 1e100 * (10.0 + x + 4.0 * y); });
    map.at(2, 2) = map.at(3, 2) = map.at(2, 3) = map.at(3, 3) = map.at(0, 2) = -1.0;
    auto heights = map.view(edge_mode::mirror);
    heights.no_data = -1.0;
    heights.height_scale = 3.0;
    heights.texel_size = {2e100, 5e100};
    float samples[4];
    const height_map<float> small = average_heights(heights, 2, samples);
    CHECK(small.extent == glm::ivec2(2, 2));
    CHECK(small.edge == edge_mode::mirror);
    CHECK(small.texel_size == glm::dvec2(4e100, 1e101));
    REQUIRE(small.no_data.has_value());
    // Above the first, of 4 texels (0 + 1 + 4 + 5) / 4 and (2 + 3 + 6 + 7) / 4; of 3 of them (9 + 12 + 13) / 3.
    const double expected[] = {2.5, 4.5, 34.0 / 3.0};
    for (int i = 0; i < 3; ++i)
        CHECK(double(samples[i]) * unit_height(small) == doctest::Approx(3e100 * expected[i]).epsilon(1e-6));
    CHECK(is_no_data(small, samples[3]));
}

TEST_CASE("every sample type") {
    const auto bytes = shapes::sampled<std::uint8_t>(
        {64, 64}, [map = heap(64)](double x, double y) { return std::round(16.0 * double(map.at(int(x), int(y)))); });
    const auto as = [&]<height_sample Sample>(Sample factor, double scale) {
        const auto field = shapes::sampled<Sample>(
            bytes.extent, [&](double x, double y) { return Sample(bytes.at(int(x), int(y)) * factor); });
        auto map = field.view();
        map.height_scale = scale;
        return planned(map, with_arc({0.0, 1.0, 10.0, 60.0}, 0.02));
    };
    // Heights in sixteenths: the largest sample is 255 of them.
    const recipe first = as(std::uint8_t(1), 255.0 / 16.0);
    CHECK(first.obstacle == plan_obstacle::none);
    const recipe all[] = {as(std::uint16_t(257), 255.0 / 16.0), as(1.0f, 1.0 / 16.0), as(1.0 / 16.0, 1.0)};
    for (const recipe& r : all) {
        CHECK(r.encoding.slices.count == first.encoding.slices.count);
        CHECK(r.encoding.format == first.encoding.format);
        CHECK(r.reduction == first.reduction);
        CHECK(r.reduced_heights == first.reduced_heights);
        CHECK(r.directions == first.directions);
        CHECK(r.predicted.mismatch == doctest::Approx(first.predicted.mismatch).epsilon(0.02));
    }
}

TEST_CASE("maps of any extent, with any border") {
    const auto all = heap(128);
    int next = 0;
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {2, 2}, {5, 7}, {13, 13}, {24, 24}, {20, 70}, {1, 50}, {100, 36}})
        for (const double pixel : {1.0, 8.0}) {
            const edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};
            const edge_mode edge = edges[next++ % 4];
            const auto map = shapes::sampled<float>(
                extent, [&](double x, double y) { return 3.0 * double(all.at(int(x), int(y))); });
            scene s = with_arc({0.1, 0.6, 5.0, 60.0}, 0.02);
            s.texels_per_pixel = pixel;
            const recipe r = planned(map.view(edge), s);
            if (!r.shadows) continue;
            CHECK(check(r.encoding));
            // Averaged heights that do not end with the map would shift the texture against it.
            CHECK(extent.x % r.reduced_heights == 0);
            CHECK(extent.y % r.reduced_heights == 0);
            CHECK(r.predicted.mismatch >= 0.0);
            CHECK(r.predicted.mismatch < 0.5);
            const glm::ivec2 stored = layout_of(r, extent).extent;
            CHECK(stored == reduced_extent(extent, r.reduced_heights * r.reduction));
        }
}

TEST_CASE("holes do not shadow") {
    auto map = studs(64);
    // Walls that would shadow everything, all of them holes.
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; x += 8) map.at(x, y) = -100.0f;
    auto heights = map.view();
    heights.no_data = -100.0f;
    const recipe r = planned(heights, with_arc({0.0, 1.0, 5.0, 60.0}, 0.03));
    CHECK(r.shadows);
    CHECK(r.encoding.scale.max_slope < 4.0f);
    for (float& height : map.samples) height = height > 0.0f ? -100.0f : height;
    CHECK(!planned(heights, with_arc({0.0, 1.0, 5.0, 60.0}, 0.03)).shadows);
}

TEST_CASE("memory comes from the resource, goes back, and may run out") {
    const auto map = heap(64);
    const scene s = with_arc({0.0, 0.4, 10.0, 60.0}, 0.02);
    std::pmr::memory_resource* const usual = std::pmr::set_default_resource(std::pmr::null_memory_resource());
    counting all;
    const recipe wanted = planned(map.view(), s, {.memory = &all});
    CHECK(all.out == 0);
    CHECK(all.most < std::size_t{20} << 20);
    for (int fails = 0; fails < all.calls; fails = fails < 3 ? fails + 1 : 2 * fails) {
        counting some(fails);
        recipe r;
        r.directions = -7;
        CHECK(plan(map.view(), s, r, {.memory = &some}).code() == error::out_of_memory);
        CHECK(some.out == 0);
        CHECK(r.directions == -7);
    }
    std::pmr::set_default_resource(usual);
    CHECK(is_same(planned(map.view(), s), wanted));
}
