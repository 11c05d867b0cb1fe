#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/emboss_shift.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_float2.hpp>
#include <glm/geometric.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

void require(const status& s) { REQUIRE_MESSAGE(bool(s), s.message().c_str()); }

// Heights as emboss textures.
struct relief {
    explicit relief(glm::ivec2 extent, int mips = 1)
        : heights(layout_of(emboss{}, extent, mips).required_size()), inverse(heights.size()) {
        height_map = {heights, layout_of(emboss{}, extent, mips)};
        inverse_map = {inverse, layout_of(emboss{}, extent, mips)};
    }
    template <class Sample>
    explicit relief(const shapes::field<Sample>& field) : relief(field.extent) {
        emboss encoding;
        require(scaled_emboss(field.view(), encoding));
        require(pack_emboss(field.view(), encoding, height_map, inverse_map));
    }
    std::vector<std::byte> heights, inverse;
    texture height_map, inverse_map;
};

struct picture {
    explicit picture(glm::ivec2 extent, int channels = 3, int value = 0)
        : bytes(std::size_t(extent.x * extent.y * channels), std::byte(value)) {
        view = {bytes, extent, channels};
    }
    [[nodiscard]] int at(int x, int y, int c = 0) const { return std::to_integer<int>(view.at(x, y)[c]); }
    std::vector<std::byte> bytes;
    pixels view;
};

std::vector<int> numbers(const std::vector<std::byte>& bytes) {
    std::vector<int> result;
    for (const std::byte b : bytes) result.push_back(std::to_integer<int>(b));
    return result;
}

auto by(float x, float y) {
    return [=](glm::vec2) { return glm::vec2(x, y); };
}

emboss_shift_range range_of(const relief& r) {
    emboss_shift_range range;
    require(measure_emboss_shift(r.height_map, range));
    return range;
}

}  // namespace

TEST_CASE("heights and their inverse") {
    const std::array<std::uint8_t, 5> samples{0, 51, 102, 204, 255};
    auto map = tight_height_map(samples.data(), {5, 1});
    map.height_scale = 10.0;
    map.datum = 3.0;
    relief r({5, 1});
    emboss encoding;
    require(scaled_emboss(map, encoding));
    CHECK(encoding.lowest == doctest::Approx(-3.0));
    CHECK(encoding.scale == doctest::Approx(0.05));
    std::size_t clamped = 7;
    require(pack_emboss(map, encoding, r.height_map, r.inverse_map, &clamped));
    // 127.5 times 0, 0.2, 0.4, 0.8, 1, rounded; the inverse is what is missing to 128.
    CHECK(numbers(r.heights) == std::vector<int>{0, 26, 51, 102, 128});
    CHECK(numbers(r.inverse) == std::vector<int>{128, 102, 77, 26, 0});
    CHECK(clamped == 0);

    // Clamped: bytes as they are, up to half.
    require(pack_emboss(map, {.lowest = -3.0, .scale = 0.1}, r.height_map, r.inverse_map, &clamped));
    CHECK(numbers(r.heights) == std::vector<int>{0, 51, 102, 128, 128});
    CHECK(clamped == 2);

    // A flat map, and a hole.
    const std::array<float, 3> level{4.0f, -1.0f, 4.0f};
    auto flat = tight_height_map(level.data(), {3, 1});
    flat.no_data = -1.0f;
    relief f({3, 1});
    require(scaled_emboss(flat, encoding));
    require(pack_emboss(flat, encoding, f.height_map, f.inverse_map, &clamped));
    CHECK(numbers(f.heights) == std::vector<int>{0, 0, 0});
    CHECK(clamped == 0);
}

