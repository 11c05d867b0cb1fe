#include <bumpshadow/reference/shadow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/reference/shade.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr double degree = std::numbers::pi / 180.0;

// Towards a light, azimuth in turns, elevation in degrees.
glm::vec3 toward(double turns, double elevation) {
    const double a = turns * 2 * std::numbers::pi, e = elevation * degree;
    return glm::vec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
}

// Horizons of a map: slope(x, y, bearing), at the directions of `count` slices.
struct horizons {
    std::vector<float> values;
    std::vector<glm::dvec2> directions;
    horizon_map map;

    template <class Slope>
    horizons(glm::ivec2 extent, int count, bearing_function function, Slope&& slope)
        : values(required_size(extent, count)), directions(std::size_t(count)), map{values, extent, count} {
        fill_directions(directions, 0.0, function);
        for (int i = 0; i < count; ++i)
            for (int y = 0; y < extent.y; ++y)
                for (int x = 0; x < extent.x; ++x) map.row(i, y)[x] = float(slope(x, y, double(i) / count));
    }
};

struct stored {
    std::vector<std::byte> bytes;
    texture_layout layout;

    explicit stored(const texture_layout& l) : bytes(l.required_size()), layout(l) {}
    operator texture() { return {bytes, layout}; }
    operator const_texture() const { return {bytes, layout}; }
};

using factor_function = std::function<float(glm::vec2, glm::vec3, const shadow_edge&)>;
using horizon_function = std::function<float(glm::vec2, glm::vec3)>;

struct tried {
    std::string name;
    horizon_scale scale;
    double step;  // of what is stored: half of it is the error
    factor_function factor;
    horizon_function horizon_in_light;
};

// What there is to be tried: every encoding that stores horizons, in every form, of one map.
class every_encoding {
public:
    template <class Slope>
    every_encoding(glm::ivec2 extent, const Slope& slope) {
        const pack_options point{.fit = slice_fit::point};
        const horizon_scale scales[] = {{quantity::slope, 4.0f}, {quantity::sine, 4.0f}, {quantity::angle, infinite}};
        for (const horizon_scale& scale : scales) {
            const std::string in = scale.stored == quantity::slope  ? ", slope"
                                   : scale.stored == quantity::sine ? ", sine"
                                                                    : ", angle";
            const horizons cubic(extent, 12, bearing_function::cubic, slope);
            for (const auto format : {texel_format::r8, texel_format::r16, texel_format::r16f, texel_format::bc4})
                for (const auto kind : {texture_kind::volume, texture_kind::array}) {
                    tangent_volume e;
                    e.slices = {12, 0.0, bearing_function::cubic};
                    e.scale = scale;
                    e.format = format;
                    e.kind = kind;
                    stored& t = keep(layout_of(e, extent));
                    REQUIRE(bool(pack_tangent_volume(cubic.map, cubic.directions, e, point, t)));
                    add("tangent volume" + in + " " + std::to_string(int(format)) + " " + std::to_string(int(kind)),
                        scale,
                        format == texel_format::r16    ? 1 / 65535.0
                        : format == texel_format::r16f ? 1 / 2048.0
                                                       : 1 / 255.0,
                        e, const_texture(t));
                }
            for (const auto grouping : {slice_grouping::four, slice_grouping::overlapping}) {
                slice_layers e;
                e.slices = {12, 0.0, bearing_function::cubic};
                e.scale = scale;
                e.grouping = grouping;
                stored& t = keep(layout_of(e, extent));
                REQUIRE(bool(pack_slice_layers(cubic.map, cubic.directions, e, point, t)));
                add("slice layers" + in + " " + std::to_string(int(grouping)), scale, 1 / 255.0, e, const_texture(t));
            }
            const horizons eight(extent, 8, bearing_function::exact, slope);
            for (const bool separate : {false, true}) {
                sine_layers e;
                e.scale = scale;
                e.separate = separate;
                stored& t = keep(layout_of(e, extent));
                stored& u = keep(layout_of(e, extent));
                if (separate) {
                    const texture both[] = {t, u};
                    REQUIRE(bool(pack_sine_layers(eight.map, eight.directions, e, point, both)));
                    add("two sine textures" + in, scale, 1 / 255.0, e, two_textures{t, u});
                    continue;
                }
                const texture one[] = {t};
                REQUIRE(bool(pack_sine_layers(eight.map, eight.directions, e, point, one)));
                add("sine layers" + in, scale, 1 / 255.0, e, const_texture(t));
                stored& cube = keep(layout_of(factor_cube{}));
                REQUIRE(bool(write_factor_cube({}, cube)));
                add("sine layers with a cube" + in, scale, 1 / 255.0 + 0.02, e,
                    with_factor_cube<const_texture>{t, cube});
            }
            const horizons sixteen(extent, 16, bearing_function::exact, slope);
            for (const int coefficients : {3, 5, 7, 9})
                for (const bool root : {false, true}) {
                    fourier e;
                    e.coefficients = coefficients;
                    e.scale = scale;
                    e.square_root = root;
                    e.bits = root ? 16 : 8;
                    std::vector<texture> out;
                    fourier_textures from{{}, decoding_of(e)};
                    for (int i = 0; i < texture_count(e); ++i) {
                        stored& t = keep(layout_of(e, extent, 1, i));
                        out.push_back(t);
                        from.maps[std::size_t(i)] = t;
                    }
                    REQUIRE(bool(pack_fourier(sixteen.map, sixteen.directions, e, {}, out)));
                    add("fourier" + in + " " + std::to_string(coefficients) + (root ? " roots" : ""), scale,
                        root ? 2 / 65535.0 : 1 / 255.0, e, from);
                }
            add_more(extent, slope, scale, in);
        }
    }

