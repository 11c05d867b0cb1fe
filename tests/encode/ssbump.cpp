// The masks against numerical integration that knows nothing of the closed form, against solid angles worked out by
// hand, and against traced light.

#include <bumpshadow/encode/ssbump.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/horizon/exact.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr double pi = std::numbers::pi;

// Horizons that own their memory, `slope(x, y, turns)` at evenly spaced directions.
struct horizons {
    template <class Slope>
    horizons(glm::ivec2 extent, int bearings, Slope&& slope)
        : directions(shapes::directions(bearings)), values(required_size(extent, bearings)) {
        view = {.values = values, .extent = extent, .bearings = bearings};
        for (int i = 0; i < bearings; ++i)
            for (int y = 0; y < extent.y; ++y)
                for (int x = 0; x < extent.x; ++x) view.row(i, y)[x] = float(slope(x, y, double(i) / bearings));
    }
    std::vector<glm::dvec2> directions;
    std::vector<float> values;
    horizon_map view;
};

struct normals {
    explicit normals(glm::ivec2 extent, glm::vec3 all = {0.0f, 0.0f, 1.0f})
        : values(3 * std::size_t(extent.x) * std::size_t(extent.y)) {
        view = {.values = values, .extent = extent};
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) view.set(x, y, all);
    }
    std::vector<float> values;
    normal_map view;
};

struct masks {
    masks(const ssbump& encoding, glm::ivec2 extent, int mips = 1)
        : bytes(layout_of(encoding, extent, mips).required_size()) {
        view = {bytes, layout_of(encoding, extent, mips)};
    }
    [[nodiscard]] glm::vec3 at(int x, int y, int level = 0) const {
        return ssbump_detail::read(view.layout.format,
                                   view.slice(0, level) + std::size_t(y) * view.layout.row_bytes(level), x);
    }
    std::vector<std::byte> bytes;
    texture view;
};

void require(const status& s) { REQUIRE_MESSAGE(bool(s), s.message().c_str()); }

// The visible share of the clamped cosine around `axis`, by the midpoint rule: slope(turns) is the horizon.
template <class Slope>
double brute_share(glm::dvec3 axis, const Slope& slope, int bearings, int elevations) {
    double seen = 0.0, all = 0.0;
    for (int i = 0; i < bearings; ++i) {
        const double turns = (i + 0.5) / bearings;
        const double horizon = std::atan(slope(turns));
        for (int k = 0; k < elevations; ++k) {
            const double e = (k + 0.5) / elevations * pi / 2.0;
            const glm::dvec3 w(std::cos(2.0 * pi * turns) * std::cos(e), std::sin(2.0 * pi * turns) * std::cos(e),
                               std::sin(e));
            const double weight = std::max(0.0, glm::dot(axis, w)) * std::cos(e);
            all += weight;
            if (e > horizon) seen += weight;
        }
    }
    return seen / all;
}

// Share of one texel as the library has it, in float.
double lobe_share(glm::dvec3 axis, std::span<const glm::dvec2> directions, std::span<const float> slopes) {
    lobe_bearings bearings;
    require(place(directions, bearings));
    const cosine_lobe lobe(bearings, axis);
    float share = 0.0f;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const float slope = lobe_detail::clamped(slopes[i]);
        const auto integrals = lobe_detail::above(slope);
        lobe.add(int(i), &slope, &integrals.across, &integrals.up, 1, &share);
    }
    return double(share);
}

double degrees_between(glm::dvec3 a, glm::dvec3 b) {
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(glm::normalize(a) - glm::normalize(b)))) * 180.0 / pi;
}

const glm::dvec3 straight_up(0.0, 0.0, 1.0);

std::array<int, 4> texel(const masks& m, int x) {
    std::array<int, 4> values;
    for (int c = 0; c < 4; ++c) values[std::size_t(c)] = std::to_integer<int>(m.bytes[std::size_t(4 * x + c)]);
    return values;
}

}  // namespace

