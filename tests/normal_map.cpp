#include <bumpshadow/normal_map.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include "support/reserved.hpp"
#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

struct normals {
    explicit normals(glm::ivec2 size) : values(3 * std::size_t(size.x) * std::size_t(size.y)), extent(size) {}
    [[nodiscard]] normal_map view() { return {.values = values, .extent = extent}; }

    std::vector<float> values;
    glm::ivec2 extent;
};

template <class Sample>
normals baked(const height_map<Sample>& map) {
    normals result(map.extent);
    const status s = bake_normals(map, result.view());
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    return result;
}

double degrees_between(glm::vec3 a, glm::vec3 b) {
    // Of the chord: the arc cosine of float vectors knows no angles below 0.03 degrees.
    const glm::dvec3 u = glm::normalize(glm::dvec3(a)), v = glm::normalize(glm::dvec3(b));
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(u - v))) * 180.0 / std::numbers::pi;
}

// Slopes at the first two and the last texel of the heights 0, 1, 4, 9, central differences worked out by hand.
struct edge_case {
    edge_mode edge;
    double left, second, right;
};

}  // namespace

TEST_CASE("normals of a plane, in units of texel_size") {
    const auto field = shapes::sampled({7, 5}, shapes::ramp({0.5, -2.0}));
    auto map = field.view(edge_mode::open);
    map.texel_size = {2.0, 0.5};
    map.height_scale = 3.0;
    // dz/dx = 0.5 * 3 / 2, dz/dy = -2 * 3 / 0.5; one-sided differences of a plane are as good as central ones.
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.75, 12.0, 1.0));
    auto n = baked(map);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x)
            for (int c = 0; c < 3; ++c)
                CHECK(double(n.view().at(x, y)[c]) == doctest::Approx(expected[c]).epsilon(1e-6));
}

TEST_CASE("borders") {
    const std::array<float, 4> heights{0, 1, 4, 9};
    for (const edge_case& c : {edge_case{edge_mode::open, 1.0, 2.0, 5.0},
                               {edge_mode::clamp, 0.5, 2.0, 2.5},
                               {edge_mode::mirror, 0.5, 2.0, 2.5},
                               {edge_mode::repeat, -4.0, 2.0, -2.0}}) {
        auto along_x = tight_height_map(heights.data(), {4, 1});
        along_x.edge = c.edge;
        auto n = baked(along_x);
        CHECK(-n.view().at(0, 0).x / n.view().at(0, 0).z == doctest::Approx(c.left));
        CHECK(-n.view().at(1, 0).x / n.view().at(1, 0).z == doctest::Approx(c.second));
        CHECK(-n.view().at(3, 0).x / n.view().at(3, 0).z == doctest::Approx(c.right));
        CHECK(n.view().at(1, 0).y == 0.0f);
        auto along_y = tight_height_map(heights.data(), {1, 4});
        along_y.edge = c.edge;
        auto m = baked(along_y);
        CHECK(-m.view().at(0, 0).y / m.view().at(0, 0).z == doctest::Approx(c.left));
        CHECK(-m.view().at(0, 1).y / m.view().at(0, 1).z == doctest::Approx(c.second));
        CHECK(-m.view().at(0, 3).y / m.view().at(0, 3).z == doctest::Approx(c.right));
        CHECK(m.view().at(0, 1).x == 0.0f);
    }
}

TEST_CASE("holes have no normal and are no neighbors") {
    const std::array<std::uint8_t, 9> heights{10, 20, 40, 10, 99, 40, 10, 20, 40};
    auto map = tight_height_map(heights.data(), {3, 3});
    map.height_scale = 255.0;
    map.edge = edge_mode::open;
    map.no_data = std::uint8_t(99);
    auto n = baked(map);
    CHECK(n.view().at(1, 1) == glm::vec3(0.0f));
    CHECK(n.view().at(0, 1) == glm::vec3(0.0f, 0.0f, 1.0f));  // nothing left on its row
    CHECK(-n.view().at(1, 0).x / n.view().at(1, 0).z == doctest::Approx(15.0));
    CHECK(n.view().at(1, 0).y == 0.0f);  // below is the hole, above nothing
}