    std::vector<tried> all;

private:
    template <class Slope>
    void add_more(glm::ivec2 extent, const Slope& slope, const horizon_scale& scale, const std::string& in) {
        // Traced: the slopes of bearing 0 alone.
        const traced e{scale};
        stored& t = keep(layout_of(e, extent));
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const float value = float(slope(x, y, 0.0));
                std::memcpy(t.bytes.data() + 4 * (std::size_t(y) * std::size_t(extent.x) + std::size_t(x)), &value, 4);
            }
        add("traced" + in, scale, 0.0, e, const_texture(t));
    }
    stored& keep(const texture_layout& layout) { return *kept_.emplace_back(std::make_unique<stored>(layout)); }
    template <class Encoding, class Textures>
    void add(const std::string& name, const horizon_scale& scale, double step, const Encoding& e, const Textures& t) {
        all.push_back({name, scale, step,
                       [=](glm::vec2 uv, glm::vec3 light, const shadow_edge& edge) {
                           return shadow_factor(e, t, {}, uv, light, edge);
                       },
                       [=](glm::vec2 uv, glm::vec3 light) { return horizon(e, t, {}, uv, light); }});
    }
    std::vector<std::unique_ptr<stored>> kept_;
};

constexpr glm::vec2 middle(0.5f, 0.5f);

}  // namespace

TEST_CASE("light of every length and direction, with every encoding") {
    // Horizons of 30 degrees all around.
    const every_encoding encodings({4, 4}, [](int, int, double) { return std::tan(30 * degree); });
    for (const tried& t : encodings.all) {
        CAPTURE(t.name);
        for (const shadow_edge edge : {shadow_edge{}, shadow_edge{8.0f, 1.0f}, shadow_edge{20.0f, 0.5f}}) {
            CAPTURE(edge.k);
            const auto factor = [&](glm::vec3 light) { return t.factor(middle, light, edge); };
            for (int i = 0; i < 16; ++i) {
                CHECK(factor(toward(i / 16.0, 60)) == 1.0f);
                if (edge.c == 0.5f || std::isinf(edge.k)) CHECK(factor(toward(i / 16.0, 5)) == 0.0f);
                CHECK(factor(toward(i / 16.0, -5)) == 0.0f);
                CHECK(factor(toward(i / 16.0, -89)) == 0.0f);
                const float here = factor(toward(i / 16.0, 28.7));
                for (const float length : {1e-30f, 1e30f, 3e38f}) {
                    CHECK(factor(length * toward(i / 16.0, 60)) == 1.0f);
                    CHECK(factor(length * toward(i / 16.0, -1)) == 0.0f);
                    CHECK(factor(length * toward(i / 16.0, 28.7)) == doctest::Approx(double(here)).epsilon(1e-4));
                }
            }
            // Straight up, down, and nearly so.
            for (const float length : {1e-40f, 1e-30f, 1.0f, 1e30f}) {
                CHECK(factor({0, 0, length}) == 1.0f);
                CHECK(factor({0, 0, -length}) == 0.0f);
            }
            CHECK(factor({1e-20f, -1e-20f, 1}) == 1.0f);
            CHECK(factor({1e-4f, 0, 1}) == 1.0f);
            CHECK(factor({-0.0f, -0.0f, 1}) == 1.0f);
            const float none = factor(glm::vec3(0));
            CHECK(none >= 0.0f);
            CHECK(none <= 1.0f);
            for (int axis = 0; axis < 3; ++axis)
                for (const float bad : {not_a_number, infinite, -infinite}) {
                    glm::vec3 light(0.1f, 0.2f, 0.9f);
                    light[axis] = bad;
                    CHECK(factor(light) == 0.0f);
                }
        }
        // k of 0 and beyond what can be multiplied.
        for (const float k : {0.0f, 1e38f, infinite})
            for (const float c : {0.5f, 1.0f})
                for (const double elevation : {-90.0, -1.0, 0.0, 10.0, 30.0, 89.99, 90.0}) {
                    const float f = t.factor(middle, toward(0.3, elevation), {k, c});
                    CHECK(f >= 0.0f);
                    CHECK(f <= 1.0f);
                }
    }
}