TEST_CASE("the integrals over elevation") {
    // By the midpoint rule, 20000 steps from the horizon to the zenith.
    for (const double slope : {0.0, 0.1, 0.5, 0.99, 1.0, 1.01, 2.0, 7.0, 40.0}) {
        const double low = std::atan(slope), step = (pi / 2.0 - low) / 20000;
        double across = 0.0, up = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const double e = low + (i + 0.5) * step;
            across += std::cos(e) * std::cos(e) * step;
            up += std::sin(e) * std::cos(e) * step;
        }
        const auto found = lobe_detail::above(float(slope));
        CHECK(std::abs(double(found.across) - across) < 3e-7);
        CHECK(std::abs(double(found.up) - up) < 3e-7);
    }
    for (const float slope : {1e9f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::max()}) {
        const auto found = lobe_detail::above(lobe_detail::clamped(slope));
        CHECK(std::abs(found.across) < 1e-8f);
        CHECK(std::abs(found.up) < 1e-8f);
    }
    CHECK(lobe_detail::clamped(no_horizon) == 0.0f);
    CHECK(lobe_detail::clamped(std::numeric_limits<float>::quiet_NaN()) == 0.0f);
}

TEST_CASE("shares of lobes above unrelated horizons, summed over the same bearings by brute force") {
    shapes::noise random(11);
    constexpr int count = 16, steps = 4000;
    const auto directions = shapes::directions(count);
    for (int trial = 0; trial < 12; ++trial) {
        std::array<float, count> slopes;
        for (float& s : slopes) s = float(std::tan(1.5 * random.uniform()));
        for (const glm::dvec3 axis : {ssbump_basis[0], ssbump_basis[1], ssbump_basis[2], straight_up}) {
            double seen = 0.0, all = 0.0;
            for (std::size_t i = 0; i < count; ++i) {
                const double horizon = std::atan(double(slopes[i]));
                // Split at the horizon, so that the rule has no jump in it.
                for (int part = 0; part < 2; ++part) {
                    const double low = part == 0 ? 0.0 : horizon, high = part == 0 ? horizon : pi / 2.0;
                    for (int k = 0; k < steps; ++k) {
                        const double e = low + (high - low) * (k + 0.5) / steps;
                        const glm::dvec3 w(directions[i].x * std::cos(e), directions[i].y * std::cos(e), std::sin(e));
                        const double weight = std::max(0.0, glm::dot(axis, w)) * std::cos(e) * (high - low) / steps;
                        all += weight;
                        seen += part == 1 ? weight : 0.0;
                    }
                }
            }
            CHECK(std::abs(lobe_share(axis, directions, slopes) - seen / all) < 1e-6);
        }
    }
}

TEST_CASE("how many bearings the sum needs") {
    // A smooth horizon that stands up to 63 degrees high, with three to five features around the circle.
    const auto slope = [](double turns) {
        const double a = 2.0 * pi * turns;
        return std::max(0.0, 0.8 + 0.5 * std::sin(a + 1.0) + 0.4 * std::cos(3.0 * a) + 0.3 * std::sin(5.0 * a));
    };
    struct row {
        int bearings;
        double allowed;
    };
    for (const row& r : {row{8, 0.03}, {16, 0.004}, {32, 0.001}, {64, 0.0005}}) {
        const auto directions = shapes::directions(r.bearings);
        std::vector<float> slopes;
        for (int i = 0; i < r.bearings; ++i) slopes.push_back(float(slope(double(i) / r.bearings)));
        double worst = 0.0;
        for (const glm::dvec3 axis : {ssbump_basis[0], ssbump_basis[1], ssbump_basis[2], straight_up})
            worst =
                std::max(worst, std::abs(lobe_share(axis, directions, slopes) - brute_share(axis, slope, 2000, 1500)));
        MESSAGE(r.bearings, " bearings: error of a share up to ", worst);
        CHECK(worst < r.allowed);
    }
}

TEST_CASE("uneven bearings weigh what they stand for") {
    // The quadrant around +x closed, sampled four times as densely as the rest.
    std::vector<glm::dvec2> directions;
    std::vector<float> slopes;
    for (int i = 0; i < 64; ++i) {
        const double turns = (i + 0.5) / 64.0;
        const bool closed = turns < 0.125 || turns > 0.875;
        if (!closed && i % 4 != 1) continue;
        directions.insert(directions.begin(), 2.0 * shapes::direction(turns));
        slopes.insert(slopes.begin(), closed ? 1e9f : -3.0f);
    }
    // Half-way between its neighbors the closed part ends: from 55/64 to 8.5/64.
    const auto slope = [](double turns) { return turns < 8.5 / 64.0 || turns > 55.0 / 64.0 ? 1e9 : 0.0; };
    CHECK(std::abs(lobe_share(straight_up, directions, slopes) - (1.0 - 17.5 / 64.0)) < 1e-6);
    CHECK(std::abs(lobe_share(ssbump_basis[0], directions, slopes) - brute_share(ssbump_basis[0], slope, 512, 512)) <
          0.02);
}

