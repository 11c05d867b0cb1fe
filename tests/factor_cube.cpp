#include <bumpshadow/factor_cube.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <string>
#include <vector>

#include <glm/ext/vector_double3.hpp>

#include <doctest/doctest.h>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

struct made_cube {
    factor_cube cube;
    std::vector<std::byte> bytes;
    status result;

    explicit made_cube(const factor_cube& wanted) : cube(wanted), bytes(layout_of(wanted).required_size()) {
        result = write_factor_cube(cube, view());
    }
    [[nodiscard]] texture view() { return {bytes, layout_of(cube)}; }
    [[nodiscard]] int byte(int face, int column, int row, int channel) const {
        const int texel = (face * cube.size + row) * cube.size + column;
        return std::to_integer<int>(bytes[std::size_t(texel * 4 + channel)]);
    }
};

std::array<double, 8> decoded(factor_form form, glm::vec4 texel) {
    const auto f = form == factor_form::published ? shader::bumpshadow_factors_published_cube(texel)
                                                  : shader::bumpshadow_factors_biased_cube(texel);
    std::array<double, 8> factors{};
    for (int c = 0; c < 4; ++c) {
        factors[std::size_t(c)] = double(f.layer0[c]);
        factors[std::size_t(c + 4)] = double(f.layer1[c]);
    }
    return factors;
}

glm::dvec3 direction(double turns, double elevation_degrees) {
    const double a = turns * 2.0 * std::numbers::pi, e = elevation_degrees * std::numbers::pi / 180.0;
    return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

// Tent functions of the angle, written from the text of section 5.3.
std::array<double, 8> true_factors(glm::dvec3 d) {
    std::array<double, 8> factors{};
    for (int i = 0; i < 8; ++i) {
        double away = std::atan2(d.y, d.x) * 180.0 / std::numbers::pi - 45.0 * i;
        away -= 360.0 * std::round(away / 360.0);
        factors[std::size_t(i)] = std::max(0.0, 1.0 - std::abs(away) / 45.0);
    }
    return factors;
}

double largest_error(const std::array<double, 8>& a, const std::array<double, 8>& b) {
    double error = 0.0;
    for (std::size_t i = 0; i < 8; ++i) error = std::max(error, std::abs(a[i] - b[i]));
    return error;
}

// OpenGL 4.6, table 8.19: for each face the major axis, and the components that s and t are, with their signs
// (1: x, 2: y, 3: z).
constexpr int spec[6][3] = {{+1, -3, -2}, {-1, +3, -2}, {+2, +1, +3}, {-2, +1, -3}, {+3, +1, -2}, {-3, -1, -2}};

double component(glm::dvec3 r, int signed_axis) {
    const double v = std::abs(signed_axis) == 1 ? r.x : std::abs(signed_axis) == 2 ? r.y : r.z;
    return signed_axis < 0 ? -v : v;
}

const sampler seamless{};

}  // namespace

TEST_CASE("factor cube: orientation as the OpenGL table has it") {
    shapes::noise noise(7);
    for (int n = 0; n < 5000; ++n) {
        const glm::dvec3 r(noise.uniform() * 4 - 2, noise.uniform() * 4 - 2, noise.uniform() * 4 - 2);
        int face = 0;
        for (int f = 1; f < 6; ++f)
            if (component(r, spec[f][0]) > component(r, spec[face][0])) face = f;
        const double major = component(r, spec[face][0]);
        const auto found = sampler_detail::place_on_cube(r);
        REQUIRE(found.face == face);
        REQUIRE(found.major == major);
        const cube_coordinate place{face, glm::dvec2(found.s, found.t) / (2.0 * major) + 0.5};
        CHECK(place.st.x == doctest::Approx((component(r, spec[face][1]) / major + 1.0) / 2.0));
        CHECK(place.st.y == doctest::Approx((component(r, spec[face][2]) / major + 1.0) / 2.0));
        const glm::dvec3 back = from_cube(place) * major;
        CHECK(std::abs(back.x - r.x) + std::abs(back.y - r.y) + std::abs(back.z - r.z) < 1e-12);
    }
    CHECK(sampler_detail::place_on_cube(glm::dvec3(0, 0, 0)).face == 4);
    CHECK(sampler_detail::place_on_cube(glm::dvec3(1, 1, 1)).face == 4);
    CHECK(sampler_detail::place_on_cube(glm::dvec3(1, -1, 0.5)).face == 3);
}