TEST_CASE("along the turn and upwards the factor is continuous, with every encoding") {
    // Horizons of 20 to 40 degrees, steepest towards +y, where no slice lies.
    const auto horizons = [](int, int, double turn) {
        return std::tan((30.0 + 10.0 * std::sin(2.0 * std::numbers::pi * (turn + 0.02))) * degree);
    };
    const every_encoding encodings({4, 4}, horizons);
    constexpr int steps = 4000;
    for (const tried& t : encodings.all) {
        CAPTURE(t.name);
        // The steepest that horizons rise between slices, 0.35 a sixteenth of a turn, times k is 45 a turn, and the
        // cubic bearing turns at most 1.3 times as fast as the angle; upwards, 8 times the 3 / 4 that a slope over 4
        // rises.
        double around = 0.0, upwards = 0.0, least = 1.0, most = 0.0;
        for (const shadow_edge edge : {shadow_edge{8.0f, 1.0f}, shadow_edge{8.0f, 0.5f}}) {
            double before = double(t.factor(middle, toward(-1.0 / steps, 28), edge));
            for (int i = 0; i < steps; ++i) {
                const double here = double(t.factor(middle, toward(double(i) / steps, 28), edge));
                around = std::max(around, std::abs(here - before));
                least = std::min(least, here), most = std::max(most, here);
                before = here;
            }
            before = double(t.factor(middle, toward(0.3, 0), edge));
            for (int i = 1; i <= steps; ++i) {
                const double here = double(t.factor(middle, toward(0.3, 90.0 * i / steps), edge));
                upwards = std::max(upwards, std::abs(here - before));
                before = here;
            }
            CHECK(before == 1.0);
        }
        CHECK(around * steps < 60.0);
        CHECK(upwards * steps / (0.5 * std::numbers::pi) < 8.0 * 1.2);
        if (t.name.find("traced") == std::string::npos) CHECK(most - least > 0.5);
    }
}

// No encoder takes a max_slope of 0; a program that lets it be set meets one all the same.
TEST_CASE("a max_slope that is next to nothing, and 0") {
    const horizons map({4, 4}, 12, bearing_function::cubic, [](int, int, double) { return 1.0; });
    tangent_volume e;
    e.slices = {12, 0.0, bearing_function::cubic};
    stored t(layout_of(e, {4, 4}));
    REQUIRE(bool(pack_tangent_volume(map.map, map.directions, e, {.fit = slice_fit::point}, t)));
    for (const quantity q : {quantity::slope, quantity::sine, quantity::angle})
        for (const float max_slope : {0.0f, 1e-45f, 1e-38f, 1e-30f, 1e-20f})
            for (const float k : {0.0f, 1e-40f, 8.0f, 1e38f, infinite})
                for (const double elevation : {-90.0, -1.0, 0.0, 1e-9, 30.0, 89.9999, 90.0}) {
                    e.scale = {q, max_slope};
                    for (const glm::vec3 light : {toward(0.3, elevation), glm::vec3(0.0f), glm::vec3(0, 0, 1)}) {
                        const float f = shadow_factor(e, const_texture(t), {}, middle, light, {k, 1.0f});
                        CHECK(f >= 0.0f);
                        CHECK(f <= 1.0f);
                    }
                }
}

TEST_CASE("straight up is lit over the steepest horizon of the largest max_slope") {
    tangent_volume e;
    e.scale.max_slope = largest_max_slope;
    REQUIRE(bool(check(e)));
    stored t(layout_of(e, {1, 1}));
    std::fill(t.bytes.begin(), t.bytes.end(), std::byte(255));
    for (const shadow_edge edge : {shadow_edge{}, shadow_edge{8.0f, 1.0f}, shadow_edge{8.0f, 0.5f}})
        CHECK(shadow_factor(e, t, {}, middle, {0.0f, 0.0f, 1.0f}, edge) == 1.0f);
    const float endless = infinite;
    const const_texture cliff{std::as_bytes(std::span(&endless, 1)), layout_of(traced{}, {1, 1})};
    CHECK(shadow_factor(traced{}, cliff, {}, middle, {0.0f, 0.0f, 1.0f}) == 1.0f);
    CHECK(shadow_factor(traced{}, cliff, {}, middle, {1.0f, 0.0f, 1e3f}) == 0.0f);
}

TEST_CASE("a light on the horizon is lit, and half lit with a centered edge") {
    // Where nothing occludes, the horizon is exactly 0, and so is a light in the surface.
    const every_encoding flat({4, 4}, [](int, int, double) { return no_horizon; });
    for (const tried& t : flat.all) {
        CAPTURE(t.name);
        for (int i = 0; i < 16; ++i) {
            // A sum of Fourier coefficients is 0 but for rounding.
            const float above = t.name.starts_with("fourier") ? 1e-5f : 0.0f;
            const glm::vec3 light(std::cos(float(i)), std::sin(float(i)), above);
            CHECK(t.factor(middle, light, {}) == 1.0f);
            CHECK(t.factor(middle, light, {8.0f, 1.0f}) == 1.0f);
            CHECK(t.factor(middle, light, {20.0f, 0.5f}) == doctest::Approx(0.5).epsilon(1e-3));
        }
    }
    // In floats, at 45 degrees.
    const every_encoding high({4, 4}, [](int, int, double) { return 1.0; });
    for (const tried& t : high.all)
        if (t.step == 0.0) {
            CHECK(t.factor(middle, {1, 0, 1.000001f}, {}) == 1.0f);
            CHECK(t.factor(middle, {1, 0, 0.99999f}, {}) == 0.0f);
        }
}

