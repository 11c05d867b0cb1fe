#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/plan.hpp>
#include <bumpshadow/reference/pixel_shadow.hpp>

#include "plan/maps.hpp"

using namespace bumpshadow;
using namespace plans;

// Pixels that cover many texels.

TEST_CASE("places of a pixel: the middles of its parts, row by row") {
    CHECK(tap_offset(0, 1) == glm::vec2(0.0f));
    const glm::vec2 quarters[] = {{-0.25f, -0.25f}, {0.25f, -0.25f}, {-0.25f, 0.25f}, {0.25f, 0.25f}};
    for (int i = 0; i < 4; ++i) CHECK(tap_offset(i, 2) == quarters[i]);
    for (int taps = 1; taps <= 64; ++taps)
        for (int i = 0; i < taps * taps; ++i) {
            const glm::vec2 at = tap_offset(i, taps);
            const int column = i % taps, row = i / taps;
            CHECK(std::abs(double(at.x) - ((column + 0.5) / taps - 0.5)) < 1e-6);
            CHECK(std::abs(double(at.y) - ((row + 0.5) / taps - 0.5)) < 1e-6);
        }
}

TEST_CASE("the factor of a pixel is the mean over its places") {
    // Horizons of 1 in the left half of a texture, of 0 in the right one.
    std::array<std::byte, 64> bytes{};
    for (std::size_t i = 0; i < 64; ++i) bytes[i] = std::byte(i % 8 < 4 ? 255 : 0);
    tangent_volume one;
    one.slices = {1, 0.0, bearing_function::cubic, 0.0};
    one.kind = texture_kind::flat;
    one.scale.max_slope = 2.0f;
    const const_texture from{bytes, layout_of(one, {8, 8})};
    const sampler how{.x = address_mode::clamp, .y = address_mode::clamp};
    const glm::vec3 light(1.0f, 0.0f, 1.0f);
    const auto factor = [&](float x, float side, int taps) {
        return pixel_factor(one, from, how, {x, 0.5f}, {side, side}, taps, light);
    };
    CHECK(factor(0.5f, 0.5f, 2) == 0.5f);
    CHECK(factor(0.5f, 0.5f, 4) == 0.5f);
    // Places at 5, 7, 9 and 11 sixteenths, of which the first is in shadow; at the second one light is let through.
    CHECK(factor(0.5f, 0.5f, 3) == doctest::Approx(2.0 / 3.0));
    CHECK(factor(0.625f, 0.5f, 4) == 0.75f);
    CHECK(factor(0.875f, 0.25f, 4) == 1.0f);
    CHECK(factor(0.125f, 0.25f, 4) == 0.0f);
    for (const float x : {0.1f, 0.45f, 0.55f, 0.8f})
        CHECK(factor(x, 0.3f, 1) == shadow_factor(one, from, how, {x, 0.5f}, light));
}

// What a trial reads is what the reference reads from the same bytes.
TEST_CASE("a trial reads a texture as the reference does") {
    const auto map = heap(64);
    std::vector<glm::dvec2> directions(24);
    for (const double arc : {1.0, 0.4})
        for (const texture_kind kind : {texture_kind::volume, texture_kind::array, texture_kind::flat})
            for (const texel_format format : {texel_format::r8, texel_format::bc4})
                for (const bool repeats : {false, true}) {
                    tangent_volume e;
                    const int count = kind == texture_kind::flat ? 1 : 6;
                    e.slices = {count, 0.1, bearing_function::octant, arc};
                    e.kind = kind;
                    e.format = format;
                    slice_set all = e.slices;
                    all.count = int(directions.size());
                    fill_directions(directions, all);
                    std::vector<float> values(required_size(map.extent, 24));
                    const horizon_map slopes{.values = values, .extent = map.extent, .bearings = 24};
                    REQUIRE(bake_cascade(map.view(), directions, slopes));
                    const texture_layout layout = layout_of(e, map.extent);
                    std::vector<std::byte> bytes(layout.required_size());
                    REQUIRE(pack_tangent_volume(slopes, directions, e, {}, texture{bytes, layout}));
                    const const_texture from{bytes, layout};
                    std::vector<float> numbers;
                    for (int slice = 0; slice < count; ++slice)
                        for (int y = 0; y < 64; ++y)
                            for (int x = 0; x < 64; ++x) {
                                const bool volume = kind == texture_kind::volume;
                                numbers.push_back(
                                    fetch(from, {x, y, volume ? slice : 0}, 0, kind == texture_kind::array ? slice : 0)
                                        .x);
                            }
                    // The texture is that of a map reduced by 2, in one patch.
                    const plan_detail::unpacked tried{
                        e, from, numbers.data(), {glm::ivec2(0), map.extent}, glm::bvec2(repeats), 2, 8};
                    const address_mode border = repeats ? address_mode::repeat : address_mode::clamp;
                    const sampler how{.x = border, .y = border};
                    shapes::noise random(3);
                    for (int i = 0; i < 200; ++i) {
                        plan_detail::look l{};
                        l.place = glm::vec2(random.uniform(), random.uniform()) * 128.0f;
                        l.direction = glm::vec2(shapes::direction(0.1 + arc * random.uniform()));
                        std::array<float, 16> found{};
                        tried.read(l, 4, found.data());
                        for (int t = 0; t < 16; ++t) {
                            const glm::vec2 uv = (l.place + 8.0f * tap_offset(t, 4)) / 128.0f;
                            const float wanted = horizon(e, from, how, uv, {l.direction.x, l.direction.y, 1.0f});
                            CHECK(std::abs(found[std::size_t(t)] - wanted) < 2e-5f);
                        }
                    }
                }
}