TEST_CASE("factor cube: eight factors worked by hand") {
    using factors = std::array<double, 8>;
    const auto near = [](const factors& a, const factors& b) { return largest_error(a, b) < 1e-12; };
    CHECK(near(eight_factors({3, 0, 1}), factors{1, 0, 0, 0, 0, 0, 0, 0}));
    CHECK(near(eight_factors({0, 2, -5}), factors{0, 0, 1, 0, 0, 0, 0, 0}));
    CHECK(near(eight_factors({-1, -1, 0}), factors{0, 0, 0, 0, 0, 1, 0, 0}));
    CHECK(near(eight_factors(direction(22.5 / 360, 10)), factors{0.5, 0.5, 0, 0, 0, 0, 0, 0}));
    // 100 = 2 * 45 + 10 and 350 = 7 * 45 + 35 degrees.
    CHECK(near(eight_factors(direction(100.0 / 360, 70)), factors{0, 0, 35.0 / 45, 10.0 / 45, 0, 0, 0, 0}));
    CHECK(near(eight_factors(direction(350.0 / 360, -20)), factors{35.0 / 45, 0, 0, 0, 0, 0, 0, 10.0 / 45}));
    CHECK(eight_factors({0, 0, 1})[0] == 1.0);
    for (int i = 0; i < 3600; ++i) {
        const glm::dvec3 d = direction(i / 3600.0, i % 89);
        const factors f = eight_factors(d);
        double sum = 0.0;
        for (const double v : f) sum += v;
        CHECK(std::abs(sum - 1.0) < 1e-15);
        CHECK(largest_error(f, true_factors(d)) < 1e-12);
    }
}

TEST_CASE("factor cube: golden bytes of two texels a side") {
    // Directions of the texel centers by the OpenGL table, angles by atan2, in another language.
    constexpr int published[96] = {
        180, 203, 128, 128, 180, 203, 128, 128, 180, 128, 128, 52,  180, 128, 128, 52,   // +x
        75,  128, 128, 203, 75,  128, 128, 203, 75,  52,  128, 128, 75,  52,  128, 128,  // -x
        128, 128, 180, 203, 128, 203, 180, 128, 128, 128, 180, 203, 128, 203, 180, 128,  // +y
        128, 52,  75,  128, 128, 128, 75,  52,  128, 52,  75,  128, 128, 128, 75,  52,   // -y
        128, 128, 128, 255, 128, 255, 128, 128, 128, 0,   128, 128, 128, 128, 128, 0,    // +z
        128, 255, 128, 128, 128, 128, 128, 255, 128, 128, 128, 0,   128, 0,   128, 128   // -z
    };
    constexpr int biased[96] = {
        180, 203, 128, 128, 180, 203, 128, 128, 180, 128, 128, 53,  180, 128, 128, 53,   // +x
        76,  128, 128, 203, 76,  128, 128, 203, 76,  53,  128, 128, 76,  53,  128, 128,  // -x
        128, 128, 180, 203, 128, 203, 180, 128, 128, 128, 180, 203, 128, 203, 180, 128,  // +y
        128, 53,  76,  128, 128, 128, 76,  53,  128, 53,  76,  128, 128, 128, 76,  53,   // -y
        128, 128, 128, 255, 128, 255, 128, 128, 128, 1,   128, 128, 128, 128, 128, 1,    // +z
        128, 255, 128, 128, 128, 128, 128, 255, 128, 128, 128, 1,   128, 1,   128, 128   // -z
    };
    const made_cube p({2, factor_form::published}), b({2, factor_form::biased});
    REQUIRE(bool(p.result));
    REQUIRE(bool(b.result));
    for (std::size_t i = 0; i < 96; ++i) {
        CAPTURE(i);
        CHECK(std::to_integer<int>(p.bytes[i]) == published[i]);
        CHECK(std::to_integer<int>(b.bytes[i]) == biased[i]);
    }
}