TEST_CASE("horizons come out at their bearings and between them") {
    // A wave around the compass that 12 slices and 8 show differently only between them.
    const auto slope = [](int, int, double turns) { return 1.0 + 0.5 * std::cos(2 * std::numbers::pi * turns); };
    const every_encoding encodings({4, 4}, slope);
    for (const tried& t : encodings.all) {
        if (t.step == 0.0 || t.name.starts_with("fourier")) continue;
        CAPTURE(t.name);
        const bool eight = t.name.find("sine ") == 0 || t.name.find("two") == 0;
        const auto function = eight ? bearing_function::exact : bearing_function::cubic;
        const int count = eight ? 8 : 12;
        const auto value = [&](int i) { return double(to_stored(t.scale, float(slope(0, 0, double(i) / count)))); };
        for (int i = 0; i < count; ++i)
            for (const double part : {0.0, 0.25, 0.5}) {
                const glm::dvec2 d = to_direction(function, (i + part) / count);
                const double found = double(t.horizon_in_light(middle, 3.0f * glm::vec3(d.x, d.y, 0.7)));
                const double expected = value(i) * (1 - part) + value(i + 1) * part;
                // Half a step, and for eight horizons an angle that is not measured exactly.
                CHECK(std::abs(found - expected) <= 0.51 * t.step + (eight ? 2e-3 : 1e-5));
            }
    }
}

TEST_CASE("whole turns of the phase do not matter, up to the largest") {
    const auto difference = [](auto near) {
        auto far = near;
        near.slices.phase = 0.375;
        stored t(layout_of(near, {1, 1}));
        for (std::size_t i = 0; i < t.bytes.size(); ++i) t.bytes[i] = std::byte((i * 53) & 255);
        double most = 0.0;
        for (const double turns : {1.0, 15.0, -16.0}) {
            far.slices.phase = 0.375 + turns;
            REQUIRE(bool(check(far.slices)));
            for (int i = 0; i < 500; ++i) {
                const float bearing = float(i) / 500.0f;
                most =
                    std::fmax(most, std::abs(double(horizon_at(near, const_texture(t), {}, glm::vec2(0.5f), bearing)) -
                                             double(horizon_at(far, const_texture(t), {}, glm::vec2(0.5f), bearing))));
            }
        }
        return most;
    };
    // The steepest slope between slices is their number; bearings are off by two roundings, at 16 and beyond.
    CHECK(difference(tangent_volume{{12}}) < 12 * 2e-6);
    CHECK(difference(tangent_volume{.slices = {12}, .kind = texture_kind::array}) < 12 * 2e-6);
    CHECK(difference(slice_layers{{12}}) < 12 * 2e-6);
}

TEST_CASE("Fourier series come out at every bearing") {
    // A wave in the stored quantity itself has no more than one coefficient beside the constant.
    for (const double phase : {0.0, 0.3}) {
        const auto value = [&](double turns) { return 0.5 + 0.2 * std::cos(2 * std::numbers::pi * (turns - phase)); };
        const every_encoding encodings({4, 4}, [&](int, int, double turns) { return 4 * value(turns); });
        for (const tried& t : encodings.all) {
            if (!t.name.starts_with("fourier, slope")) continue;
            CAPTURE(t.name);
            for (int i = 0; i < 24; ++i) {
                const double found = double(t.horizon_in_light(middle, 2.0f * toward(i / 24.0, 40)));
                // Each of the coefficients is off by half a step, and doubled.
                CHECK(std::abs(found - value(i / 24.0)) <= (t.step < 1e-3 ? 2e-4 : 0.5 / 255 + 8 * 0.64 / 510));
            }
        }
    }
}