TEST_CASE("sample types, regions and executors agree") {
    shapes::noise random(3);
    const auto bytes = shapes::sampled<std::uint8_t>({37, 41}, [&](double, double) { return random.between(0, 255); });
    const auto doubles =
        shapes::sampled({37, 41}, [&](double x, double y) { return double(bytes.at(int(x), int(y))) / 255.0; });
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open}) {
        auto a = bytes.view(edge);
        auto b = doubles.view(edge);
        a.height_scale = b.height_scale = 7.0;
        auto n = baked(a), m = baked(b);
        for (std::size_t i = 0; i < n.values.size(); ++i)
            CHECK(n.values[i] == doctest::Approx(double(m.values[i])).epsilon(1e-5));
        normals threaded(a.extent);
        REQUIRE(bool(bake_normals(a, threaded.view(), {}, threads(3))));
        CHECK(threaded.values == n.values);
        // With holes named that do not occur, every texel goes the careful way.
        b.no_data = -1.0;
        auto careful = baked(b);
        for (std::size_t i = 0; i < n.values.size(); ++i) CHECK(std::abs(careful.values[i] - m.values[i]) < 1e-6f);
        const rectangle regions[] = {{{0, 0}, {1, 1}}, {{36, 40}, {1, 1}}, {{5, 7}, {20, 30}}, {{0, 40}, {37, 1}}};
        for (const rectangle& region : regions) {
            normals part(region.extent);
            REQUIRE(bool(bake_normals(a, part.view(), region)));
            for (int y = 0; y < region.extent.y; ++y)
                for (int x = 0; x < region.extent.x; ++x)
                    CHECK(part.view().at(x, y) == n.view().at(x + region.origin.x, y + region.origin.y));
        }
    }
}

TEST_CASE("bytes of a normal map") {
    normals n({4, 1});
    const glm::vec3 leaning(0.6f, -0.48f, 0.64f);
    n.view().set(0, 0, {0.0f, 0.0f, 1.0f});
    n.view().set(1, 0, leaning);
    n.view().set(2, 0, {-1.0f, 0.0f, 0.0f});
    std::array<std::byte, 16> bytes{};
    const auto written = [&](const normal_encoding& encoding, int channels) {
        bytes.fill(std::byte(7));
        const status s = encode_normals(n.view(), encoding, {bytes, {4, 1}, channels});
        REQUIRE_MESSAGE(bool(s), s.message().c_str());
        std::vector<int> values;
        for (int i = 0; i < 4 * channels; ++i) values.push_back(std::to_integer<int>(bytes[std::size_t(i)]));
        return values;
    };
    // 255 (1 + v) / 2, rounded: 0.6 -> 204, -0.48 -> 66.3, 0.48 -> 188.7, 0.64 -> 209.1.
    CHECK(written({.y = normal_y::down}, 4) ==
          std::vector<int>{128, 128, 255, 255, 204, 66, 209, 255, 0, 128, 128, 255, 128, 128, 128, 255});
    CHECK(written({.y = normal_y::up}, 3) ==
          std::vector<int>{128, 128, 255, 204, 189, 209, 0, 128, 128, 128, 128, 128});
    // dz/dx = -0.9375, dz/dy = 0.75; over 2: -0.46875, 0.375.
    CHECK(written({normal_form::derivatives, normal_y::down, 2.0f}, 2) ==
          std::vector<int>{128, 128, 68, 175, 255, 128, 128, 128});
    CHECK(written({normal_form::derivatives, normal_y::up, 2.0f}, 4) ==
          std::vector<int>{128, 128, 0, 255, 68, 80, 0, 255, 255, 128, 0, 255, 128, 128, 0, 255});
}

TEST_CASE("bytes back to normals") {
    shapes::noise random(8);
    constexpr int count = 4000;
    normals n({count, 1}), decoded({count, 1});
    for (int i = 0; i < count; ++i) {
        const double turn = 2.0 * std::numbers::pi * random.uniform(), tilt = 0.7 * random.uniform();
        n.view().set(
            i, 0,
            {float(std::cos(turn) * std::sin(tilt)), float(std::sin(turn) * std::sin(tilt)), float(std::cos(tilt))});
    }
    std::vector<std::byte> bytes(4 * count);
    for (const normal_form form : {normal_form::unit, normal_form::derivatives})
        for (const normal_y y : {normal_y::down, normal_y::up})
            for (const int channels : {3, 4}) {
                const normal_encoding encoding{form, y, 1.0f};
                REQUIRE(bool(encode_normals(n.view(), encoding, {bytes, n.extent, channels})));
                REQUIRE(bool(decode_normals({bytes, n.extent, channels}, encoding, decoded.view())));
                double sum = 0.0, worst = 0.0;
                for (int i = 0; i < count; ++i) {
                    const double error = degrees_between(n.view().at(i, 0), decoded.view().at(i, 0));
                    sum += error;
                    worst = std::max(worst, error);
                }
                // Half a step of 2/255 in each of two components is 0.32 degrees, in three 0.39.
                CHECK(worst < (form == normal_form::unit ? 0.40 : 0.33));
                CHECK(sum / count < 0.25);
            }
}