TEST_CASE("factor cube: sizes") {
    CHECK(layout_of(factor_cube_as_published()).required_size() == 6 * 1024);
    CHECK(factor_cube_as_published().form == factor_form::published);
    for (const int size : {1, 3, 64}) {
        const made_cube made({size, factor_form::biased});
        REQUIRE(bool(made.result));
        CHECK(made.bytes.size() == std::size_t(24 * size * size));
        // The poles of odd sizes hold 0.
        const int middle = size / 2;
        for (int c = 0; c < 4 && size % 2 == 1; ++c) {
            CHECK(made.byte(4, middle, middle, c) == 128);
            CHECK(made.byte(5, middle, middle, c) == 128);
        }
    }
}

TEST_CASE("factor cube: what a texel leaks") {
    for (const factor_form form : {factor_form::published, factor_form::biased}) {
        const made_cube made({16, form});
        // Half a step of what is stored, in factors.
        const double half_step = form == factor_form::published ? 1.0 / 255 : 0.5 / 127;
        for (int face = 0; face < 6; ++face)
            for (int row = 0; row < 16; ++row)
                for (int column = 0; column < 16; ++column) {
                    const glm::dvec3 d = from_cube({face, {(column + 0.5) / 16, (row + 0.5) / 16}});
                    const glm::vec4 texel(made.byte(face, column, row, 0), made.byte(face, column, row, 1),
                                          made.byte(face, column, row, 2), made.byte(face, column, row, 3));
                    const auto stored = decoded(form, texel / 255.0f), wanted = true_factors(d);
                    CHECK(largest_error(stored, wanted) <= half_step + 1e-6);
                    double leak = 0.0;
                    int pairs = 0;  // of opposite directions, both without a part
                    for (std::size_t c = 0; c < 4; ++c)
                        if (wanted[c] < 1e-9 && wanted[c + 4] < 1e-9) {
                            leak += stored[c] + stored[c + 4];
                            ++pairs;
                            CHECK(stored[c + 4] < 1e-6);
                        }
                    // Texel centers on a diagonal have one direction with a part, the others two.
                    CHECK((pairs == 2 || pairs == 3));
                    if (form == factor_form::published)
                        CHECK(leak == doctest::Approx(pairs / 255.0));
                    else
                        CHECK(leak < 2e-7 * pairs);
                }
    }
}

