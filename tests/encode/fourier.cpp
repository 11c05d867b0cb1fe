#include <bumpshadow/encode/fourier.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/quantize.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "support/textures.hpp"

using namespace bumpshadow;

namespace {

constexpr double pi = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();

// The horizon that the shader decodes.
float decoded(const fourier& encoding, const textures& t, int x, int y, glm::vec2 light) {
    using namespace shader;
    const fourier_decoding d = decoding_of(encoding);
    const auto four = [&](std::size_t i) {
        return encoding.square_root ? bumpshadow_fourier_root_texel(t.texel(i, x, y), d.scale[i], d.offset[i])
                                    : bumpshadow_fourier_texel(t.texel(i, x, y), d.scale[i], d.offset[i]);
    };
    const auto constant = [&](std::size_t i) {
        const float v = t.texel(i, x, y).x;
        return encoding.square_root ? bumpshadow_fourier_root_constant(v, d.constant_scale, d.constant_offset)
                                    : v * d.constant_scale + d.constant_offset;
    };
    const vec2 direction = bumpshadow_fourier_direction(light);
    switch (encoding.coefficients) {
        case 3: return bumpshadow_fourier_3(vec3(four(0)), direction);
        case 5: return bumpshadow_fourier_5(four(0), constant(1), direction);
        case 7: return bumpshadow_fourier_7(four(0), vec3(four(1)), direction);
        default: return bumpshadow_fourier_9(four(0), four(1), constant(2), direction);
    }
}

// Angle of the post: x = sin t, y = cos t.
double post_angle(glm::dvec2 d) { return std::atan2(d.x, d.y); }

// One texel whose horizon, over max_slope 4, is profile(t).
horizons one_texel(const std::vector<glm::dvec2>& directions, const std::function<double(double)>& profile) {
    horizons h({1, 1}, int(directions.size()));
    for (std::size_t i = 0; i < directions.size(); ++i)
        h.at(int(i), 0, 0) = float(4.0 * profile(post_angle(directions[i])));
    return h;
}

horizons noisy(glm::ivec2 extent, int bearings, std::uint64_t seed) {
    shapes::noise noise(seed);
    horizons h(extent, bearings);
    for (float& s : h.slopes) s = float(noise.uniform() * 3.0 - 0.5);
    return h;
}

glm::vec2 light_at(double t, double length = 1.0) { return glm::vec2(std::sin(t) * length, std::cos(t) * length); }

fourier with(int coefficients, int bits = 8, bool root = false) {
    fourier encoding;
    encoding.coefficients = coefficients;
    encoding.bits = bits;
    encoding.square_root = root;
    return encoding;
}

const std::initializer_list<fourier> all_forms = {with(3),     with(5),           with(7),          with(9),
                                                  with(5, 16), with(9, 16, true), with(5, 8, true), with(7, 16)};

}  // namespace