TEST_CASE("V groove") {
    // At the bottom the sky is a wedge of half angle a = 90 degrees - atan(gradient) along y. Its cosine-weighted share
    // is sin a (Lambert); for a vector that has the wedge in front of it, 2 b.z sin a / (1 + b.z).
    const auto directions = shapes::directions(64);
    for (const double gradient : {0.5, 1.0, 2.0, 5.0}) {
        std::vector<float> slopes;
        for (const glm::dvec2 d : directions) slopes.push_back(float(gradient * std::abs(d.x)));
        const double sine = 1.0 / std::sqrt(1.0 + gradient * gradient);
        CHECK(std::abs(lobe_share(straight_up, directions, slopes) - sine) < 1e-3);
        if (sine > 0.577) continue;
        const double up = 1.0 / std::sqrt(3.0);
        CHECK(std::abs(lobe_share(ssbump_basis[0], directions, slopes) - 2.0 * up * sine / (1.0 + up)) < 1e-3);
    }
}

TEST_CASE("the basis is that of the shader, and orthonormal") {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(glm::dot(ssbump_basis[i], ssbump_basis[k]) == doctest::Approx(i == k ? 1.0 : 0.0));
    CHECK(glm::length(ssbump_basis[0] - glm::dvec3(std::sqrt(2.0) / std::sqrt(3.0), 0.0, 1.0 / std::sqrt(3.0))) <
          1e-15);
    CHECK(glm::length(ssbump_basis[1] - glm::dvec3(-1.0 / std::sqrt(6.0), 1.0 / std::sqrt(2.0), 1.0 / std::sqrt(3.0))) <
          1e-15);
}

TEST_CASE("golden bytes") {
    constexpr glm::ivec2 extent(4, 1);
    normals n(extent);
    n.view.set(1, 0, glm::vec3(ssbump_basis[1]));         // faces green
    n.view.set(2, 0, {0.0f, 0.0f, 0.0f});                 // a hole
    n.view.set(3, 0, {-0.98480775f, 0.0f, 0.17364818f});  // tilted by 80 degrees: red is clamped
    masks m({}, extent);
    require(pack_ssbump(n.view, {.occlusion = mask_occlusion::none}, m.view));
    // 255 / sqrt(3) = 147.2; of the last one: 255 (0.98481 / sqrt(6) + 0.17365 / sqrt(3)) = 128.1
    using bytes = std::array<int, 4>;
    CHECK(texel(m, 0) == bytes{147, 147, 147, 255});
    CHECK(texel(m, 1) == bytes{0, 255, 0, 255});
    CHECK(texel(m, 2) == bytes{147, 147, 147, 255});
    CHECK(texel(m, 3) == bytes{0, 128, 128, 255});

    // Right-handed: green and blue swapped.
    require(pack_ssbump(n.view, {.y = normal_y::up, .occlusion = mask_occlusion::none}, m.view));
    CHECK(texel(m, 1) == bytes{0, 0, 255, 255});

    // As a detail texture 0.5: 127.5, rounded up; green is 255 sqrt(3) / 2.
    require(pack_ssbump(n.view, {.occlusion = mask_occlusion::none, .detail = true}, m.view));
    CHECK(texel(m, 0) == bytes{128, 128, 128, 255});
    CHECK(texel(m, 1) == bytes{0, 221, 0, 255});

    // 31 / sqrt(3) = 17.9, 63 / sqrt(3) = 36.4: 18 << 11 | 36 << 5 | 18 = 0x9492; green alone 0x07e0.
    const ssbump packed{.format = texel_format::rgb565, .occlusion = mask_occlusion::none};
    masks small(packed, extent);
    CHECK(small.bytes.size() == 8);
    require(pack_ssbump(n.view, packed, small.view));
    CHECK(std::to_integer<int>(small.bytes[0]) == 0x92);
    CHECK(std::to_integer<int>(small.bytes[1]) == 0x94);
    CHECK(std::to_integer<int>(small.bytes[2]) == 0xe0);
    CHECK(std::to_integer<int>(small.bytes[3]) == 0x07);

    // Below a slot along y whose walls rise at 45 degrees: shares worked out above, and by brute force.
    horizons slot(extent, 64, [](int, int, double turns) { return std::abs(std::cos(2.0 * pi * turns)); });
    const auto wall = [](double turns) { return std::abs(std::cos(2.0 * pi * turns)); };
    require(pack_ssbump(slot.view, slot.directions, n.view, {.occlusion = mask_occlusion::ambient}, m.view));
    CHECK(texel(m, 0) == bytes{104, 104, 104, 255});  // 147.2 sin(45 degrees)
    require(pack_ssbump(slot.view, slot.directions, n.view, {}, m.view));
    const int red = int(147.224 * brute_share(ssbump_basis[0], wall, 1024, 1024) + 0.5);
    const int green = int(147.224 * brute_share(ssbump_basis[1], wall, 1024, 1024) + 0.5);
    CHECK(texel(m, 0) == bytes{red, green, green, 255});
    CHECK(red < green);
}

