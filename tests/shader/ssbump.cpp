#include <bumpshadow/shader/shader.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow::shader;

namespace {

// The basis as the post prints it.
const glm::dvec3 basis[3] = {{std::sqrt(2.0) / std::sqrt(3.0), 0.0, 1.0 / std::sqrt(3.0)},
                             {-1.0 / std::sqrt(6.0), 1.0 / std::sqrt(2.0), 1.0 / std::sqrt(3.0)},
                             {-1.0 / std::sqrt(6.0), -1.0 / std::sqrt(2.0), 1.0 / std::sqrt(3.0)}};

bool near(vec3 a, glm::dvec3 b) { return glm::length(glm::dvec3(a) - b) < 1e-6; }

bool finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

vec3 any(shapes::noise& random) {
    return vec3(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0);
}

}  // namespace

TEST_CASE("sums and dots with the basis") {
    shapes::noise random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 m = any(random);
        const glm::dvec3 sum = basis[0] * double(m.x) + basis[1] * double(m.y) + basis[2] * double(m.z);
        CHECK(near(bumpshadow_ssbump_sum(m), sum));
        CHECK(near(bumpshadow_ssbump_normal(m), glm::normalize(sum)));
        const glm::dvec3 v(m);
        const glm::dvec3 dots(glm::dot(basis[0], v), glm::dot(basis[1], v), glm::dot(basis[2], v));
        CHECK(near(bumpshadow_ssbump_project(m), dots));
        CHECK(
            near(bumpshadow_ssbump_weights(m), {std::max(0.0, dots.x), std::max(0.0, dots.y), std::max(0.0, dots.z)}));
        CHECK(near(bumpshadow_ssbump_sum(bumpshadow_ssbump_project(m)), v));

        // Swapping the last two vectors of the basis is swapping green and blue; both together change nothing.
        const glm::dvec3 swapped = basis[0] * double(m.x) + basis[2] * double(m.y) + basis[1] * double(m.z);
        CHECK(near(bumpshadow_ssbump_sum(bumpshadow_ssbump_other_hand(m)), swapped));
        CHECK(bumpshadow_ssbump_other_hand(bumpshadow_ssbump_other_hand(m)) == m);
        // And it is flipping y.
        CHECK(near(bumpshadow_ssbump_sum(bumpshadow_ssbump_other_hand(m)), {sum.x, -sum.y, sum.z}));
    }
}

TEST_CASE("masks stay positive up to a tilt of asin(1 / sqrt(3))") {
    const double limit = std::asin(1.0 / std::sqrt(3.0));
    CHECK(limit * 180.0 / std::numbers::pi == doctest::Approx(35.2644).epsilon(1e-5));
    double least = 1.0, beyond = 1.0;
    for (int i = 0; i < 720; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / 720.0;
        const auto lowest = [&](double tilt) {
            const vec3 dots = bumpshadow_ssbump_project(
                vec3(std::cos(turn) * std::sin(tilt), std::sin(turn) * std::sin(tilt), std::cos(tilt)));
            return double(std::min({dots.x, dots.y, dots.z}));
        };
        least = std::min(least, lowest(limit));
        beyond = std::min(beyond, lowest(limit + 0.01));
    }
    CHECK(std::abs(least) < 1e-6);
    CHECK(beyond < -0.009);
}

TEST_CASE("straight to the world") {
    shapes::noise random(2);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(any(random))), helper = glm::dvec3(any(random));
        const glm::dvec3 t = glm::normalize(glm::cross(helper, n)), b = glm::cross(n, t);
        const vec3 m(random.uniform(), random.uniform(), random.uniform());
        const vec3 red = bumpshadow_ssbump_world_red(vec3(t), vec3(n)),
                   green = bumpshadow_ssbump_world_green(vec3(t), vec3(b), vec3(n)),
                   blue = bumpshadow_ssbump_world_blue(vec3(t), vec3(b), vec3(n));
        const glm::dvec3 tangent(bumpshadow_ssbump_normal(m));
        CHECK(near(bumpshadow_ssbump_world_normal(m, red, green, blue), t * tangent.x + b * tangent.y + n * tangent.z));
    }
}

TEST_CASE("reflections") {
    const float s = std::sqrt(0.5f);
    CHECK(near(bumpshadow_reflection(vec3(s, 0.0f, s), vec3(0.0f, 0.0f, 1.0f)), {double(-s), 0.0, double(s)}));
    // A surface tilted by 22.5 degrees sends a view from straight above to 45 degrees.
    const float half = float(std::numbers::pi / 8.0);
    CHECK(near(bumpshadow_reflection(vec3(0.0f, 0.0f, 1.0f), vec3(std::sin(half), 0.0f, std::cos(half))),
               {double(s), 0.0, double(s)}));
}