TEST_CASE("fourier: bytes of known horizons, worked by hand") {
    const auto directions = shapes::directions(32);
    const auto pack = [&](const fourier& encoding, const std::function<double(double)>& profile) {
        horizons h = one_texel(directions, profile);
        textures out(encoding, {1, 1});
        REQUIRE(bool(pack_fourier(h.view(), directions, encoding, {}, out.views)));
        return out;
    };
    const auto check = [](const textures& t, std::initializer_list<int> bands, int constant) {
        std::size_t i = 0;
        for (const int b : bands) CHECK(t.byte(0, i++) == b);
        CHECK(t.byte(1, 0) == constant);
    };
    // 0.4 all around: 0.4 * 255 = 102, no bands.
    check(pack(with(5), [](double) { return 0.4; }), {128, 128, 128, 128}, 102);
    // 0.6 + 0.4 cos t: mean(h cos t) is 0.2: 153 and 128 + 127 pi / 5 = 207.8.
    check(pack(with(5), [](double t) { return 0.6 + 0.4 * std::cos(t); }), {128, 208, 128, 128}, 153);
    // 0.31 - 0.2 sin 2t: 79.05 and 128 - 127 pi / 10 = 88.1.
    check(pack(with(5), [](double t) { return 0.31 - 0.2 * std::sin(2 * t); }), {128, 128, 88, 128}, 79);
    // The order of 3, 7 and 9; channels without a coefficient are 255. 128 + 127 pi / 10 = 167.9.
    const textures three = pack(with(3), [](double t) { return 0.4 + 0.2 * std::sin(t); });
    for (std::size_t i = 0; i < 4; ++i) CHECK(three.byte(0, i) == std::array{168, 128, 102, 255}[i]);
    const textures seven = pack(with(7), [](double t) { return 0.4 + 0.2 * std::cos(3 * t); });
    for (std::size_t i = 0; i < 4; ++i) CHECK(seven.byte(1, i) == std::array{128, 168, 102, 255}[i]);
    const textures nine = pack(with(9), [](double t) { return 0.4 + 0.2 * std::sin(4 * t); });
    for (std::size_t i = 0; i < 4; ++i) CHECK(nine.byte(1, i) == std::array{128, 128, 168, 128}[i]);
    CHECK(nine.byte(2, 0) == 102);
    // Roots: 128 + 127 sqrt(pi / 5) = 228.7, sqrt(0.55) 255 = 189.1.
    check(pack(with(5, 8, true), [](double t) { return 0.55 + 0.4 * std::cos(t); }), {128, 229, 128, 128}, 189);
    // 16 bits, little-endian: 0.4 * 65535 = 26214, 32768 + 32767 pi / 10 = 43062.1.
    const textures wide = pack(with(5, 16), [](double t) { return 0.4 + 0.2 * std::sin(2 * t); });
    CHECK((wide.byte(1, 0) | wide.byte(1, 1) << 8) == 26214);
    CHECK((wide.byte(0, 4) | wide.byte(0, 5) << 8) == 43062);
    CHECK((wide.byte(0, 0) | wide.byte(0, 1) << 8) == 32768);
}

TEST_CASE("fourier: sizes") {
    const int bytes[4] = {4, 5, 8, 9}, counts[4] = {1, 2, 2, 3};
    for (int i = 0; i < 4; ++i) {
        const fourier narrow = with(3 + 2 * i), wide = with(3 + 2 * i, 16);
        CHECK(texture_count(narrow) == counts[i]);
        CHECK(fetches(narrow) == counts[i]);
        double sum = 0.0, wide_sum = 0.0;
        for (int t = 0; t < counts[i]; ++t) {
            sum += layout_of(narrow, {8, 4}, 1, t).bytes_per_texel({8, 4});
            wide_sum += layout_of(wide, {8, 4}, 1, t).bytes_per_texel({8, 4});
        }
        CHECK(sum == bytes[i]);
        CHECK(wide_sum == 2 * bytes[i]);
    }
}

TEST_CASE("fourier: a step, and the bound of the coefficients") {
    // 1 on the side of +y, 0 on the other, half a step off the axes. The mean of the positive half of cos t over 32
    // samples at odd multiples of pi/32 is 1 / (32 sin(pi/32)), 0.16 % above 1/pi: clamped and counted.
    const auto directions = shapes::directions(32, 1.0 / 64);
    horizons h = one_texel(directions, [](double t) { return std::cos(t) > 0.0 ? 1.0 : 0.0; });
    pack_report report;
    pack_options options;
    options.report = &report;
    textures out(with(5), {1, 1});
    REQUIRE(bool(pack_fourier(h.view(), directions, with(5), options, out.views)));
    const int golden[4] = {128, 255, 128, 128};
    for (std::size_t i = 0; i < 4; ++i) CHECK(out.byte(0, i) == golden[i]);
    CHECK(std::abs(out.byte(1, 0) - 127.5) == 0.5);
    CHECK(report.clamped == 1);
    CHECK(report.steepest == 4.0f);
    fourier tight = with(5);
    REQUIRE(bool(tighten_ranges(h.view(), directions, tight, options)));
    CHECK(double(tight.ranges[2].high) == doctest::Approx(1.0 / (32 * std::sin(pi / 32))));

    // No horizon of 0 to 1 leads farther than the one that is 1 where the term is positive.
    shapes::noise noise(21);
    for (const int count : {16, 32, 48}) {
        const auto around = shapes::directions(count, 0.3 / count);
        for (int n = 0; n < 300; ++n) {
            const int order = noise.between(1, 4);
            const double phase = noise.uniform() * 2 * pi;
            const bool extreme = n % 2 == 0;
            horizons some = one_texel(around, [&](double t) {
                return extreme ? (std::sin(order * t + phase) > 0 ? 1.0 : 0.0) : noise.uniform();
            });
            fourier encoding = with(9);
            REQUIRE(bool(tighten_ranges(some.view(), around, encoding, {})));
            for (int i = 1; i < 9; ++i) {
                const int k = (i + 1) / 2;
                const double x = pi * k / count;
                CHECK(std::abs(double(encoding.ranges[std::size_t(i)].high)) <=
                      double(fourier_bound) * x / std::sin(x) + 1e-6);
                CHECK(encoding.ranges[std::size_t(i)].low == encoding.ranges[std::size_t(i)].high);
            }
            CHECK((encoding.ranges[0].low >= 0.0f && encoding.ranges[0].high <= 1.0f + 1e-6f));
        }
    }
}