TEST_CASE("one wall shades the mask that faces it, in either hand") {
    // +y, along growing rows, is closed.
    horizons wall({1, 1}, 32, [](int, int, double turns) { return turns > 0.0 && turns < 0.5 ? 100.0 : 0.0; });
    normals n({1, 1});
    masks down({}, {1, 1}), up({}, {1, 1});
    require(pack_ssbump(wall.view, wall.directions, n.view, {}, down.view));
    require(pack_ssbump(wall.view, wall.directions, n.view, {.y = normal_y::up}, up.view));
    CHECK(down.at(0, 0).y < 0.5f * down.at(0, 0).z);
    CHECK(shader::bumpshadow_ssbump_other_hand(down.at(0, 0)) == up.at(0, 0));

    // Either leads to the same normal in tangent space, which leans away from the wall.
    normals a({1, 1}), b({1, 1});
    require(recover_normals(down.view, {}, a.view));
    require(recover_normals(up.view, {.y = normal_y::up}, b.view));
    CHECK(a.view.at(0, 0) == b.view.at(0, 0));
    CHECK(a.view.at(0, 0).y < -0.1f);
}

TEST_CASE("without occlusion the recovered normal is the surface's up to asin(1 / sqrt(3))") {
    shapes::noise random(21);
    constexpr int count = 20000;
    normals gentle({count, 1}), steep({count, 1}), back({count, 1});
    const double limit = std::asin(1.0 / std::sqrt(3.0));
    for (int i = 0; i < count; ++i) {
        const double turn = 2.0 * pi * random.uniform();
        const auto tilted = [&](double tilt) {
            return glm::vec3(std::cos(turn) * std::sin(tilt), std::sin(turn) * std::sin(tilt), std::cos(tilt));
        };
        gentle.view.set(i, 0, tilted(limit * random.uniform()));
        steep.view.set(i, 0, tilted(50.0 * pi / 180.0));
    }
    struct error {
        double mean, worst;
    };
    const auto through = [&](const normals& n, const ssbump& encoding) {
        masks m(encoding, {count, 1});
        require(pack_ssbump(n.view, encoding, m.view));
        require(recover_normals(m.view, encoding, back.view));
        error e{};
        for (int i = 0; i < count; ++i) {
            const double angle = degrees_between(n.view.at(i, 0), back.view.at(i, 0));
            e.mean += angle / count;
            e.worst = std::max(e.worst, angle);
        }
        return e;
    };
    for (const normal_y y : {normal_y::down, normal_y::up}) {
        const error e = through(gentle, {.y = y, .occlusion = mask_occlusion::none});
        CHECK(e.mean < 0.13);
        CHECK(e.worst < 0.2);  // half a step in each of three channels, 0.5 sqrt(3) / 255, is 0.195 degrees
    }
    // In 5 and 6 bits; the post finds banding in reflections.
    const error coarse = through(gentle, {.format = texel_format::rgb565, .occlusion = mask_occlusion::none});
    MESSAGE("RGB565: mean ", coarse.mean, " worst ", coarse.worst, " degrees");
    CHECK(coarse.mean < 1.0);
    CHECK(coarse.worst < 1.6);
    // Beyond, the clamped masks of some bearings pull the normal up by at most the excess over the limit.
    const error clamped = through(steep, {.occlusion = mask_occlusion::none});
    MESSAGE("tilt of 50 degrees: mean ", clamped.mean, " worst ", clamped.worst, " degrees");
    CHECK(clamped.worst < 50.0 - limit * 180.0 / pi + 0.3);
    CHECK(clamped.worst > 10.0);

    // The claim of better byte precision: the same normals as bytes of a normal map.
    std::vector<std::byte> bytes(4 * count);
    require(encode_normals(gentle.view, {}, {bytes, {count, 1}}));
    require(decode_normals({bytes, {count, 1}}, {}, back.view));
    double plain = 0.0;
    for (int i = 0; i < count; ++i) plain += degrees_between(gentle.view.at(i, 0), back.view.at(i, 0)) / count;
    const double ours = through(gentle, {.occlusion = mask_occlusion::none}).mean;
    MESSAGE("8 bits: SSBump ", ours, ", normal map ", plain, " degrees");
    CHECK(ours / plain == doctest::Approx(0.5).epsilon(0.1));  // half the range, as many steps
}

