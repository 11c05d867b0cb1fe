// BC4 blocks: the decoder by hand, blocks that can be exact, bounds, and against a search over all ends.

#include <bumpshadow/encode/bc4.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

struct block {
    std::byte bytes[8];
};

block from_bytes(int first, int second, std::uint64_t codes) {
    block b{};
    b.bytes[0] = std::byte(first);
    b.bytes[1] = std::byte(second);
    for (int i = 0; i < 6; ++i) b.bytes[2 + i] = std::byte((codes >> (8 * i)) & 0xffu);
    return b;
}

// Squared error, in bytes.
double error_of(const block& b, const float* values) {
    float found[16];
    decode_bc4(b.bytes, found);
    double sum = 0.0;
    for (int t = 0; t < 16; ++t) sum += std::pow(255.0 * (double(found[t]) - double(values[t])), 2);
    return sum;
}

double encoded_error(const float* values) {
    block b;
    encode_bc4(values, b.bytes);
    return error_of(b, values);
}

// The least error of any two ends, by trying all of them.
double least_error(const float* values) {
    double least = 1e30;
    for (int first = 0; first < 256; ++first)
        for (int second = 0; second < 256; ++second) {
            double palette[8] = {double(first), double(second), 0, 0, 0, 0, 0, 255};
            const int between = first > second ? 7 : 5;
            for (int i = 1; i < between; ++i) palette[i + 1] = (first * (between - i) + second * i) / double(between);
            double sum = 0.0;
            for (int t = 0; t < 16 && sum < least; ++t) {
                double nearest = 1e30;
                for (const double p : palette) nearest = std::min(nearest, std::abs(p - 255.0 * double(values[t])));
                sum += nearest * nearest;
            }
            least = std::min(least, sum);
        }
    return least;
}

// What encoders do that take the extremes as ends: eight values between them.
double extremes_error(const float* values) {
    const auto [low, high] = std::minmax_element(values, values + 16);
    const double a = std::round(255.0 * double(*low)), b = std::round(255.0 * double(*high));
    double sum = 0.0;
    for (int t = 0; t < 16; ++t) {
        double nearest = 1e30;
        for (int i = 0; i < 8; ++i)
            nearest = std::min(nearest, std::abs(a + (b - a) * i / 7.0 - 255.0 * double(values[t])));
        sum += nearest * nearest;
    }
    return sum;
}

}  // namespace

TEST_CASE("the decoder, by hand") {
    // Texel t has code t % 8.
    std::uint64_t codes = 0;
    for (std::uint64_t t = 0; t < 16; ++t) codes |= (t % 8) << (3 * t);
    float values[16];
    decode_bc4(from_bytes(210, 0, codes).bytes, values);
    const int eight[8] = {210, 0, 180, 150, 120, 90, 60, 30};
    for (int t = 0; t < 16; ++t) CHECK(values[t] == doctest::Approx(eight[t % 8] / 255.0).epsilon(1e-6));
    decode_bc4(from_bytes(50, 200, codes).bytes, values);
    const int six[8] = {50, 200, 80, 110, 140, 170, 0, 255};
    for (int t = 0; t < 16; ++t) CHECK(values[t] == doctest::Approx(six[t % 8] / 255.0).epsilon(1e-6));
    decode_bc4(from_bytes(77, 77, codes).bytes, values);  // equal ends: the second form
    CHECK(values[6] == 0.0f);
    CHECK(values[7] == 1.0f);
    CHECK(values[3] == doctest::Approx(77 / 255.0));
}