TEST_CASE("mips of both stay inverse of each other") {
    shapes::noise random(6);
    const auto field = shapes::sampled<float>({13, 9}, shapes::rough(random));
    relief r({13, 9}, 4);
    emboss encoding;
    require(scaled_emboss(field.view(), encoding));
    require(pack_emboss(field.view(), encoding, r.height_map, r.inverse_map));
    for (std::size_t i = 0; i < r.heights.size(); ++i)
        CHECK(std::to_integer<int>(r.heights[i]) + std::to_integer<int>(r.inverse[i]) == 128);
    double mean[2] = {};
    for (int i = 0; i < 13 * 9; ++i) mean[0] += std::to_integer<int>(r.heights[std::size_t(i)]) / (13.0 * 9.0);
    mean[1] = std::to_integer<int>(r.heights.back());
    CHECK(std::abs(mean[0] - mean[1]) < 1.5);
}

TEST_CASE("golden pixels of the three passes") {
    // Heights 0, 128, 0, 0 in bytes; the inverse is looked up one texel towards a light from +x.
    const std::array<float, 4> samples{0.0f, 1.0f, 0.0f, 0.0f};
    const auto map = tight_height_map(samples.data(), {4, 1});
    relief r({4, 1});
    require(pack_emboss(map, {.scale = 0.5}, r.height_map));
    picture gray({4, 1}, 1);
    require(draw_relief(r.height_map, edge_mode::repeat, by(1.0f, 0.0f), gray.view));
    // height + inverse of the next: 0 + 0, 128 + 128 saturated, 0 + 128, 0 + 128.
    CHECK(numbers(gray.bytes) == std::vector<int>{0, 255, 128, 128});
    // A quarter of a texel: 0 + (96 + 0), 128 + (0 + 32), 128, 128.
    require(draw_relief(r.height_map, edge_mode::repeat, by(0.25f, 0.0f), gray.view));
    CHECK(numbers(gray.bytes) == std::vector<int>{96, 160, 128, 128});

    picture base({4, 1});
    for (int x = 0; x < 4; ++x)
        for (int c = 0; c < 3; ++c) base.view.at(x, 0)[c] = std::byte(c == 0 ? 255 : c == 1 ? 101 : 10);
    picture out({4, 1});
    for (const emboss_passes passes : {emboss_passes::three, emboss_passes::two}) {
        require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(0.25f, 0.0f), out.view, passes));
        // Red: twice 96, 160 (saturated), 128 (saturated). Green: twice round(38.02), round(63.4), round(50.7).
        // Blue: twice round(3.8), round(6.3), round(5.02).
        CHECK(numbers(out.bytes) == std::vector<int>{192, 76, 8, 255, 126, 12, 255, 102, 10, 255, 102, 10});
    }
    // One pass rounds once: green 76.05, 126.7, 101.4; blue 7.5, 12.5, 10.04.
    require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(0.25f, 0.0f), out.view, emboss_passes::one));
    CHECK(numbers(out.bytes) == std::vector<int>{192, 76, 8, 255, 127, 13, 255, 101, 10, 255, 101, 10});
    // Colored light: 192, 76, 8 times 0.5, 1, 0.
    require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(0.25f, 0.0f), out.view, emboss_passes::three,
                        {0.5f, 1.0f, 0.0f}));
    CHECK(numbers(out.bytes) == std::vector<int>{96, 76, 0, 128, 126, 0, 128, 102, 0, 128, 102, 0});
}

TEST_CASE("the side that faces the light is brightened, for every light and edge mode") {
    const glm::ivec2 extent(40, 40);
    const relief r(shapes::sampled<float>(extent, shapes::hemisphere({19.5, 19.5}, 12.0)));
    picture gray(extent, 1);
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open})
        for (int i = 0; i < 8; ++i) {
            const glm::dvec2 d = shapes::direction(i / 8.0);
            const glm::vec2 shift =
                shader::bumpshadow_emboss_shift(glm::vec3(float(d.x), float(d.y), 0.5f), glm::vec2(1.5f));
            require(draw_relief(
                r.height_map, edge, [&](glm::vec2) { return shift; }, gray.view));
            const glm::dvec2 lit = glm::dvec2(19.5) + 9.0 * d, dark = glm::dvec2(19.5) - 9.0 * d;
            CHECK(gray.at(int(std::lround(lit.x)), int(std::lround(lit.y))) > 135);
            CHECK(gray.at(int(std::lround(dark.x)), int(std::lround(dark.y))) < 121);
            CHECK(gray.at(3, 3) == 128);
        }
}