namespace {

struct measured {
    double mean = 0.0, interval = 0.0;
};

// Pixels anywhere on the map: the share of their texels that exact horizons leave lit, beside the factor that the
// recipe gives.
measured error_of(const shapes::field<float>& map, const recipe& r, int pixel, double lowest, double highest) {
    REQUIRE(r.reduced_heights == 1);
    std::vector<glm::dvec2> directions(static_cast<std::size_t>(r.directions));
    fill_directions(r, directions);
    std::vector<float> values(required_size(map.extent, r.directions));
    const horizon_map slopes{.values = values, .extent = map.extent, .bearings = r.directions};
    REQUIRE(bake_cascade(map.view(), directions, slopes, {.steps = r.steps, .radius = r.radius}));
    const texture_layout layout = layout_of(r, map.extent);
    std::vector<float> less(required_size(layout.extent, r.directions));
    const horizon_map smaller{.values = less, .extent = layout.extent, .bearings = r.directions};
    REQUIRE(reduce(slopes, r.encoding.scale, smaller));
    std::vector<std::byte> bytes(layout.required_size());
    pack_options options;
    options.fit = r.fit;
    REQUIRE(pack_tangent_volume(smaller, directions, r.encoding, options, texture{bytes, layout}));

    constexpr int pixels = 250;
    shapes::noise random(17);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < pixels; ++i) {
        const glm::ivec2 corner(int(random.uniform() * map.extent.x), int(random.uniform() * map.extent.y));
        const glm::dvec2 way = shapes::direction(random.uniform());
        const double slope = std::tan((lowest + (highest - lowest) * random.uniform()) * degree);
        int lit = 0;
        for (int y = 0; y < pixel; ++y)
            for (int x = 0; x < pixel; ++x) {
                const glm::ivec2 texel = (corner + glm::ivec2(x, y)) % map.extent;
                lit += exact_horizon(map.view(), texel, way, std::numeric_limits<double>::infinity()).slope <= slope;
            }
        const glm::vec2 middle = glm::vec2(corner) + 0.5f * float(pixel), whole(map.extent);
        const float found = pixel_factor(r.encoding, const_texture{bytes, layout}, {}, middle / whole,
                                         float(pixel) / whole, r.taps, glm::vec3(way, slope), r.edge);
        const double wrong = std::abs(double(found) - double(lit) / (pixel * pixel));
        sum += wrong;
        squares += wrong * wrong;
    }
    const double mean = sum / pixels;
    return {mean, 2.0 * std::sqrt((squares / pixels - mean * mean) / pixels)};
}

}  // namespace

TEST_CASE("a distant view: the share of a pixel that is lit, as predicted") {
    const auto map = heap(96);
    for (const int pixel : {4, 8}) {
        scene s = with_arc({0.0, 1.0, 10.0, 60.0}, 0.04);
        s.texels_per_pixel = pixel;
        // What is averaged before the bake is tested elsewhere.
        recipe r = planned(map.view(), s);
        CHECK(r.obstacle == plan_obstacle::none);
        CHECK(r.edge.c == 0.5f);
        CHECK(r.predicted.fetches == r.taps * r.taps);
        if (r.reduced_heights > 1) {
            r.reduction *= r.reduced_heights;
            r.reduced_heights = 1;
        }
        const measured found = error_of(map, r, pixel, 10.0, 60.0);
        CHECK_MESSAGE(found.mean <= 1.1 * s.mismatch + found.interval,
                      pixel << " texels: " << found.mean << " +- " << found.interval);
        CHECK_MESSAGE(
            std::abs(found.mean - r.predicted.mismatch) <= 0.2 * found.mean + found.interval + r.predicted.interval,
            pixel << " texels: " << found.mean << " +- " << found.interval << ", predicted " << r.predicted.mismatch);
    }
}

TEST_CASE("fewer places where the shader may not cost as much") {
    const auto map = heap(96);
    scene s = with_arc({0.0, 1.0, 5.0, 90.0}, 0.03);
    s.texels_per_pixel = 8.0;
    const recipe free = planned(map.view(), s);
    REQUIRE(free.taps > 1);
    s.gpu_cost = 0.5 * free.predicted.gpu_cost;
    const recipe poor = planned(map.view(), s);
    CHECK(poor.taps < free.taps);
    CHECK(poor.predicted.gpu_cost <= s.gpu_cost);
}