TEST_CASE("light") {
    shapes::noise random(3);
    for (int i = 0; i < 200; ++i) {
        // Normal and light that all three vectors face: the product of the projections is the cosine.
        const vec3 n =
            glm::normalize(bumpshadow_ssbump_sum(vec3(random.uniform(), random.uniform(), random.uniform())));
        const vec3 l =
            glm::normalize(bumpshadow_ssbump_sum(vec3(random.uniform(), random.uniform(), random.uniform())));
        const vec3 masks = bumpshadow_ssbump_weights(n), weights = bumpshadow_ssbump_weights(l);
        CHECK(std::abs(bumpshadow_ssbump_light(masks, weights) - glm::dot(n, l)) < 1e-6f);
        // Lightmaps that hold the irradiance of that light are its weights.
        const vec3 lit = bumpshadow_ssbump_lightmaps(masks, vec3(weights.x), vec3(weights.y), vec3(weights.z));
        CHECK(std::abs(lit.x - glm::dot(n, l)) < 1e-6f);
        // With a normal map the weights are squares, and add up to 1.
        CHECK(near(bumpshadow_normal_lightmaps(n, vec3(0.25f), vec3(0.25f), vec3(0.25f)), glm::dvec3(0.25)));
        const glm::dvec3 squares(masks * masks);
        CHECK(
            near(bumpshadow_normal_lightmaps(n, vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f)),
                 squares / (squares.x + squares.y + squares.z)));
    }
    // An even sky of radiance 1 / pi on a flat texel: the irradiance on a plane tilted by 54.74 degrees is (1 + b.z)
    // / 2.
    const float plane = 0.5f * (1.0f + 0.57735027f), flat = 0.57735027f;
    CHECK(bumpshadow_ssbump_lightmaps(vec3(flat), vec3(plane), vec3(plane), vec3(plane)).x ==
          doctest::Approx(1.366).epsilon(1e-3));
    // Not clamped, b . (0, 0, 1).
    CHECK(bumpshadow_ssbump_lightmaps(vec3(flat), vec3(flat), vec3(flat), vec3(flat)).x == doctest::Approx(1.0));
}

TEST_CASE("detail") {
    shapes::noise random(4);
    for (int i = 0; i < 50; ++i) {
        const vec3 m(random.uniform() + 0.01, random.uniform(), random.uniform());
        CHECK(
            near(bumpshadow_ssbump_normal(bumpshadow_ssbump_detail(m, 0.3f)), glm::dvec3(bumpshadow_ssbump_normal(m))));
        CHECK(near(bumpshadow_ssbump_detail_masks(m, vec3(0.5f)), glm::dvec3(m)));
    }
}

TEST_CASE("odd arguments give finite numbers") {
    const float tiny = std::numeric_limits<float>::denorm_min();
    const vec3 odd[] = {
        vec3(0.0f), vec3(tiny), vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 0.0f, -1.0f), vec3(1e15f), vec3(-1.0f, 2.0f, -3.0f)};
    for (const vec3 a : odd) {
        CHECK(finite(bumpshadow_ssbump_normal(a)));
        CHECK(finite(bumpshadow_ssbump_weights(a)));
        CHECK(finite(bumpshadow_normal_lightmaps(a, vec3(1.0f), vec3(1.0f), vec3(1.0f))));
        CHECK(finite(bumpshadow_normal(a, 1.0f)));
        CHECK(finite(bumpshadow_normal_of_derivatives(vec2(a), 1.0f, 1.0f)));
        for (const vec3 b : odd) CHECK(finite(bumpshadow_ssbump_world_normal(a, b, b, b)));
    }
    CHECK(bumpshadow_ssbump_normal(vec3(0.0f)) == vec3(0.0f, 0.0f, 1.0f));
    CHECK(bumpshadow_ssbump_weights(vec3(0.0f)) == vec3(0.0f));
    CHECK(bumpshadow_ssbump_weights(vec3(0.0f, 0.0f, -1.0f)) == vec3(0.0f));
}

TEST_CASE("ssbump: swapping masks or basis changes the hand, and doing both undoes it") {
    const glm::vec3 masks(0.2f, 0.5f, 0.9f);
    const auto sum = [](glm::vec3 m, bool swapped) {
        const glm::dvec3 first = basis[0], second = basis[swapped ? 2 : 1], third = basis[swapped ? 1 : 2];
        return glm::vec3(first * double(m.x) + second * double(m.y) + third * double(m.z));
    };
    const glm::vec3 plain = sum(masks, false), other = bumpshadow_ssbump_other_hand(masks);
    const glm::vec3 flipped(plain.x, -plain.y, plain.z);
    CHECK(glm::length(bumpshadow_ssbump_sum(masks) - plain) < 1e-6f);
    CHECK(glm::length(sum(other, false) - flipped) < 1e-6f);
    CHECK(glm::length(sum(masks, true) - flipped) < 1e-6f);
    CHECK(glm::length(sum(other, true) - plain) < 1e-6f);
}
