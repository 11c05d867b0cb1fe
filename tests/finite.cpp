#include <bumpshadow/finite.hpp>

#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

template <class T>
void check_numbers() {
    using limits = std::numeric_limits<T>;
    for (const T v :
         {T(0), -T(0), T(1), T(-1.5), limits::min(), limits::denorm_min(), limits::max(), limits::lowest()}) {
        CHECK(is_finite(v));
        CHECK_FALSE(is_infinite(v));
        CHECK_FALSE(is_nan(v));
    }
    for (const T v : {limits::infinity(), -limits::infinity()}) {
        CHECK_FALSE(is_finite(v));
        CHECK(is_infinite(v));
        CHECK_FALSE(is_nan(v));
    }
    for (const T v : {limits::quiet_NaN(), -limits::quiet_NaN(), limits::signaling_NaN()}) {
        CHECK_FALSE(is_finite(T(v)));
        CHECK_FALSE(is_infinite(T(v)));
        CHECK(is_nan(T(v)));
    }
}

static_assert(is_finite(1.0f) && is_infinite(std::numeric_limits<double>::infinity()));
static_assert(is_nan(std::numeric_limits<float>::quiet_NaN()));

}  // namespace

TEST_CASE("finite, infinite and NaN are told apart by their bits") {
    check_numbers<float>();
    check_numbers<double>();
}