TEST_CASE("a detail map leaves the recovered normal until 8 bits saturate") {
    const glm::vec3 n = glm::normalize(glm::vec3(0.35f, 0.2f, 0.9f));
    const glm::vec3 mask = shader::bumpshadow_ssbump_weights(n);
    const auto stored = [](glm::vec3 v) {
        for (int c = 0; c < 3; ++c) v[c] = from_unorm8(to_unorm8(v[c]));
        return v;
    };
    for (const float detail : {0.5f, 0.8f, 1.0f, 1.15f}) {
        const auto found =
            shader::bumpshadow_ssbump_normal(stored(shader::bumpshadow_ssbump_detail(stored(mask), detail)));
        CHECK(degrees_between(found, n) < 0.5);
    }
    // The red mask is 0.817: from 1 / 0.817 = 1.22 on it stays at 1 while the others grow.
    CHECK(mask.x == doctest::Approx(0.8167).epsilon(0.001));
    const auto saturated =
        shader::bumpshadow_ssbump_normal(stored(shader::bumpshadow_ssbump_detail(stored(mask), 2.0f)));
    CHECK(degrees_between(saturated, n) > 10.0);
    // A detail texture packed with flat as 0.5 changes nothing where it is flat; 128 in place of 127.5 is 0.4 % more.
    const auto flat = shader::bumpshadow_ssbump_detail_masks(mask, stored({0.5f, 0.5f, 0.5f}));
    CHECK(glm::length(flat - mask) < 0.005f);
}

TEST_CASE("bent normals") {
    // Half the hemisphere closed by a wall that faces -x: what is left is symmetric about (-1, 0, 1).
    horizons half({1, 1}, 256, [](int, int, double turns) { return turns < 0.25 || turns > 0.75 ? 1e9 : 0.0; });
    normals n({1, 1});
    require(bend_normals(half.view, half.directions, n.view));
    CHECK(degrees_between(n.view.at(0, 0), {-1.0, 0.0, 1.0}) < 0.3);
    // All closed, and nothing closed.
    horizons closed({1, 1}, 8, [](int, int, double) { return std::numeric_limits<float>::infinity(); });
    require(bend_normals(closed.view, closed.directions, n.view));
    CHECK(n.view.at(0, 0) == glm::vec3(0.0f, 0.0f, 1.0f));
    horizons open({1, 1}, 8, [](int, int, double) { return no_horizon; });
    require(bend_normals(open.view, open.directions, n.view));
    CHECK(degrees_between(n.view.at(0, 0), straight_up) < 1e-4);

    // Against brute force on unrelated smooth horizons.
    for (int trial = 0; trial < 5; ++trial) {
        const auto slope = [trial](double turns) {
            const double a = 2.0 * pi * turns;
            return 0.7 + 0.4 * std::sin(a + trial) + 0.3 * std::cos(2.0 * a - trial);
        };
        horizons h({1, 1}, 32, [&](int, int, double turns) { return slope(turns); });
        require(bend_normals(h.view, h.directions, n.view));
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 720; ++i)
            for (int k = 0; k < 500; ++k) {
                const double turns = (i + 0.5) / 720, e = (k + 0.5) / 500 * pi / 2.0;
                if (std::tan(e) <= slope(turns)) continue;
                sum += std::cos(e) * glm::dvec3(std::cos(2.0 * pi * turns) * std::cos(e),
                                                std::sin(2.0 * pi * turns) * std::cos(e), std::sin(e));
            }
        CHECK(degrees_between(n.view.at(0, 0), sum) < 0.1);
    }
}