TEST_CASE("planes of normals, and rows of them and of a picture, more than 2^31 apart") {
    constexpr std::size_t beyond = (std::size_t(1) << 31) + 64;
    constexpr glm::ivec2 extent(70, 3);
    const auto map = shapes::sampled<float>(extent, [](double x, double y) { return std::sin(0.3 * x) + 0.2 * y * y; });
    normals near(extent);
    REQUIRE(bool(bake_normals(map.view(edge_mode::clamp), near.view())));
    const normal_encoding encoding;
    std::vector<std::byte> bytes(4 * required_size(extent, 1));
    const pixels picture{.bytes = bytes, .extent = extent};
    REQUIRE(bool(encode_normals(near.view(), encoding, picture)));
    normals back(extent);
    REQUIRE(bool(decode_normals(picture, encoding, back.view())));

    normal_map far{.extent = extent, .row_stride = beyond};
    pixels far_picture{.extent = extent, .row_stride = beyond};
    const reserved planes(far.required_size() * sizeof(float)), rows(far_picture.required_size());
    if (planes.data() == nullptr || rows.data() == nullptr) {
        MESSAGE("skipped: no address space of ", planes.bytes() + rows.bytes(), " bytes here");
        return;
    }
    far.values = {static_cast<float*>(planes.data()), far.required_size()};
    far_picture.bytes = {static_cast<std::byte*>(rows.data()), rows.bytes()};
    const auto same = [&](const normal_map& a, const normal_map& b) {
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < extent.y; ++y)
                if (!std::equal(a.row(c, y), a.row(c, y) + extent.x, b.row(c, y))) return false;
        return true;
    };
    REQUIRE(bool(bake_normals(map.view(edge_mode::clamp), far)));
    CHECK(same(far, near.view()));
    REQUIRE(bool(encode_normals(far, encoding, far_picture)));
    for (int y = 0; y < extent.y; ++y)
        CHECK(std::equal(far_picture.row(y), far_picture.row(y) + 4 * extent.x, picture.row(y)));
    REQUIRE(bool(decode_normals(far_picture, encoding, far)));
    CHECK(same(far, back.view()));
}

TEST_CASE("normals of nothing") {
    normals n({1, 1}), decoded({1, 1});
    std::array<std::byte, 3> bytes{};
    for (const normal_form form : {normal_form::unit, normal_form::derivatives}) {
        REQUIRE(bool(encode_normals(n.view(), {.form = form}, {bytes, {1, 1}, 3})));
        REQUIRE(bool(decode_normals({bytes, {1, 1}, 3}, {.form = form}, decoded.view())));
        CHECK(degrees_between(decoded.view().at(0, 0), {0.0f, 0.0f, 1.0f}) < 0.4);
    }
}

TEST_CASE("bad input writes nothing") {
    auto field = shapes::sampled<float>({4, 4}, shapes::ramp({1.0, 1.0}));
    normals n({4, 4});
    const normals before = n;
    const auto fails = [&](const status& s, error code) {
        CHECK(s.code() == code);
        CHECK(n.values == before.values);
    };
    fails(bake_normals(height_map<float>{}, n.view()), error::missing);
    normal_map view = n.view();
    view.extent = {4, 3};
    fails(bake_normals(field.view(), view), error::mismatch);
    view = n.view();
    view.row_stride = 3;
    fails(bake_normals(field.view(), view), error::too_small);
    view.row_stride = 5;
    fails(bake_normals(field.view(), view), error::too_small);
    view = n.view();
    view.plane_stride = 15;
    fails(bake_normals(field.view(), view), error::too_small);
    view = n.view();
    view.values = view.values.first(47);
    fails(bake_normals(field.view(), view), error::too_small);
    fails(bake_normals(field.view(), n.view(), {{1, 0}, {4, 4}}), error::out_of_range);
    fails(bake_normals(field.view(), n.view(), {{0, -1}, {4, 4}}), error::out_of_range);
    field.at(3, 2) = std::numeric_limits<float>::quiet_NaN();
    const status bad = bake_normals(field.view(), n.view());
    fails(bad, error::not_finite);
    CHECK(bad.texel() == glm::ivec2(3, 2));

    std::array<std::byte, 64> bytes{};
    const auto nothing = bytes;
    const auto refused = [&](const normal_encoding& encoding, const pixels& picture, error code) {
        CHECK(encode_normals(n.view(), encoding, picture).code() == code);
        CHECK(bytes == nothing);
        CHECK(decode_normals(picture, encoding, n.view()).code() == code);
        CHECK(n.values == before.values);
    };
    const normal_encoding flat{.form = normal_form::derivatives, .max_slope = 0.0f};
    refused(flat, {bytes, {4, 4}, 4}, error::not_positive);
    refused({.max_slope = std::numeric_limits<float>::infinity()}, {bytes, {4, 4}, 4}, error::not_finite);
    refused({}, {bytes, {4, 3}, 4}, error::mismatch);
    refused({}, {bytes, {4, 4}, 2}, error::too_small);
    refused({}, {bytes, {4, 4}, 5}, error::out_of_range);
    refused({}, {std::span(bytes).first(63), {4, 4}, 4}, error::too_small);
    refused({}, {bytes, {4, 4}, 4, 15}, error::too_small);
}