TEST_CASE("emboss: brightness") {
    // Heights rise by 0.1 a texel along x: 26 of 255.
    const emboss e;
    stored t(layout_of(e, {5, 1}));
    for (std::size_t x = 0; x < 5; ++x) t.bytes[x] = std::byte(26 * x);
    const sampler clamped{.x = address_mode::clamp, .y = address_mode::clamp};
    const emboss_texture from{t, {0.2f, 0.2f}};  // a texel
    const auto at = [&](glm::vec3 light) { return shadow_factor(e, from, clamped, {0.5f, 0.5f}, light); };
    // Towards -x the surface falls: the side faces the light, which is brightened by twice 26/255.
    CHECK(at({-1, 0, 0}) == doctest::Approx(2 * (128 + 26) / 255.0));
    CHECK(at({1, 0, 0}) == doctest::Approx(2 * (128 - 26) / 255.0));
    for (const float length : {1e-30f, 1.0f, 1e30f})
        CHECK(at(length * glm::vec3(-0.6f, 0, 0.8f)) == doctest::Approx(2 * (128 + 0.6 * 26) / 255.0));
    CHECK(at({0, 0, 1}) == doctest::Approx(256 / 255.0));
    CHECK(at({0, 0, 0}) == doctest::Approx(256 / 255.0));
    CHECK(at({0, 0, -1}) == 0.0f);
    CHECK(at({1, 0, -0.01f}) == 0.0f);
    CHECK(at({not_a_number, 0, 1}) == 0.0f);
    CHECK(at({0, infinite, 1}) == 0.0f);
    // Brightness takes the place of the cosine: the first texel has no neighbor to the left, the others a rise of 26.
    std::vector<float> values(15);
    shade_options o;
    o.light.direction = {-1, 0, 0};
    o.albedo = glm::vec3(0.5f);
    const encoded_shadow<emboss, emboss_texture> shadow{e, from, clamped};
    CHECK(bool(shade(o, shadow, flat_surface{{5, 1}}, rgb_image{values, {5, 1}})));
    CHECK(values[0] == doctest::Approx(128 / 255.0));
    for (std::size_t x = 1; x < 5; ++x) CHECK(values[3 * x] == doctest::Approx((128 + 26) / 255.0));
}

TEST_CASE("horizons are filtered between texels") {
    const auto slope = [](int x, int y, double) { return (x == 1 ? 1.0 : 0.0) + (y == 2 ? 0.5 : 0.0); };
    const every_encoding encodings({4, 4}, slope);
    for (const tried& t : encodings.all) {
        CAPTURE(t.name);
        // BC4 is not exact; the roots of horizons are not filtered like horizons.
        if (t.name.find(" 11") != std::string::npos || t.name.find("roots") != std::string::npos) continue;
        const double a = double(to_stored(t.scale, 1.0f)), b = double(to_stored(t.scale, 1.5f));
        const double c = double(to_stored(t.scale, 0.5f));
        const auto at = [&](float u, float v) { return double(t.horizon_in_light({u, v}, {1, 0, 1})); };
        // Traced horizons are slopes up to the comparison; all others are filtered as they are stored.
        const bool slopes = t.step == 0.0;
        const double edge = slopes ? double(to_stored(t.scale, 0.5f)) : a / 2;
        const double corner = slopes ? double(to_stored(t.scale, 0.75f)) : (a + b + c) / 4;
        const double allowed = 0.51 * t.step + 1e-5;
        CHECK(std::abs(at(0.375f, 0.375f) - a) <= allowed);
        CHECK(std::abs(at(0.375f, 0.625f) - b) <= allowed);
        CHECK(std::abs(at(0.5f, 0.375f) - edge) <= allowed);
        CHECK(std::abs(at(0.5f, 0.5f) - corner) <= allowed);
        CHECK(std::abs(at(1.5f, -0.5f) - corner) <= allowed);
    }
}

TEST_CASE("the edge of a light of some size, by hand") {
    const horizon_scale slope{quantity::slope, 4.0f}, sine{quantity::sine, infinite}, angle{quantity::angle, infinite};
    const auto width = [](const shadow_edge& e) { return 1 / double(e.k); };
    CHECK(width(edge_for(1, slope, 45)) == doctest::Approx((std::tan(46 * degree) - std::tan(44 * degree)) / 4));
    CHECK(width(edge_for(1, slope, 0)) == doctest::Approx(2 * std::tan(degree) / 4));
    CHECK(width(edge_for(1, sine, 30)) == doctest::Approx(std::sin(31 * degree) - std::sin(29 * degree)));
    CHECK(width(edge_for(1, angle, 80)) == doctest::Approx(2.0 / 90));
    // The derivative, for a small light.
    CHECK(width(edge_for(0.01, slope, 60)) == doctest::Approx(0.02 * degree * 4 / 4).epsilon(1e-4));
    CHECK(width(edge_for(0.01, sine, 60)) == doctest::Approx(0.02 * degree * 0.5).epsilon(1e-4));
    // Inside the shadow: from the light's middle upwards.
    const shadow_edge inside = edge_for(1, angle, 40, 1.0f);
    CHECK(inside.c == 1.0f);
    CHECK(width(inside) == doctest::Approx(2.0 / 90));
    CHECK(width(edge_for(1, slope, 40, 1.0f)) == doctest::Approx((std::tan(42 * degree) - std::tan(40 * degree)) / 4));
    // Of no size: hard.
    CHECK(std::isinf(edge_for(0, slope, 45).k));
    // However high the light and wherever the horizons end, k is a number that leaves the light's middle lit.
    for (const horizon_scale& scale : {slope, sine, angle})
        for (const double radius : {0.2666, 2.0, 10.0})
            for (const double elevation : {-5.0, 0.0, 45.0, 76.0, 80.0, 89.0, 90.0})
                for (const float c : {0.5f, 1.0f}) {
                    const shadow_edge e = edge_for(radius, scale, elevation, c);
                    CHECK(bool(check(e)));
                    CHECK(e.k > 0.0f);
                }
    CHECK(elevation_of({1, 0, 1}) == doctest::Approx(45));
    CHECK(elevation_of({0, 0, 1e-30f}) == doctest::Approx(90));
    CHECK(elevation_of({0, 0, 0}) == 0.0);
    CHECK(elevation_of({not_a_number, 0, 0}) == 0.0);
    CHECK(check(shadow_edge{-1.0f, 1.0f}).code() == error::out_of_range);
    CHECK(check(shadow_edge{not_a_number, 1.0f}).code() == error::out_of_range);
    CHECK(check(shadow_edge{1.0f, 1.5f}).code() == error::out_of_range);
}

