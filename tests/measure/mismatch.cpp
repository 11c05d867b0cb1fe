#include <bumpshadow/measure/mismatch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/measure/sample.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

// Heights 0 up to x = 39 and 9.5 from x = 40 on, clamped at the borders. A light of slope s over the wall, towards +x,
// leaves those texels in shadow that are fewer than 9.5 / s before it: 9 of 64 in a row at 45 degrees, 18 at a slope of
// 0.51. From all other sides everything is lit.
struct wall {
    glm::ivec2 extent{64, 4};
    shapes::field<float> field = shapes::sampled<float>(extent, shapes::step(40, 9.5));
    std::vector<glm::ivec2> texels;
    std::vector<glm::dvec2> directions{{2.0, 0.0}, {-1.0, 0.0}};
    std::vector<double> elevations{45.0, std::atan(0.51) * 180.0 / std::numbers::pi};
    std::vector<float> exact;

    wall() {
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) texels.push_back({x, y});
        trace();
    }
    void trace() {
        exact.resize(texels.size() * directions.size());
        REQUIRE(sample_horizons(field.view(edge_mode::clamp), texels, directions, exact));
    }
    [[nodiscard]] light_grid lights() const { return {directions, elevations}; }

    template <class Factor>
    mismatch_figures figures(const Factor& factor, std::span<mismatch_figures> by_elevation = {}) const {
        mismatch_figures result;
        const status s = shadow_mismatch(texels, lights(), exact, factor, result, by_elevation);
        CHECK_MESSAGE(bool(s), s.message().c_str());
        return result;
    }
};

// The truth as geometry has it.
float shadow_of_wall(glm::ivec2 texel, glm::vec3 light) {
    const double reach = 9.5 * double(light.x) / double(light.z);  // negative from the other side
    return texel.x < 40 && double(40 - texel.x) < reach ? 0.0f : 1.0f;
}

}  // namespace

TEST_CASE("a wall: right, and wrong where geometry says so") {
    const wall w;
    mismatch_figures each[2];
    mismatch_figures f = w.figures(shadow_of_wall, each);
    CHECK(f.count == 64 * 4 * 2 * 2);
    CHECK(f.share == 0.0);
    CHECK(f.interval == 0.0);
    CHECK(each[0].count == 64 * 4 * 2);
    CHECK(each[1].share == 0.0);

    f = w.figures([](glm::ivec2, glm::vec3) { return 1.0f; }, each);
    CHECK(f.share == doctest::Approx((9.0 + 18.0) / (4.0 * 64.0)));
    CHECK(f.wrongly_lit == f.share);
    CHECK(f.wrongly_shadowed == 0.0);
    CHECK(each[0].share == doctest::Approx(9.0 / 128.0));
    CHECK(each[1].share == doctest::Approx(18.0 / 128.0));

    f = w.figures([](glm::ivec2, glm::vec3) { return 0.0f; }, each);
    CHECK(f.wrongly_shadowed == doctest::Approx((55.0 + 46.0 + 2.0 * 64.0) / (4.0 * 64.0)));
    CHECK(f.wrongly_lit == 0.0);

    // One texel too short: of each row one is wrong under each of the two lights over the wall.
    f = w.figures([](glm::ivec2 t, glm::vec3 light) { return shadow_of_wall(t - glm::ivec2(1, 0), light); }, each);
    CHECK(f.wrongly_lit == doctest::Approx(2.0 / 256.0));
    // And in the texel at x = 40, which is on top.
    CHECK(f.wrongly_shadowed == doctest::Approx(2.0 / 256.0));
    CHECK(f.share == doctest::Approx(4.0 / 256.0));
}

TEST_CASE("from one half on a factor is lit") {
    const wall w;
    CHECK(w.figures([](glm::ivec2 t, glm::vec3 l) { return shadow_of_wall(t, l) > 0.5f ? 0.5f : 0.4999f; }).share ==
          0.0);
    // And NaN, which is not below it.
    CHECK(w.figures([](glm::ivec2, glm::vec3) { return std::numeric_limits<float>::quiet_NaN(); }).wrongly_lit > 0.0);
}