TEST_CASE("golden blocks") {
    float values[16];
    const auto check = [&](int first, int second, std::uint64_t codes) {
        block b;
        encode_bc4(values, b.bytes);
        const block wanted = from_bytes(first, second, codes);
        for (int i = 0; i < 8; ++i) CHECK(std::to_integer<int>(b.bytes[i]) == std::to_integer<int>(wanted.bytes[i]));
    };
    std::fill(values, values + 16, 0.0f);
    check(0, 0, 0);
    std::fill(values, values + 16, 1.0f);
    check(255, 255, 0);
    std::fill(values, values + 16, 100.0f / 255.0f);
    check(100, 100, 0);
    // 210, 180 ... 0, twice: exact with these ends.
    std::uint64_t codes = 0;
    for (int t = 0; t < 16; ++t) {
        values[t] = float(210 - 30 * (t % 8)) / 255.0f;
        const std::uint64_t place = std::uint64_t(t % 8);
        codes |= (place == 0 ? 0 : place == 7 ? 1 : place + 1) << (3 * t);
    }
    check(210, 0, codes);
    // 100, 110 ... 150 beside 0 and 255: only the second form has them all.
    codes = 0;
    for (int t = 0; t < 16; ++t) {
        const int k = t % 8;
        values[t] = k == 6 ? 0.0f : k == 7 ? 1.0f : float(100 + 10 * k) / 255.0f;
        codes |= std::uint64_t(k == 0 ? 0 : k == 5 ? 1 : k < 5 ? k + 1 : k) << (3 * t);
    }
    check(100, 150, codes);
}

TEST_CASE("what 8 values can hold is exact") {
    shapes::noise random(2);
    for (int trial = 0; trial < 300; ++trial) {
        const int a = random.between(0, 255), b = random.between(0, 255);
        float values[16];
        for (float& v : values) v = float(random.between(0, 1) != 0 ? a : b) / 255.0f;
        CHECK(encoded_error(values) < 1e-3);
    }
}

TEST_CASE("values outside and not a number are clamped") {
    float values[16] = {-1.0f, 2.0f, std::nanf(""), 0.5f};
    block b;
    encode_bc4(values, b.bytes);
    float found[16];
    decode_bc4(b.bytes, found);
    CHECK(found[0] == 0.0f);
    CHECK(found[1] == 1.0f);
    CHECK(found[2] == 0.0f);
    CHECK(std::abs(found[3] - 0.5f) < 0.5f / 7.0f);
}

TEST_CASE("never worse than ends at the extremes, and close to the best of all ends") {
    shapes::noise random(9);
    double found = 0.0, best = 0.0, plain = 0.0;
    for (int trial = 0; trial < 60; ++trial) {
        // Ramps, edges, zeros beside a range, noise.
        float values[16];
        const double base = random.uniform(), gx = 0.2 * random.uniform(), gy = 0.2 * random.uniform() - 0.1;
        const int kind = trial % 4;
        for (int t = 0; t < 16; ++t) {
            double v = base + gx * (t % 4) + gy * (t / 4);
            if (kind == 1 && t % 4 > t / 4) v = 0.3 * v;
            if (kind == 2 && random.uniform() < 0.4) v = 0.0;
            if (kind == 3) v = random.uniform();
            values[t] = float(std::clamp(v, 0.0, 1.0));
        }
        const double error = encoded_error(values), extremes = extremes_error(values);
        CHECK(error <= extremes + 1e-3);
        found += error;
        plain += extremes;
        best += least_error(values);
    }
    CHECK(found < 0.75 * plain);
    CHECK(found < 1.06 * best);
}

TEST_CASE("a row of blocks: what lies beyond the map repeats its border") {
    float rows[2][6];
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 6; ++x) rows[y][x] = float(10 * x + 60 * y) / 255.0f;
    std::vector<std::byte> bytes(16);
    std::vector<std::vector<float>> seen;
    encode_block_row([&](int r) { return rows[r]; }, 2, 6, bytes.data(),
                     [&](const float* values, std::byte* to) {
                         seen.emplace_back(values, values + 16);
                         CHECK(to == bytes.data() + 8 * (seen.size() - 1));
                     });
    REQUIRE(seen.size() == 2);
    for (int t = 0; t < 16; ++t) {
        CHECK(seen[0][std::size_t(t)] == rows[std::min(t / 4, 1)][t % 4]);
        CHECK(seen[1][std::size_t(t)] == rows[std::min(t / 4, 1)][std::min(4 + t % 4, 5)]);
    }
}