TEST_CASE("relief follows diffuse light") {
    // On a smooth map small shifts are the slope towards the light: brightness grows with n . l.
    const glm::ivec2 extent(64, 64);
    const auto field = shapes::sampled<float>(extent, shapes::waves(extent));
    const relief r(field);
    std::vector<float> values(3 * 64 * 64);
    const normal_map n{.values = values, .extent = extent};
    require(bake_normals(field.view(), n));
    picture gray(extent, 1);
    require(draw_relief(r.height_map, edge_mode::repeat, by(2.0f, 1.0f), gray.view));
    const glm::vec3 light = glm::normalize(glm::vec3(2.0f, 1.0f, 1.0f));
    double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    const double count = 64.0 * 64.0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double p = gray.at(x, y), q = double(glm::dot(n.at(x, y), light));
            a += p / count, b += q / count, aa += p * p / count, bb += q * q / count, ab += p * q / count;
        }
    CHECK((ab - a * b) / std::sqrt((aa - a * a) * (bb - b * b)) > 0.9);
}

TEST_CASE("shifts") {
    using shader::bumpshadow_emboss_shift;
    const glm::vec2 amount(0.02f, 0.01f);
    CHECK(bumpshadow_emboss_shift({0.0f, 0.0f, 1.0f}, amount) == glm::vec2(0.0f));
    CHECK(bumpshadow_emboss_shift({0.0f, 0.0f, 0.0f}, amount) == glm::vec2(0.0f));
    CHECK(bumpshadow_emboss_shift({5.0f, 0.0f, 0.0f}, amount).x == doctest::Approx(0.02));
    CHECK(bumpshadow_emboss_shift({0.0f, -3.0f, 4.0f}, amount).y == doctest::Approx(-0.006));

    // A light near the quad: at the corners exact, between them linear, on the shared diagonal continuous.
    const glm::vec3 light(0.7f, 0.2f, 0.4f);
    const auto exact = [&](glm::vec2 p) { return bumpshadow_emboss_shift(light - glm::vec3(p.x, p.y, 0.0f), amount); };
    const quad_shift quad{{exact({0, 0}), exact({1, 0}), exact({0, 1}), exact({1, 1})}};
    CHECK(glm::length(quad({0, 0}) - exact({0, 0})) < 1e-7f);
    CHECK(glm::length(quad({1, 0}) - exact({1, 0})) < 1e-7f);
    CHECK(glm::length(quad({0, 1}) - exact({0, 1})) < 1e-7f);
    CHECK(glm::length(quad({1, 1}) - exact({1, 1})) < 1e-7f);
    const glm::vec2 middle = 0.5f * (exact({1, 0}) + exact({0, 1}));
    CHECK(glm::length(quad({0.5f, 0.5f}) - middle) < 1e-7f);
    CHECK(glm::length(quad({0.5001f, 0.5001f}) - middle) < 1e-5f);
    // Left of the light the shift goes right, right of it left.
    CHECK(quad({0.1f, 0.2f}).x > 0.0f);
    CHECK(quad({0.95f, 0.2f}).x < 0.0f);
}