TEST_CASE("every encoding shows the same penumbra") {
    for (const double horizon : {8.0, 30.0, 55.0}) {
        const every_encoding encodings({4, 4}, [&](int, int, double) { return std::tan(horizon * degree); });
        for (const double radius : {3.0, 6.0})
            for (const float c : {0.5f, 1.0f})
                for (const double at : {-1.2, -1.0, -0.6, 0.0, 0.4, 1.0, 1.2}) {
                    // at: the light's middle over the horizon, in radii; centered: half lit at 0.
                    const double elevation = horizon + at * radius;
                    const double expected = std::fmin(std::fmax(0.5 * at + double(c), 0.0), 1.0);
                    // The quantity is not linear in the elevation: see edge_for.
                    const double r = radius * degree, steepest = std::tan(std::fmax(elevation, horizon) * degree);
                    const double bend = (r * steepest / 2 + r * r / 2) * (c == 1.0f ? 2.0 : 1.0);
                    for (const tried& t : encodings.all) {
                        CAPTURE(t.name);
                        CAPTURE(elevation);
                        const shadow_edge edge = edge_for(radius, t.scale, elevation, c);
                        const double found = double(t.factor(middle, toward(0.0, elevation), edge));
                        const double step = t.step > 0.01 ? 1 / 255.0 : t.step;  // the cube's factors add up to 1
                        CHECK(std::abs(found - expected) <= bend + 0.55 * step * double(edge.k) + 1e-4);
                    }
                }
    }
    // The sun: floats, all quantities, within what edge_for states.
    for (const double horizon : {10.0, 30.0, 45.0}) {
        const every_encoding encodings({4, 4}, [&](int, int, double) { return std::tan(horizon * degree); });
        for (const double at : {-1.0, -0.5, 0.0, 0.5, 1.0})
            for (const tried& t : encodings.all)
                if (t.step == 0.0) {
                    const double elevation = horizon + at * sun_radius;
                    const double found =
                        double(t.factor(middle, toward(0.0, elevation), edge_for(sun_radius, t.scale, elevation)));
                    CHECK(std::abs(found - (0.5 + 0.5 * at)) < 0.003);
                }
    }
}

TEST_CASE("a high light of some size stays lit") {
    // Horizons up to 75 degrees under lights that stand clear of them.
    for (const double horizon : {0.0, 45.0, 75.0}) {
        const every_encoding encodings({4, 4}, [&](int, int, double) { return std::tan(horizon * degree); });
        for (const double radius : {0.2666, 2.0, 5.0})
            for (const double elevation : {82.0, 85.0, 89.0, 89.999, 90.0})
                for (const tried& t : encodings.all) {
                    CAPTURE(t.name);
                    CAPTURE(elevation);
                    const shadow_edge edge = edge_for(radius, t.scale, elevation);
                    CHECK(t.factor(middle, toward(0.4, elevation), edge) > 0.97f);
                    CHECK(t.factor(middle, toward(0.4, elevation), edge_for(radius, t.scale, elevation, 1.0f)) == 1.0f);
                }
    }
}

TEST_CASE("traced: a wall casts a shadow of its height times the light's cotangent") {
    const auto wall = shapes::sampled<float>({64, 3}, shapes::step(40, 6));
    const glm::dvec2 along(1, 0);
    std::vector<float> slopes(64 * 3);
    REQUIRE(bool(bake_exact(wall.view(edge_mode::clamp), std::span(&along, 1), horizon_map{slopes, {64, 3}, 1})));
    const encoded_shadow<traced> shadow{{}, {std::as_bytes(std::span(slopes)), layout_of(traced{}, {64, 3})}};
    for (const double slope : {0.31, 0.52, 0.71, 1.3}) {
        std::vector<float> values(3 * slopes.size());
        shade_options o;
        o.light.direction = {2, 0, 2 * slope};
        CHECK(bool(shade(o, shadow, flat_surface{{64, 3}}, rgb_image{values, {64, 3}})));
        for (int x = 0; x < 64; ++x) {
            const bool lit = x >= 40 || 6.0 / (40 - x) < slope;
            CHECK((values[std::size_t(3 * x)] > 0.0f) == lit);
        }
    }
}

