#include <bumpshadow/encode/quantity.hpp>

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace bumpshadow;

TEST_CASE("quantity: elevations of 30, 45 and 60 degrees") {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(quantity_of_slope(quantity::sine, 1.0f / std::sqrt(3.0f)) == doctest::Approx(0.5));
    CHECK(quantity_of_slope(quantity::sine, std::sqrt(3.0f)) == doctest::Approx(std::sqrt(0.75)));
    CHECK(quantity_of_slope(quantity::sine, -1.0f) == doctest::Approx(-std::sqrt(0.5)));
    CHECK(quantity_of_slope(quantity::angle, 1.0f) == doctest::Approx(std::acos(-1.0) / 4.0));
    CHECK(quantity_of_slope(quantity::slope, -7.5f) == -7.5f);
    CHECK(quantity_of_slope(quantity::sine, infinity) == 1.0f);
    CHECK(quantity_of_slope(quantity::sine, 1e30f) == 1.0f);
    CHECK(quantity_of_slope(quantity::sine, std::numeric_limits<float>::lowest()) == -1.0f);
    CHECK(quantity_of_slope(quantity::angle, infinity) == doctest::Approx(std::acos(0.0)));
    CHECK(slope_of_quantity(quantity::sine, 1.0f) == infinity);
    CHECK(slope_of_quantity(quantity::angle, -1.6f) == -infinity);
}

TEST_CASE("quantity: there and back, and what is stored") {
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
        for (const float slope : {-20.0f, -1.0f, -1e-4f, 0.0f, 1e-6f, 0.1f, 1.0f, 3.0f, 30.0f}) {
            CAPTURE(int(stored));
            CHECK(slope_of_quantity(stored, quantity_of_slope(stored, slope)) ==
                  doctest::Approx(double(slope)).epsilon(1e-3));
        }
    for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle}) {
        const horizon_scale scale{stored, 4.0f};
        CHECK(bool(check(scale)));
        CHECK(to_stored(scale, 4.0f) == doctest::Approx(1.0));
        CHECK(to_stored(scale, 5.0f) == 1.0f);
        CHECK(to_stored(scale, -0.5f) == 0.0f);
        CHECK(to_stored(scale, std::numeric_limits<float>::lowest()) == 0.0f);
    }
    CHECK(to_stored({quantity::slope, 4.0f}, 1.0f) == 0.25f);
    CHECK(to_stored({quantity::sine, std::numeric_limits<float>::infinity()}, 1.0f) == doctest::Approx(std::sqrt(0.5)));
    CHECK(check(horizon_scale{quantity::slope, 0.0f}).code() == error::not_positive);
    CHECK(check(horizon_scale{quantity::slope, 1e-30f}).code() == error::out_of_range);
    CHECK(std::isfinite(stored_scale({quantity::slope, smallest_max_slope}) * 1e15f));
    CHECK(check(horizon_scale{quantity::slope, std::numeric_limits<float>::infinity()}).code() == error::not_finite);
    CHECK(bool(check(horizon_scale{quantity::slope, largest_max_slope})));
    CHECK(check(horizon_scale{quantity::slope, 1.1e14f}).code() == error::out_of_range);
    CHECK(bool(check(horizon_scale{quantity::sine, 1.1e14f})));
    CHECK(check(horizon_scale{quantity::sine, std::numeric_limits<float>::quiet_NaN()}).code() == error::not_positive);
}