TEST_CASE("lights are of unit length, as directions and elevations have them") {
    wall w;
    w.directions = {{3.0, 4.0}};
    w.elevations = {30.0};
    w.texels = {{1, 2}};
    w.trace();
    int calls = 0;
    const auto factor = [&](glm::ivec2 texel, glm::vec3 light) {
        ++calls;
        CHECK(texel == glm::ivec2(1, 2));
        CHECK(double(light.x) == doctest::Approx(0.6 * std::sqrt(0.75)));
        CHECK(double(light.y) == doctest::Approx(0.8 * std::sqrt(0.75)));
        CHECK(double(light.z) == doctest::Approx(0.5));
        return 1.0f;
    };
    CHECK(std::isinf(w.figures(factor).interval));
    CHECK(calls == 1);
}

TEST_CASE("interval: texels are what was drawn") {
    wall w;
    w.elevations = {45.0};
    w.directions = {{1.0, 0.0}};
    // Nine before the wall in shadow, of 16: 7 are wrong if all are dark. Standard deviation of 7 ones and 9 zeros:
    // sqrt((7 * 81 + 9 * 49) / 256 / 15) = sqrt(0.2625), over 4.
    w.texels.clear();
    for (int x = 24; x < 40; ++x) w.texels.push_back({x, 1});
    w.trace();
    const auto dark = [](glm::ivec2, glm::vec3) { return 0.0f; };
    const double interval = standard_errors_95(15) * std::sqrt(0.2625) / 4.0;
    CHECK(w.figures(dark).share == doctest::Approx(7.0 / 16.0));
    CHECK(w.figures(dark).interval == doctest::Approx(interval));
    // The same light four times over says no more.
    w.directions.assign(4, {1.0, 0.0});
    w.trace();
    CHECK(w.figures(dark).count == 64);
    CHECK(w.figures(dark).interval == doctest::Approx(interval));
}

TEST_CASE("holes are left out") {
    wall w;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::size_t all = w.texels.size();
    // Texels 39 of rows 0 and 1, right before the wall.
    for (std::size_t d = 0; d < 2; ++d) {
        w.exact[d * all + 39] = no_horizon;
        w.exact[d * all + 64 + 39] = nan;
    }
    const auto lit = [](glm::ivec2, glm::vec3) { return 1.0f; };
    CHECK(w.figures(lit).count == (64 * 4 - 2) * 4);
    CHECK(w.figures(lit).wrongly_lit == doctest::Approx(double(27 * 4 - 4) / ((64 * 4 - 2) * 4)));
    // One direction that leads out of an open map is lit.
    w.exact[39] = 9.5f;
    CHECK(w.figures(lit).count == (64 * 4 - 1) * 4);

    for (float& e : w.exact) e = no_horizon;
    mismatch_figures each[2];
    const mismatch_figures f = w.figures(lit, each);
    CHECK(f.count == 0);
    for (const double v : {f.share, f.wrongly_lit, f.wrongly_shadowed, f.interval, each[1].share}) CHECK(std::isnan(v));
}