TEST_CASE("traced: a hole is not shadowed, and takes no shadow from its neighbors") {
    for (const int width : {3, 19, 100, 1021}) {
        std::vector<float> slopes(std::size_t(width), 1.0f);
        const int hole = width - 2;
        for (const float missing : {no_horizon, -infinite, not_a_number}) {
            slopes[std::size_t(hole)] = missing;
            const const_texture t{std::as_bytes(std::span(slopes)), layout_of(traced{}, {width, 1})};
            for (int x = 0; x < width; ++x)
                CHECK(shadow_factor(traced{}, t, {}, {(float(x) + 0.5f) / float(width), 0.5f}, {2.0f, 0.0f, 1.0f}) ==
                      (x == hole ? 1.0f : 0.0f));
            // A quarter of the way to the hole, three quarters of the neighbor's horizon are left.
            const glm::vec2 between((float(hole) - 0.25f) / float(width), 0.5f);
            CHECK(horizon(traced{}, t, {}, between, {}) == doctest::Approx(0.75 / 4.0).epsilon(1e-3));
        }
    }
}

TEST_CASE("SSBump: brightness of a light projected on the basis") {
    // The flat normal's masks are 1 / sqrt(3) each: brightness is the sine of the elevation where no mask is hidden.
    const ssbump e;
    stored t(layout_of(e, {1, 1}));
    for (int c = 0; c < 3; ++c) t.bytes[std::size_t(c)] = std::byte(to_unorm8(0.57735027f));
    t.bytes[3] = std::byte{255};
    for (int i = 0; i < 12; ++i)
        for (const float length : {1.0f, 1e-30f, 1e30f})
            CHECK(std::abs(shadow_factor(e, const_texture(t), {}, middle, length * toward(i / 12.0, 60)) -
                           std::sqrt(0.75f)) < 0.005f);
    // Red only: the dot with red's own vector.
    t.bytes[1] = t.bytes[2] = std::byte{0};
    t.bytes[0] = std::byte{255};
    const glm::vec3 red(std::sqrt(2.0f / 3), 0, std::sqrt(1.0f / 3));
    CHECK(shadow_factor(e, const_texture(t), {}, middle, 7.0f * red) == doctest::Approx(1));
    CHECK(shadow_factor(e, const_texture(t), {}, middle, {-1, 0, 0.3f}) == 0.0f);
    // Green looks along +y in a map whose y points along the rows, along -y in the other.
    t.bytes[0] = std::byte{0};
    t.bytes[1] = std::byte{255};
    ssbump up;
    up.y = normal_y::up;
    CHECK(shadow_factor(e, const_texture(t), {}, middle, {-1, 1.7f, 1}) > 0.9f);
    CHECK(shadow_factor(up, const_texture(t), {}, middle, {-1, 1.7f, 1}) < 0.2f);
    CHECK(shadow_factor(up, const_texture(t), {}, middle, {-1, -1.7f, 1}) > 0.9f);
    for (const glm::vec3 light : {glm::vec3(0, 0, -1), glm::vec3(0), glm::vec3(not_a_number, 0, 1),
                                  glm::vec3(1, infinite, 1), glm::vec3(-1, 1, -0.01f)})
        CHECK(shadow_factor(e, const_texture(t), {}, middle, light) == 0.0f);
    CHECK(shadow_factor(e, const_texture(t), {}, middle, {0, 0, 1e-40f}) == doctest::Approx(0.57735).epsilon(0.01));
    // As detail, flat is 0.5.
    ssbump detail;
    detail.detail = true;
    for (std::size_t c = 0; c < 3; ++c) t.bytes[c] = std::byte{128};
    CHECK(shadow_factor(detail, const_texture(t), {}, middle, {0, 0, 1}) == doctest::Approx(1).epsilon(0.01));
}

namespace {

// The general path of whole pictures: a shadow without rows.
template <class Shadow>
struct without_rows {
    const Shadow& shadow;
    float operator()(glm::vec2 uv, glm::vec3 light) const { return shadow(uv, light); }
};

}  // namespace