TEST_CASE("the forms differ by rounding alone") {
    shapes::noise random(9);
    const glm::ivec2 extent(32, 32);
    const relief r(shapes::sampled<float>(extent, shapes::rough(random)));
    picture base(extent, 4), three(extent, 4), two(extent, 4), one(extent, 4);
    for (std::byte& b : base.bytes) b = std::byte(random.between(0, 255));
    for (const glm::vec3 color : {glm::vec3(1.0f), glm::vec3(1.0f, 0.7f, 0.3f)}) {
        const auto draw = [&](emboss_passes passes, const picture& to) {
            require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(1.3f, -0.7f), to.view, passes, color));
        };
        draw(emboss_passes::three, three);
        draw(emboss_passes::two, two);
        draw(emboss_passes::one, one);
        CHECK(two.bytes == three.bytes);
        int worst = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) {
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(one.at(x, y, c) - three.at(x, y, c)));
                CHECK(one.at(x, y, 3) == 255);
            }
        CHECK(worst >= 1);
        CHECK(worst <= (color.y == 1.0f ? 2 : 3));
        picture threaded(extent, 4);
        require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(1.3f, -0.7f), threaded.view,
                            emboss_passes::one, color, threads(3)));
        CHECK(threaded.bytes == one.bytes);
    }
    // Flat: the base texture, give or take a step.
    const relief flat(shapes::sampled<float>(extent, shapes::plane(3.0)));
    for (const emboss_passes passes : {emboss_passes::three, emboss_passes::one}) {
        require(draw_emboss(flat.height_map, edge_mode::repeat, base.view, by(1.0f, 1.0f), one.view, passes));
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                for (int c = 0; c < 3; ++c) CHECK(std::abs(one.at(x, y, c) - base.at(x, y, c)) <= 1);
    }
    // In place.
    const picture copy = base;
    require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(1.3f, -0.7f), three.view, emboss_passes::one));
    require(draw_emboss(r.height_map, edge_mode::repeat, base.view, by(1.3f, -0.7f), base.view, emboss_passes::one));
    CHECK(base.bytes == three.bytes);
}

TEST_CASE("the largest shift follows the width of the slopes") {
    const glm::ivec2 extent(96, 96);
    // A sheer step: 1.
    CHECK(range_of(relief(shapes::sampled<float>(extent, [](double x, double) {
              return std::fmod(x, 96.0) < 48.0 ? 0.0 : 1.0;
          }))).largest == 1.0f);
    // Rises and falls 4 and 8 texels wide, 24 or more apart: 0.785 times that.
    const glm::ivec2 wide(192, 192);
    for (const int width : {4, 8}) {
        const auto range = range_of(relief(shapes::sampled<float>(wide, [=](double x, double) {
            const double u = std::abs(std::fmod(x, 64.0) - 32.0);
            return std::clamp((u - 16.0) / width + 0.5, 0.0, 1.0);
        })));
        CHECK(std::abs(double(range.largest) - 0.785 * width) <= 1.0);
    }
    // Waves of 24 and 48 texels: a quarter of that; the second also so gentle that its bytes are stairs.
    for (const double length : {24.0, 48.0}) {
        const auto wave = [=](double x, double) { return std::sin(2.0 * std::numbers::pi * x / length); };
        CHECK(std::abs(double(range_of(relief(shapes::sampled<float>(wide, wave))).largest) - 0.25 * length) <= 1.0);
    }
    relief stairs(extent);
    const auto gentle =
        shapes::sampled<float>(extent, [](double x, double) { return std::sin(2.0 * std::numbers::pi * x / 48.0); });
    require(pack_emboss(gentle.view(), {.lowest = -1.0, .scale = 4.0 / 255.0}, stairs.height_map));
    CHECK(std::abs(double(range_of(stairs).largest) - 0.25 * 48.0) <= 3.0);
}

TEST_CASE("the smallest shift follows how gentle the slopes are") {
    const glm::ivec2 extent(128, 128);
    // A tent of 64 texels to either side, with a gradient in steps of 8 bits a texel: half of its texels change by a
    // step when the shift is half of what gradient 1 needs for all of them.
    const auto smallest = [&](double gradient) {
        relief r(extent);
        const auto tent = shapes::sampled<float>(extent, [=](double x, double) { return 64.0 - std::abs(x - 64.0); });
        require(pack_emboss(tent.view(), {.scale = gradient / 255.0}, r.height_map));
        return double(range_of(r).smallest);
    };
    CHECK(smallest(2.0) == 0.5);
    CHECK(smallest(0.25) == 2.0);
    CHECK(smallest(0.125) == 4.0);
}