TEST_CASE("factor cube: error of a seamless bilinear sample at seams, edges and poles") {
    struct place {
        const char* name;
        double turns[2], elevation[2];
        double bound;  // without the half step of the bytes
    };
    // A tent is Lipschitz with 4/pi a radian. On the four side faces the ratio of the components is sampled every
    // 2/size and the angle moves at most as fast, so linear interpolation errs by at most 4/pi / size (reached at the
    // peaks, by an even size). On a z face, at the distance r from the pole, the mean distance to the four texels is at
    // most sqrt(2) / size, seen from the pole under that over r or a little more: (r - 2 sqrt(2) / size) is on the safe
    // side.
    const double side = 4.0 / std::numbers::pi / 16;
    const auto top = [&](double r) { return side * std::sqrt(2.0) / (r - 2.0 * std::sqrt(2.0) / 16); };
    const place places[] = {
        {"seams between side faces", {0.124, 0.126}, {-30, 30}, side},
        {"middle of side faces", {-0.06, 0.06}, {-30, 30}, side},
        {"edges to a z face", {-0.125, 0.125}, {40, 50}, top(std::tan(0.25 * std::numbers::pi - 0.0873))},
        {"z face, 55 to 63 degrees", {-0.125, 0.125}, {55, 63}, top(0.5)},
    };
    for (const factor_form form : {factor_form::published, factor_form::biased}) {
        made_cube made({16, form});
        const double half_step = form == factor_form::published ? 1.0 / 255 : 0.5 / 127;
        for (const place& p : places) {
            double worst = 0.0, sum = 0.0, leak = 0.0;
            int count = 0;
            for (int quarter = 0; quarter < 4; ++quarter)
                for (int i = 0; i <= 40; ++i)
                    for (int j = 0; j <= 40; ++j) {
                        const double turns = p.turns[0] + (p.turns[1] - p.turns[0]) * i / 40 + 0.25 * quarter;
                        const glm::dvec3 d =
                            direction(turns, p.elevation[0] + (p.elevation[1] - p.elevation[0]) * j / 40);
                        const auto got = decoded(form, sample_cube(made.view(), seamless, glm::vec3(d)));
                        const auto wanted = true_factors(d);
                        const double error = largest_error(got, wanted);
                        worst = std::max(worst, error);
                        sum += error;
                        ++count;
                        // Three neighbors away from the light nothing but the leak is left.
                        const int nearest = int(std::max_element(wanted.begin(), wanted.end()) - wanted.begin());
                        for (int away = 3; away <= 5; ++away)
                            leak = std::max(leak, got[std::size_t((nearest + away) % 8)]);
                    }
            MESSAGE(std::string(form == factor_form::published ? "published, " : "biased, ")
                    << std::string(p.name) << ": worst " << worst << ", mean " << sum / count << ", leak three away "
                    << leak);
            CHECK(worst <= p.bound + half_step + 1e-6);
            CHECK(leak <= (form == factor_form::published ? 1.0 / 255 + 1e-6 : 2e-7));
        }
        // Above the poles opposite texels cancel, and the decoded horizon is 0 but for the leak.
        for (const double z : {1.0, -1.0}) {
            const auto pole = decoded(form, sample_cube(made.view(), seamless, glm::vec3(0.0, 0.0, z)));
            for (const double f : pole) CHECK(f <= (form == factor_form::published ? 1.0 / 255 + 1e-6 : 2e-7));
        }
    }
}

TEST_CASE("factor cube: bad input leaves the texture alone") {
    const factor_cube cube{4, factor_form::biased};
    std::vector<std::byte> bytes(layout_of(cube).required_size(), std::byte(77));
    const auto with = [&](auto change) {
        texture t{bytes, layout_of(cube)};
        change(t);
        return write_factor_cube(cube, t).code();
    };
    CHECK(write_factor_cube({0, factor_form::biased}, {bytes, layout_of(cube)}).code() == error::not_positive);
    CHECK(write_factor_cube({1025, factor_form::biased}, {bytes, layout_of(cube)}).code() == error::out_of_range);
    CHECK(write_factor_cube({8, factor_form::biased}, {bytes, layout_of(cube)}).code() == error::mismatch);
    CHECK(with([](texture& t) { t.layout.format = texel_format::r8; }) == error::mismatch);
    CHECK(with([](texture& t) { t.layout.kind = texture_kind::array; }) == error::mismatch);
    CHECK(with([](texture& t) { t.layout.layers = 5; }) == error::mismatch);
    CHECK(with([](texture& t) { t.bytes = t.bytes.first(t.bytes.size() - 1); }) == error::too_small);
    CHECK(with([](texture& t) { t.bytes = {}; }) == error::too_small);
    CHECK(with([](texture& t) { t.layout.mips = 2; }) != error::none);
    CHECK(std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte(77); }));
}
