// Slices over an arc of bearings as a GPU shows them: light within and beyond it, one slice for a fixed light, whole
// pictures, and against as many slices around the whole turn.

#include <bumpshadow/reference/shadow.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <doctest/doctest.h>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/measure/mismatch.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/reference/shade.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr glm::ivec2 extent(64, 48);
constexpr double degree = std::numbers::pi / 180.0;

// Towards a light, azimuth in turns, elevation in degrees.
glm::vec3 toward(double turns, double elevation) {
    const double a = turns * 2 * std::numbers::pi, e = elevation * degree;
    return glm::vec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
}

// Cut domes with joints between them; tiles.
const shapes::field<float>& stones() {
    static const shapes::field<float> field = [] {
        shapes::noise noise(3);
        std::vector<glm::dvec3> centers(26);  // and radius
        for (glm::dvec3& c : centers)
            c = {noise.uniform() * extent.x, noise.uniform() * extent.y, 5.0 + 7.0 * noise.uniform()};
        return shapes::sampled<float>(extent, [&](double x, double y) {
            double height = 0.0;
            for (const glm::dvec3& c : centers) {
                const double dx = std::remainder(x - c.x, extent.x), dy = std::remainder(y - c.y, extent.y);
                const double square = c.z * c.z - dx * dx - dy * dy;
                if (square > 0.0) height = std::max(height, std::min(std::sqrt(square), 0.7 * c.z));
            }
            return height;
        });
    }();
    return field;
}

struct horizons {
    std::vector<glm::dvec2> directions;
    std::vector<float> values;
    horizon_map map;

    explicit horizons(std::vector<glm::dvec2> towards)
        : directions(std::move(towards)),
          values(required_size(extent, int(directions.size()))),
          map{values, extent, int(directions.size())} {
        REQUIRE(bool(bake_cascade(stones().view(), directions, map)));
    }
};

struct stored {
    std::vector<std::byte> bytes;
    texture_layout layout;

    stored(const horizons& h, const tangent_volume& e, slice_fit fit = slice_fit::least_squares)
        : bytes(layout_of(e, extent).required_size()), layout(layout_of(e, extent)) {
        REQUIRE(bool(pack_tangent_volume(h.map, h.directions, e, {.fit = fit}, texture{bytes, layout})));
    }
    operator const_texture() const { return {bytes, layout}; }
    // Of a texel's center, by its bytes.
    [[nodiscard]] float value(int slice, int x, int y) const {
        return float(bytes[(std::size_t(slice) * std::size_t(extent.y) + std::size_t(y)) * std::size_t(extent.x) +
                           std::size_t(x)]) /
               255.0f;
    }
};

glm::vec2 center(int x, int y) { return (glm::vec2(x, y) + 0.5f) / glm::vec2(extent); }

constexpr texture_kind kinds[] = {texture_kind::volume, texture_kind::array};

}  // namespace

TEST_CASE("light within an arc is blended between its slices, light beyond takes the nearer end") {
    // From 300 degrees over 0 to 60 degrees: slices at -60, -30, 0, 30, 60.
    const horizons h(shapes::directions(36));
    for (const texture_kind kind : kinds) {
        const tangent_volume e{{5, 300.0 / 360.0, bearing_function::exact, 120.0 / 360.0}, {}, texel_format::r8, kind};
        const stored t(h, e);
        // Azimuth, slice, share of the next one.
        const double by_hand[][3] = {{300, 0, 0},     {307.5, 0, 0.25}, {0, 2, 0},   {-15, 1, 0.5},   {45, 3, 0.5},
                                     {59, 3, 0.9667}, {60, 3, 1},       {90, 3, 1},  {179, 3, 1},     {181, 0, 0},
                                     {240, 0, 0},     {299, 0, 0},      {-70, 0, 0}, {359, 1, 0.9667}};
        for (const auto& [azimuth, slice, part] : by_hand)
            for (int i = 0; i < 40; ++i) {
                const int x = 37 * i % extent.x, y = 11 * i % extent.y;
                const double here = double(t.value(int(slice), x, y)), next = double(t.value(int(slice) + 1, x, y));
                CHECK(double(horizon(e, t, {}, center(x, y), toward(azimuth / 360.0, 20.0))) ==
                      doctest::Approx(here + part * (next - here)).epsilon(1e-4));
            }
    }
}