TEST_CASE("fourier: what the shader decodes is the truncated series") {
    horizons h = noisy({600, 3}, 48, 31);
    const auto directions = shapes::directions(48);
    for (const fourier& encoding : all_forms) {
        CAPTURE(encoding.coefficients);
        CAPTURE(encoding.bits);
        textures out(encoding, h.extent);
        REQUIRE(bool(pack_fourier(h.view(), directions, encoding, {}, out.views)));
        // Half a step in each number, doubled for the bands, whose terms are pairs of a sine and a cosine; roots grow
        // by at most twice the largest root where they are squared.
        const int order = encoding.coefficients / 2;
        const double last = encoding.bits == 8 ? 255.0 : 65535.0, root = encoding.square_root ? 2.0 : 1.0;
        const double step = 0.5 / last * (1.0 + 2.0 * order * std::sqrt(2.0) * 2.0 / pi * 255 / 254);
        const double bound = root * step + 1e-6;
        double worst = 0.0;
        for (int n = 0; n < 900; ++n) {
            const int x = (n * 7) % 600, y = n % 3;
            const double at = n * 0.0123;
            double series = 0.0;
            for (int k = 0; k <= order; ++k) {
                double s = 0.0, c = 0.0;
                for (std::size_t m = 0; m < directions.size(); ++m) {
                    const double value = std::clamp(double(h.at(int(m), x, y)) / 4.0, 0.0, 1.0);
                    s += value * std::sin(k * post_angle(directions[m])) / 48.0;
                    c += value * std::cos(k * post_angle(directions[m])) / 48.0;
                }
                series += (k == 0 ? 1.0 : 2.0) * (s * std::sin(k * at) + c * std::cos(k * at));
            }
            const double got = double(decoded(encoding, out, x, y, light_at(at, 0.1 + n)));
            worst = std::max(worst, std::abs(got - series));
        }
        CHECK(worst <= bound);
    }
}

TEST_CASE("fourier: uneven directions are fitted, as by the normal equations") {
    shapes::noise noise(41);
    std::vector<glm::dvec2> directions;
    for (int i = 0; i < 23; ++i) directions.push_back(2.5 * shapes::direction(noise.uniform()));
    horizons h = one_texel(directions, [&](double) { return noise.uniform(); });
    for (const int count : {3, 5, 7, 9}) {
        fourier encoding = with(count);
        REQUIRE(bool(tighten_ranges(h.view(), directions, encoding, {})));
        double a[9][10] = {};
        for (std::size_t m = 0; m < directions.size(); ++m) {
            double terms[9];
            for (int i = 0; i < count; ++i) {
                const int k = (i + 1) / 2;
                const double angle = k * post_angle(directions[m]);
                terms[i] = i % 2 == 0 ? std::cos(angle) : std::sin(angle);
            }
            for (int i = 0; i < count; ++i) {
                for (int j = 0; j < count; ++j) a[i][j] += terms[i] * terms[j];
                a[i][count] += terms[i] * double(h.at(int(m), 0, 0)) / 4.0;
            }
        }
        for (int i = 0; i < count; ++i)
            for (int r = 0; r < count; ++r)
                if (r != i)
                    for (int c = count; c >= i; --c) a[r][c] -= a[r][i] / a[i][i] * a[i][c];
        for (int i = 0; i < count; ++i) {
            const double half = i == 0 ? 1.0 : 0.5;
            CHECK(double(encoding.ranges[std::size_t(i)].low) ==
                  doctest::Approx(half * a[i][count] / a[i][i]).epsilon(1e-4));
        }
    }
    // A horizon that is a series comes back as it was.
    horizons series = one_texel(directions, [](double t) { return 0.5 + 0.1 * std::sin(t) - 0.3 * std::cos(2 * t); });
    textures out(with(5, 16), {1, 1});
    REQUIRE(bool(pack_fourier(series.view(), directions, with(5, 16), {}, out.views)));
    for (double t = 0.0; t < 6.3; t += 0.1)
        CHECK(double(decoded(with(5, 16), out, 0, 0, light_at(t))) ==
              doctest::Approx(0.5 + 0.1 * std::sin(t) - 0.3 * std::cos(2 * t)).epsilon(2e-4));
}