TEST_CASE("whole pictures: rows of a tangent volume are the same numbers as pixels one by one") {
    const auto slope = [](int x, int y, double turns) {
        return 0.9 + 0.8 * std::sin(1.7 * x + 0.6 * y + 2 * std::numbers::pi * turns);
    };
    for (const glm::ivec2 extent : {glm::ivec2(512, 4), glm::ivec2(300, 7)}) {
        const bool power_of_two = extent.x == 512;
        for (const auto kind : {texture_kind::volume, texture_kind::array})
            for (const auto weights : {filter_weights::exact, filter_weights::eight_bit}) {
                encoded_shadow<tangent_volume> shadow;
                shadow.encoding.slices.count = 12;
                shadow.encoding.kind = kind;
                const horizons h(extent, 12, bearing_function::cubic, slope);
                stored t(layout_of(shadow.encoding, extent));
                REQUIRE(bool(pack_tangent_volume(h.map, h.directions, shadow.encoding, {.fit = slice_fit::point}, t)));
                shadow.textures = t;
                shadow.how.weights = weights;
                for (const shadow_edge edge : {shadow_edge{8.0f, 1.0f}, shadow_edge{20.0f, 0.5f}, shadow_edge{}})
                    for (int i = 0; i < 8; ++i) {
                        shadow.edge = edge;
                        shadow.radius = i == 3 ? 2.0 : 0.0;
                        shade_options o;
                        o.light.direction = toward(i / 8.0 - 0.03, 5.0 + 10.9 * i);
                        o.ambient = glm::vec3(0.02f);
                        std::vector<float> a(3 * std::size_t(extent.x) * std::size_t(extent.y)), b(a.size());
                        const flat_surface surface{extent};
                        CHECK(bool(shade(o, shadow, surface, rgb_image{a, extent})));
                        CHECK(bool(shade(o, without_rows<decltype(shadow)>{shadow}, surface, rgb_image{b, extent})));
                        // Where a texel center is not a float, bilinear filtering takes 3e-5 from the next texel.
                        const float used = shadow.edge_at(o.light.direction).k, k = std::isinf(used) ? 0.0f : used;
                        const float allowed = 1e-6f + k * (power_of_two ? 3e-7f : 4e-5f);
                        int different = 0;
                        for (std::size_t j = 0; j < a.size(); ++j) {
                            if (std::abs(a[j] - b[j]) <= allowed) continue;
                            // A hard edge may fall on either side of a light whose elevation is the horizon's but for
                            // that.
                            const glm::ivec2 pixel(int(j / 3) % extent.x, int(j / 3) / extent.x);
                            const float over = light_level(shadow.encoding, o.light.direction) -
                                               horizon(shadow.encoding, shadow.textures, shadow.how, surface(pixel).uv,
                                                       o.light.direction);
                            if (k != 0.0f || std::abs(over) > 4e-5f) ++different;
                        }
                        CHECK(different == 0);
                    }
            }
    }
}

TEST_CASE("rows of a tangent volume: the length of the light does not matter") {
    const glm::ivec2 extent(16, 1);
    encoded_shadow<tangent_volume> shadow;
    stored t(layout_of(shadow.encoding, extent));
    for (std::size_t i = 0; i < t.bytes.size(); ++i) t.bytes[i] = std::byte((i * 37) & 255);
    shadow.textures = t;
    shadow.edge = {8.0f, 0.5f};
    const glm::vec3 light(0.25f, -0.125f, 0.5f);
    std::array<float, 16> unit{};
    REQUIRE(shadow.row(extent, {0, 0}, 16, light, unit.data()));
    CHECK(*std::max_element(unit.begin(), unit.end()) > 0.0f);
    for (const int power : {-120, -60, 60, 120}) {
        std::array<float, 16> far{};
        REQUIRE(shadow.row(extent, {0, 0}, 16, light * std::ldexp(1.0f, power), far.data()));
        CHECK(far == unit);
    }
}

TEST_CASE("whole pictures: every shadow, and the edge at each pixel's own light") {
    const glm::ivec2 extent(8, 8);
    const horizons h(extent, 8, bearing_function::exact, [](int, int, double) { return std::tan(40 * degree); });
    sine_layers e;
    stored t(layout_of(e, extent));
    const texture one[] = {t};
    REQUIRE(bool(pack_sine_layers(h.map, h.directions, e, {.fit = slice_fit::point}, one)));
    encoded_shadow<sine_layers> shadow{e, const_texture(t)};
    shadow.edge.c = 0.5f;
    shadow.radius = 4.0;
    std::vector<float> values(192);
    shade_options o;
    o.light.kind = light_kind::point;
    o.light.position = {0, 0, 4};
    CHECK(bool(shade(o, shadow, flat_surface{extent}, rgb_image{values, extent})));
    for (int x = 0; x < 8; ++x) {
        const double square = 16.0 + x * x, elevation = std::asin(4 / std::sqrt(square)) / degree;
        const double ramp = std::fmin(std::fmax(0.5 + (elevation - 40) / 8, 0.0), 1.0);
        const double expected = ramp * 4 / std::pow(square, 1.5);
        CHECK(std::abs(double(values[std::size_t(3 * x)]) - expected) < 0.002);
    }
}

TEST_CASE("edge: straight up is lit over any horizon, and so is what lies near it") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const horizon_scale scale : {horizon_scale{quantity::sine, infinity},
                                      {quantity::angle, infinity},
                                      {quantity::sine, 4.0f},
                                      {quantity::slope, 4.0f}})
        for (const double radius : {0.1, 1.0, 10.0})
            for (const float c : {0.5f, 1.0f}) {
                CAPTURE(int(scale.stored));
                CAPTURE(radius);
                const shadow_edge up = edge_for(radius, scale, 90.0, c);
                const float light = quantity_of_slope(scale.stored, 1e15f) * stored_scale(scale);
                CHECK(shader::bumpshadow_shadow_soft(light, 1.0f, up.k, up.c) == 1.0f);
                // The edge changes without a jump where the penumbra begins to reach beyond the zenith.
                const shadow_edge before = edge_for(radius, scale, 90.0 - 2.0 * radius - 1e-4, c);
                const shadow_edge after = edge_for(radius, scale, 90.0 - 2.0 * radius + 1e-4, c);
                CHECK(std::abs(after.c - before.c) < 1e-3f);
            }
}