TEST_CASE("a shift outside the range is warned of") {
    const emboss_shift_range range{0.5f, 3.0f};
    CHECK(bool(check_emboss_shift(0.5f, range)));
    CHECK(bool(check_emboss_shift(3.0f, range)));
    CHECK(check_emboss_shift(0.4f, range).code() == error::out_of_range);
    CHECK(check_emboss_shift(3.1f, range).code() == error::out_of_range);
    CHECK(check_emboss_shift(std::numeric_limits<float>::quiet_NaN(), range).code() == error::not_finite);
    // Nothing to see, nothing to hide.
    const auto flat = range_of(relief(shapes::sampled<float>({64, 64}, shapes::plane(1.0))));
    CHECK(flat.smallest == 0.0f);
    CHECK(flat.largest == 32.0f);
}

TEST_CASE("bad input writes nothing") {
    const auto field = shapes::sampled<float>({4, 4}, shapes::ramp({1.0, 0.0}));
    relief r({4, 4});
    const auto before = r.heights;
    const auto fails = [&](const status& s, error code) {
        CHECK(s.code() == code);
        CHECK(r.heights == before);
    };
    fails(pack_emboss(height_map<float>{}, {}, r.height_map), error::missing);
    fails(pack_emboss(field.view(), {.scale = -1.0}, r.height_map), error::out_of_range);
    fails(pack_emboss(field.view(), {.scale = std::numeric_limits<double>::infinity()}, r.height_map),
          error::not_finite);
    relief other({4, 5}), mipped({4, 4}, 2);
    fails(pack_emboss(field.view(), {}, other.height_map), error::mismatch);
    fails(pack_emboss(field.view(), {}, r.height_map, other.height_map), error::mismatch);
    fails(pack_emboss(field.view(), {}, r.height_map, mipped.height_map), error::mismatch);
    texture wrong = r.height_map;
    wrong.layout.format = texel_format::rg8;
    fails(pack_emboss(field.view(), {}, wrong), error::mismatch);
    wrong = r.height_map;
    wrong.bytes = wrong.bytes.first(15);
    fails(pack_emboss(field.view(), {}, wrong), error::too_small);
    auto infinite = field;
    infinite.at(1, 2) = std::numeric_limits<float>::infinity();
    fails(pack_emboss(infinite.view(), {}, r.height_map), error::not_finite);
    emboss encoding;
    CHECK(scaled_emboss(infinite.view(), encoding).code() == error::not_finite);

    picture base({4, 4}), out({4, 4}), gray({4, 4}, 1);
    const auto blank = out.bytes;
    const auto refused = [&](const const_pixels& from, const pixels& to, glm::vec3 color, error code) {
        const status s =
            draw_emboss(r.height_map, edge_mode::repeat, from, by(1.0f, 0.0f), to, emboss_passes::one, color);
        CHECK(s.code() == code);
        CHECK(out.bytes == blank);
    };
    refused(gray.view, out.view, glm::vec3(1.0f), error::too_small);
    refused(base.view, gray.view, glm::vec3(1.0f), error::too_small);
    refused(base.view, out.view, glm::vec3(1.5f), error::out_of_range);
    refused(base.view, out.view, glm::vec3(std::numeric_limits<float>::quiet_NaN()), error::out_of_range);
    refused(picture({4, 5}).view, out.view, glm::vec3(1.0f), error::mismatch);
    // A shift that is no number draws something.
    const auto nowhere = by(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
    CHECK(bool(draw_relief(r.height_map, edge_mode::repeat, nowhere, gray.view)));
    emboss_shift_range range;
    CHECK(measure_emboss_shift(r.height_map, range, 0).code() == error::not_positive);
    CHECK(measure_emboss_shift(wrong, range).code() == error::too_small);
    CHECK(fetches(emboss{}) == 2);
    CHECK(layout_of(emboss{}, {4, 4}).bytes_per_texel({4, 4}) == 1.0);
}