TEST_CASE("fourier: flat texels decode to 0, and no direction to the constant") {
    horizons flat({2, 1}, 16);
    for (int i = 0; i < 16; ++i) {
        flat.at(i, 0, 0) = no_horizon;
        flat.at(i, 1, 0) = -1.0f;
    }
    const auto directions = shapes::directions(16);
    for (const fourier& encoding : all_forms) {
        textures out(encoding, flat.extent);
        REQUIRE(bool(pack_fourier(flat.view(), directions, encoding, {}, out.views)));
        for (double t = 0.0; t < 6.3; t += 0.05) {
            CHECK(std::abs(decoded(encoding, out, 0, 0, light_at(t))) < 1e-6f);
            CHECK(std::abs(decoded(encoding, out, 1, 0, light_at(t))) < 1e-6f);
        }
    }
    // In the ranges of the post 0 is half way between two numbers.
    textures posted(fourier_as_posted(), flat.extent);
    REQUIRE(bool(pack_fourier(flat.view(), directions, fourier_as_posted(), {}, posted.views)));
    for (std::size_t i = 0; i < 4; ++i) CHECK(posted.byte(0, i) == 128);

    horizons h = noisy({4, 4}, 16, 51);
    for (const fourier& encoding : all_forms) {
        textures out(encoding, h.extent);
        REQUIRE(bool(pack_fourier(h.view(), directions, encoding, {}, out.views)));
        double mean = 0.0;
        for (int i = 0; i < 16; ++i) mean += std::clamp(double(h.at(i, 2, 1)) / 4.0, 0.0, 1.0) / 16;
        const double got = double(decoded(encoding, out, 2, 1, glm::vec2(0.0f)));
        CHECK(std::abs(got - mean) < (encoding.square_root ? 2.0 : 1.0) * 0.5 / 255 + 1e-6);
    }
}

TEST_CASE("fourier: the range of the map") {
    horizons h = noisy({40, 20}, 32, 61);
    for (int i = 0; i < 32; ++i) h.at(i, 3, 3) = 1.0f;
    const auto directions = shapes::directions(32);
    fourier tight = with(5), again = with(5);
    REQUIRE(bool(tighten_ranges(h.view(), directions, tight, {})));
    again.ranges.fill({std::numeric_limits<float>::quiet_NaN(), -1.0f});  // not looked at
    REQUIRE(bool(tighten_ranges(h.view(), directions, again, {}, threads(3))));
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(tight.ranges[i].low == again.ranges[i].low);
        CHECK(tight.ranges[i].high == again.ranges[i].high);
        CHECK(tight.ranges[i].low < tight.ranges[i].high);
        CHECK(tight.ranges[i].high - tight.ranges[i].low < (i == 0 ? 1.0f : 2.0f * fourier_bound));
    }
    pack_report report;
    pack_options options;
    options.report = &report;
    for (const bool root : {false, true}) {
        tight.square_root = root;
        textures out(tight, h.extent);
        REQUIRE(bool(pack_fourier(h.view(), directions, tight, options, out.views)));
        CHECK(report.clamped == 0);
        // The texel whose horizon is 0.25 all around has no bands, and they decode to 0.
        for (double t = 0.0; t < 6.3; t += 0.1)
            CHECK(std::abs(decoded(tight, out, 3, 3, light_at(t)) - 0.25f) < (root ? 0.003f : 0.001f));
    }
    // All texels alike: nothing to store, and the range says it.
    horizons even({3, 3}, 16);
    std::fill(even.slopes.begin(), even.slopes.end(), 1.0f);
    fourier same = with(9);
    REQUIRE(bool(tighten_ranges(even.view(), shapes::directions(16), same, {})));
    textures out(same, even.extent);
    REQUIRE(bool(pack_fourier(even.view(), shapes::directions(16), same, {}, out.views)));
    CHECK(double(decoded(same, out, 1, 1, light_at(1.0))) == doctest::Approx(0.25).epsilon(1e-6));
}

