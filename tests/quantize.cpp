#include <bumpshadow/quantize.hpp>

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

using namespace bumpshadow;

TEST_CASE("quantize: every code comes back, and halves between codes go to the nearest") {
    for (int i = 0; i < 256; ++i) {
        CHECK(to_unorm8(from_unorm8(std::uint8_t(i))) == i);
        if (i < 255) {
            CHECK(to_unorm8((float(i) + 0.49f) / 255.0f) == i);
            CHECK(to_unorm8((float(i) + 0.51f) / 255.0f) == i + 1);
        }
    }
    int wrong = 0;
    for (int i = 0; i < 65536; ++i) wrong += to_unorm16(from_unorm16(std::uint16_t(i))) != i;
    CHECK(wrong == 0);
    CHECK(to_unorm8(-1.0f) == 0);
    CHECK(to_unorm8(1e30f) == 255);
    CHECK(to_unorm8(std::numeric_limits<float>::infinity()) == 255);
    CHECK(to_unorm8(std::numeric_limits<float>::lowest()) == 0);
    CHECK(to_unorm8(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(to_unorm16(std::numeric_limits<float>::quiet_NaN()) == 0);
}

TEST_CASE("quantize: half precision") {
    // IEEE 754: 1 = 3c00, largest 65504 = 7bff, smallest normal 2^-14 = 0400, smallest 2^-24 = 0001.
    CHECK(to_half(1.0f) == 0x3c00);
    CHECK(to_half(-2.0f) == 0xc000);
    CHECK(to_half(65504.0f) == 0x7bff);
    CHECK(to_half(1e30f) == 0x7bff);
    CHECK(to_half(-std::numeric_limits<float>::infinity()) == 0xfbff);
    CHECK(to_half(std::ldexp(1.0f, -14)) == 0x0400);
    CHECK(to_half(std::ldexp(1.0f, -24)) == 0x0001);
    CHECK(to_half(std::ldexp(1.0f, -25)) == 0x0000);  // a tie, to even
    CHECK(to_half(std::ldexp(1.5f, -24)) == 0x0002);  // a tie, to even
    CHECK(to_half(0.1f) == 0x2e66);
    CHECK(to_half(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(std::isinf(from_half(0x7c00)));
    // Decoding is a sum of powers of two; encoding takes the nearer neighbor, the even one where both are as near.
    int wrong = 0;
    for (int code = 0; code < 0x7c00; ++code) {
        const int exponent = code >> 10, mantissa = code & 1023;
        const double value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024.0 + mantissa, exponent - 25);
        wrong += double(from_half(std::uint16_t(code))) != value || to_half(float(value)) != code;
        if (code == 0x7bff) break;
        const double between = 0.5 * (value + double(from_half(std::uint16_t(code + 1))));
        wrong += to_half(float(between)) != (code % 2 == 0 ? code : code + 1);
        wrong += to_half(std::nextafter(float(between), 0.0f)) != code;
        wrong += to_half(std::nextafter(float(between), 1e9f)) != code + 1;
    }
    CHECK(wrong == 0);
}