TEST_CASE("a fixed light: one flat slice shows the shadows that are traced") {
    const double azimuth = 140.0 / 360.0;
    const bearing_function function = bearing_function::cubic;
    const glm::dvec2 way = exact_direction(azimuth);
    horizons h({way});
    REQUIRE(bool(bake_exact(stones().view(), h.directions, h.map)));
    tangent_volume e{{1, to_bearing(function, way), function, 0.0}, {}, texel_format::r8, texture_kind::flat};
    const stored t(h, e);
    CHECK(t.bytes.size() == std::size_t(extent.x) * std::size_t(extent.y));
    int different = 0, shadowed = 0;
    for (const double elevation : {5.0, 20.0, 35.0, 50.0})
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const glm::vec3 light = toward(azimuth, elevation);
                const float slope = h.map.row(0, y)[x], level = std::tan(float(elevation * degree));
                const float found = shadow_factor(e, const_texture(t), {}, center(x, y), light);
                // Half a step of 8 bits, of 4 that stands for 1.
                if (std::abs(slope - level) < 4.0f / 510.0f + 1e-5f) continue;
                different += (found < 0.5f) != (slope > level) ? 1 : 0;
                shadowed += slope > level ? 1 : 0;
            }
    CHECK(different == 0);
    CHECK(shadowed > 500);
    // No bearing counts.
    for (int i = 0; i < 12; ++i)
        CHECK(horizon(e, t, {}, center(3, 4), toward(i / 12.0, 30.0)) == doctest::Approx(double(t.value(0, 3, 4))));
}

namespace {

// The general path of whole pictures: a shadow without rows.
struct without_rows {
    const encoded_shadow<tangent_volume>& shadow;
    float operator()(glm::vec2 uv, glm::vec3 light) const { return shadow(uv, light); }
};

}  // namespace

TEST_CASE("whole pictures over an arc: rows are the same numbers as pixels one by one") {
    const horizons h(shapes::directions(32));
    for (const texture_kind kind : {texture_kind::volume, texture_kind::array, texture_kind::flat})
        for (const filter_weights weights : {filter_weights::exact, filter_weights::eight_bit}) {
            encoded_shadow<tangent_volume> shadow;
            shadow.encoding.slices = {kind == texture_kind::flat ? 1 : 5, 0.25, bearing_function::cubic, 0.5};
            shadow.encoding.kind = kind;
            const stored t(h, shadow.encoding);
            shadow.textures = t;
            shadow.how.weights = weights;
            shadow.edge = {8.0f, 1.0f};
            REQUIRE(bool(shadow.check()));
            for (int i = 0; i < 12; ++i) {
                shade_options o;
                o.light.direction = toward(i / 12.0 - 0.03, 10.0 + 4.0 * i);
                std::vector<float> a(3 * std::size_t(extent.x) * std::size_t(extent.y)), b(a.size());
                const flat_surface surface{extent};
                REQUIRE(bool(shade(o, shadow, surface, rgb_image{a, extent})));
                REQUIRE(bool(shade(o, without_rows{shadow}, surface, rgb_image{b, extent})));
                float worst = 0.0f;
                for (std::size_t j = 0; j < a.size(); ++j) worst = std::max(worst, std::abs(a[j] - b[j]));
                // Where a texel center is not a float, bilinear filtering takes 3e-5 from the next texel.
                CHECK(worst <= 8.0f * 4e-5f);
            }
        }
}

TEST_CASE("for light within, 5 slices over half a turn are as right as 8 around it") {
    const horizons h(shapes::directions(32));
    std::vector<glm::ivec2> texels(1200);
    REQUIRE(bool(sample_texels(extent, 5, texels)));
    std::vector<glm::dvec2> ways;
    for (int i = 0; i < 18; ++i) ways.push_back(shapes::direction(0.125 + (i + 0.5) / 36.0));
    const double elevations[] = {10, 20, 30, 40, 50};
    const light_grid lights{ways, elevations};
    std::vector<float> exact(texels.size() * ways.size());
    REQUIRE(bool(sample_horizons(stones().view(), texels, ways, exact)));
    for (const texture_kind kind : kinds) {
        const auto share = [&](const slice_set& slices) {
            const tangent_volume e{slices, {}, texel_format::r8, kind};
            const stored t(h, e);
            mismatch_figures found;
            REQUIRE(bool(shadow_mismatch(texels, lights, exact, e, const_texture(t), {}, extent, found)));
            return found;
        };
        const mismatch_figures half = share({5, 0.125, bearing_function::cubic, 0.5}), whole = share({8, 0.125});
        // Its ends need not be right for light beyond: 1.7 % are wrong, not 1.9 %.
        CHECK(half.share < whole.share + whole.interval);
        // Five around the turn would not do.
        CHECK(share({5, 0.125}).share > 1.3 * half.share);
    }
}