namespace {

// The listing of the post, its two textures already fetched; `squared`: with the two lines that undo the compression.
float listing(glm::vec3 light, glm::vec4 lq_texel, float c_texel, bool squared) {
    using namespace glm;
    vec4 lqCoefs = lq_texel * 4.0f - 2.0f;  // Premultiply by 2
    float cCoef = c_texel * 2.0f - 1.0f;
    if (squared) {
        lqCoefs *= abs(lqCoefs);
        cCoef *= abs(cCoef);
    }
    const vec2 r = vec2(normalize(vec3(light.x, light.y, 0.0f)));
    const vec3 q = vec3(r.x, r.y, r.x) * vec3(r.y, r.y, r.x) * vec3(2.0f, 1.0f, -1.0f);
    const float horizon = cCoef + dot(vec2(lqCoefs.x, lqCoefs.y), r) + dot(vec3(lqCoefs.z, lqCoefs.w, lqCoefs.w), q);
    return clamp(0.5f + 20.0f * (light.z - horizon), 0.0f, 1.0f);
}

}  // namespace

TEST_CASE("fourier: the listing of the post where it is right, and where it is not") {
    const auto directions = shapes::directions(32);
    horizons h = noisy({20, 20}, 32, 71);
    fourier encoding = fourier_as_posted();
    const auto shadow = [&](const textures& t, int x, int y, glm::vec3 light) {
        return shader::bumpshadow_shadow_soft(shader::bumpshadow_sine(light),
                                              decoded(encoding, t, x, y, glm::vec2(light)), fourier_posted_k,
                                              fourier_posted_c);
    };
    int graded = 0, differ = 0;
    for (const bool root : {false, true}) {
        encoding.square_root = root;
        textures out(encoding, h.extent);
        REQUIRE(bool(pack_fourier(h.view(), directions, encoding, {}, out.views)));
        for (int n = 0; n < 400; ++n) {
            const int x = n % 20, y = n / 20;
            glm::vec4 texel = out.texel(0, x, y);
            const float constant = out.texel(1, x, y).x;
            const float horizon = decoded(encoding, out, x, y, light_at(n));
            // Near the horizon, where the edge is, and unit length.
            const float z = std::clamp(horizon + 0.02f * float(n % 3 - 1), 0.0f, 0.9f);
            const glm::vec3 light(light_at(n) * std::sqrt(1.0f - z * z), z);
            const float ours = shadow(out, x, y, light);
            graded += ours > 0.0f && ours < 1.0f;
            if (!root) {
                // Right without the compression: phase, order, doubling and edge agree.
                CHECK(std::abs(ours - listing(light, texel, constant, false)) < 1e-4f);
            } else {
                // With it the stored bands are doubled before they are squared, so they count 4 times instead of
                // twice. Stored bands over sqrt 2 undo that, and then the listing is right.
                differ += std::abs(ours - listing(light, texel, constant, true)) > 0.05f;
                texel = (texel - 0.5f) * 0.70710678f + 0.5f;
                CHECK(std::abs(ours - listing(light, texel, constant, true)) < 1e-4f);
            }
        }
        // A light that is not normalized: the listing compares its z as it comes, ours its sine.
        const glm::vec3 light(0.3f, 0.4f, 0.05f);
        CHECK(std::abs(shadow(out, 4, 4, 2.0f * light) - shadow(out, 4, 4, light)) < 1e-5f);
    }
    CHECK(graded > 400);
    CHECK(differ > 100);
    // Straight up the listing divides by 0.
    CHECK(std::isnan(listing({0.0f, 0.0f, 1.0f}, glm::vec4(0.6f), 0.6f, false)));
}

TEST_CASE("fourier: sines and angles") {
    const auto directions = shapes::directions(16);
    horizons h({1, 1}, 16);
    std::fill(h.slopes.begin(), h.slopes.end(), 0.75f);
    for (const quantity stored : {quantity::sine, quantity::angle}) {
        fourier encoding = with(5, 16);
        encoding.scale = {stored, infinity};
        textures out(encoding, {1, 1});
        REQUIRE(bool(pack_fourier(h.view(), directions, encoding, {}, out.views)));
        const double wanted = stored == quantity::sine ? 0.6 : std::atan(0.75) / (pi / 2);
        CHECK(double(decoded(encoding, out, 0, 0, light_at(2.0))) == doctest::Approx(wanted).epsilon(1e-4));
    }
}