// A volume of 16 bits whose slices are the directions of the lights shows the wall as it is: no light is within 2^-16
// of a horizon. At half the extent, texels see the mean of their neighbors.
TEST_CASE("an encoding through the sampler") {
    wall w;
    w.directions = shapes::directions(4);
    w.trace();
    const auto bake = [&](glm::ivec2 extent, const std::vector<float>& slopes, texel_format format) {
        std::vector<float> values(slopes);
        const tangent_volume encoding{.slices = {.count = 4}, .scale = {.max_slope = 16.0f}, .format = format};
        const texture_layout layout = layout_of(encoding, extent);
        std::vector<std::byte> bytes(layout.required_size());
        const status packed =
            pack_tangent_volume({values, extent, 4}, w.directions, encoding, {}, texture{bytes, layout});
        CHECK_MESSAGE(bool(packed), packed.message().c_str());

        mismatch_figures f, again, each[2];
        const const_texture from{bytes, layout};
        const status s = shadow_mismatch(w.texels, w.lights(), w.exact, encoding, from, sampler{}, w.extent, f, each);
        CHECK_MESSAGE(bool(s), s.message().c_str());
        const auto factor = [&](glm::ivec2 t, glm::vec3 light) {
            const glm::vec2 uv((float(t.x) + 0.5f) / 64.0f, (float(t.y) + 0.5f) / 4.0f);
            return shadow_factor(encoding, from, sampler{}, uv, light);
        };
        REQUIRE(shadow_mismatch(w.texels, w.lights(), w.exact, factor, again));
        CHECK(again.wrongly_lit == f.wrongly_lit);
        CHECK(again.wrongly_shadowed == f.wrongly_shadowed);
        CHECK(f.share == doctest::Approx(0.5 * (each[0].share + each[1].share)));
        return f;
    };
    CHECK(bake(w.extent, w.exact, texel_format::r16).share == 0.0);

    // Half the extent: means of 2 x 2, texel i at x = 2 i + 0.5. Horizons towards the wall are 9.5 / d up to d = 1 at
    // x = 39, and 0 on top: the mean of 38 and 39 is 7.125, so x = 40 reads a quarter of that, 1.78, and is wrongly in
    // shadow at 45 degrees and at 0.51; 41 reads 0. Before the wall horizons become too high, by less than moves the
    // end of a shadow: 10 texels before it, 0.95 becomes 0.959, and 19 before it, 0.5 becomes 0.5015. That the texture
    // repeats does not matter: x = 0 has 0.24, below all lights. One texel a row is wrong under two of eight lights.
    std::vector<float> half;
    for (std::size_t d = 0; d < 4; ++d)
        for (std::size_t i = 0; i < 2 * 32; ++i) {
            const std::size_t x = 2 * (i % 32), y = 2 * (i / 32);
            const float* const from = w.exact.data() + d * 256 + y * 64 + x;
            half.push_back(0.25f * (from[0] + from[1] + from[64] + from[65]));
        }
    const mismatch_figures reduced = bake({32, 2}, half, texel_format::r16);
    CHECK(reduced.wrongly_lit == 0.0);
    CHECK(reduced.wrongly_shadowed == doctest::Approx(2.0 / (64.0 * 8.0)));
}

TEST_CASE("bad input is named, and nothing is written") {
    wall w;
    mismatch_figures f, each[3];
    f.share = each[0].share = -7.0;
    const auto lit = [](glm::ivec2, glm::vec3) { return 1.0f; };
    const auto refused = [&](const status& s, error code, const char* argument) {
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        CHECK(f.share == -7.0);
        CHECK(each[0].share == -7.0);
    };
    const auto measure = [&] { return shadow_mismatch(w.texels, w.lights(), w.exact, lit, f, each); };
    refused(measure(), error::mismatch, "by_elevation size");
    refused(shadow_mismatch({}, w.lights(), w.exact, lit, f), error::missing, "texels");
    refused(shadow_mismatch(w.texels, {}, w.exact, lit, f), error::missing, "lights.directions");
    refused(shadow_mismatch(w.texels, {w.directions, {}}, w.exact, lit, f), error::missing, "lights.elevations");
    refused(shadow_mismatch(w.texels, w.lights(), std::span(w.exact).first(9), lit, f), error::mismatch, "exact size");
    for (const double wrong : {0.0, -5.0, 90.1, std::numeric_limits<double>::quiet_NaN()}) {
        w.elevations[1] = wrong;
        refused(measure(), error::out_of_range, "elevation of a light");
    }
    w.elevations.assign(most_elevations + 1, 45.0);
    refused(measure(), error::out_of_range, "lights.elevations");
    w.elevations = {45.0, 90.0, 10.0};
    w.directions[1] = {0.0, 0.0};
    refused(measure(), error::not_positive, "length of a light's direction");
    w.directions[1] = {0.0, std::numeric_limits<double>::infinity()};
    refused(measure(), error::not_finite, "length of a light's direction");

    const tangent_volume encoding{.slices = {.count = 4}, .scale = {.max_slope = 16.0f}};
    const texture_layout layout = layout_of(encoding, w.extent);
    std::vector<std::byte> bytes(layout.required_size());
    w.directions = {{1.0, 0.0}, {0.0, 1.0}};
    const auto through = [&](const const_texture& from, glm::ivec2 extent) {
        return shadow_mismatch(w.texels, w.lights(), w.exact, encoding, from, sampler{}, extent, f, each);
    };
    refused(through({std::span(bytes).first(9), layout}, w.extent), error::too_small, "texture size");
    refused(through({bytes, layout}, {64, 3}), error::out_of_range, "texels y");
    refused(through({bytes, layout}, {0, 0}), error::out_of_range, "texels x");
    CHECK(through({bytes, layout}, w.extent));
    CHECK(f.share != -7.0);
}