TEST_CASE("mips are means, also of odd extents, and the executor does not matter") {
    shapes::noise random(4);
    const glm::ivec2 extent(13, 70);
    normals n(extent);
    horizons h(extent, 12, [&](int, int, double) { return 2.0 * random.uniform() - 0.3; });
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x)
            n.view.set(x, y, glm::normalize(glm::vec3(random.uniform() - 0.5, random.uniform() - 0.5, 1.0)));
    const ssbump encoding{};
    masks m(encoding, extent, 7), again(encoding, extent, 7);
    require(pack_ssbump(h.view, h.directions, n.view, encoding, m.view));
    require(pack_ssbump(h.view, h.directions, n.view, encoding, again.view, threads(3)));
    CHECK(m.bytes == again.bytes);
    const auto mean = [&](int level) {
        const glm::ivec2 size = m.view.layout.level_extent(level);
        glm::vec3 sum(0.0f);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) sum += m.at(x, y, level);
        return sum / float(size.x * size.y);
    };
    for (int level = 1; level < 7; ++level)
        for (int c = 0; c < 3; ++c) CHECK(std::abs(mean(level)[c] - mean(0)[c]) < 0.01f);
    // 13 texels to 6: the first covers two whole ones and a sixth of the third.
    float first = 0.0f;
    for (int y = 0; y < 2; ++y)
        first += (m.at(0, y).x + m.at(1, y).x + m.at(2, y).x / 6.0f) / (2.0f + 1.0f / 6.0f) / 2.0f;
    CHECK(std::abs(m.at(0, 0, 1).x - first) < 0.5f / 255.0f + 1e-5f);
}

TEST_CASE("bad input writes nothing") {
    horizons h({4, 3}, 8, [](int, int, double) { return 0.5; });
    normals n({4, 3});
    masks m({}, {4, 3});
    const auto before = m.bytes;
    const auto fails = [&](const status& s, error code) {
        CHECK(s.code() == code);
        CHECK(m.bytes == before);
    };
    const auto pack = [&](const horizon_map& slopes, std::span<const glm::dvec2> d, const ssbump& e,
                          const texture& out) { return pack_ssbump(slopes, d, n.view, e, out); };
    const std::span<const glm::dvec2> all = h.directions;
    fails(pack({}, all, {}, m.view), error::not_positive);
    fails(pack(h.view, all.first(7), {}, m.view), error::mismatch);
    fails(pack(h.view, all, {.format = texel_format::rgb565}, m.view), error::mismatch);
    fails(pack(h.view, all, {.format = texel_format::bc1}, m.view), error::not_supported);
    texture small = m.view;
    small.bytes = small.bytes.first(47);
    fails(pack(h.view, all, {}, small), error::too_small);
    texture other = m.view;
    other.layout.extent = {3, 4};
    fails(pack(h.view, all, {}, other), error::mismatch);
    horizon_map narrow = h.view;
    narrow.extent.x = 3;
    fails(pack(narrow, all, {}, m.view), error::mismatch);
    horizon_map two = h.view;
    two.bearings = 2;
    fails(pack(two, all.first(2), {}, m.view), error::too_small);
    auto twice = h.directions;
    twice[3] = 5.0 * twice[2];
    fails(pack(h.view, twice, {}, m.view), error::not_positive);
    twice[3] = {0.0, 0.0};
    fails(pack(h.view, twice, {}, m.view), error::not_positive);
    fails(pack_ssbump(n.view, {}, m.view), error::not_supported);
    fails(recover_normals(m.view, {}, n.view, 1), error::out_of_range);
    normals wrong({3, 3});
    fails(recover_normals(m.view, {}, wrong.view), error::mismatch);
    fails(bend_normals(h.view, all, wrong.view), error::mismatch);
    CHECK(fetches(ssbump{}) == 1);
    CHECK(layout_of(ssbump{}, {4, 3}).bytes_per_texel({4, 3}) == 4.0);
    CHECK(layout_of(ssbump{.format = texel_format::bc1}, {8, 4}).bytes_per_texel({8, 4}) == 0.5);
}