TEST_CASE("fourier: levels, executors and scratch") {
    horizons h = noisy({530, 37}, 16, 81), small = noisy({265, 18}, 16, 82);
    const auto directions = shapes::directions(16);
    const horizon_map levels[2] = {h.view(), small.view()};
    for (const fourier& encoding : all_forms) {
        textures one(encoding, h.extent, 2), two(encoding, h.extent, 2), second(encoding, small.extent);
        std::vector<std::byte> scratch(fourier_scratch_size(h.extent, 16, encoding));
        pack_options options;
        options.scratch = scratch;
        REQUIRE(bool(pack_fourier(levels, directions, encoding, options, one.views)));
        REQUIRE(bool(pack_fourier(levels, directions, encoding, {}, two.views, threads(3))));
        REQUIRE(bool(pack_fourier(small.view(), directions, encoding, {}, second.views)));
        CHECK(one.bytes == two.bytes);
        for (std::size_t i = 0; i < one.views.size(); ++i)
            CHECK(std::equal(second.bytes[i].begin(), second.bytes[i].end(), one.views[i].slice(0, 1)));
    }
}

TEST_CASE("fourier: bad input leaves the textures alone") {
    horizons h = noisy({4, 4}, 16, 91);
    const auto directions = shapes::directions(16);
    const fourier encoding = with(5);
    textures out(encoding, h.extent);
    const std::span<const texture> views(out.views);
    const auto code = [&](const fourier& e) { return pack_fourier(h.view(), directions, e, {}, views).code(); };
    CHECK(code(with(4)) == error::not_supported);
    CHECK(code(with(11)) == error::not_supported);
    CHECK(code(with(5, 12)) == error::not_supported);
    CHECK(code(with(9)) == error::mismatch);
    CHECK(code(with(5, 16)) == error::mismatch);
    fourier bad = encoding;
    bad.ranges[2] = {1.0f, -1.0f};
    CHECK(code(bad) == error::out_of_range);
    bad.ranges[2] = {-1.1f * largest_fourier_range, 1.0f};
    CHECK(code(bad) == error::out_of_range);
    bad.ranges[2] = {0.0f, 1.1f * largest_fourier_range};
    CHECK(code(bad) == error::out_of_range);
    bad.ranges[2] = {0.0f, infinity};
    CHECK(code(bad) == error::not_finite);
    bad = encoding;
    bad.scale.max_slope = -1.0f;
    CHECK(code(bad) == error::not_positive);
    CHECK(tighten_ranges(h.view(), directions, bad, {}).code() == error::not_positive);
    CHECK(pack_fourier(h.view(), directions, encoding, {}, {}).code() == error::mismatch);
    CHECK(pack_fourier(h.view(), shapes::directions(15), encoding, {}, views).code() == error::mismatch);
    CHECK(pack_fourier(std::span<const horizon_map>(), directions, encoding, {}, views).code() == error::missing);
    horizons four = noisy({4, 4}, 4, 92);
    CHECK(pack_fourier(four.view(), shapes::directions(4), encoding, {}, views).code() == error::too_small);
    // Sixteen directions, four different ones.
    std::vector<glm::dvec2> few;
    for (int i = 0; i < 16; ++i) few.push_back(shapes::direction(0.25 * (i % 4)));
    CHECK(pack_fourier(h.view(), few, encoding, {}, views).code() == error::out_of_range);
    few[3] = {0.0, 0.0};
    CHECK(pack_fourier(h.view(), few, encoding, {}, views).code() == error::not_positive);
    texture shorter[2] = {out.views[0], out.views[1]};
    shorter[1].bytes = shorter[1].bytes.first(15);
    CHECK(pack_fourier(h.view(), directions, encoding, {}, shorter).code() == error::too_small);
    horizon_map empty = h.view();
    empty.extent = {0, 0};
    CHECK(!pack_fourier(empty, directions, encoding, {}, views));
    pack_options little;
    std::byte scratch[16];
    little.scratch = scratch;
    CHECK(pack_fourier(h.view(), directions, encoding, little, views).code() == error::too_small);
    CHECK(out.untouched());
}
