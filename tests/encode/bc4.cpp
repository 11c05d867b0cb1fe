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

TEST_CASE("the decoder, for all ends, in whole numbers") {
    // As D3D states it: of the first end 7 - i sevenths or 5 - i fifths, of the second one i.
    int wrong = 0;
    std::uint64_t codes = 0;
    for (std::uint64_t t = 0; t < 16; ++t) codes |= (t % 8) << (3 * t);
    for (int first = 0; first < 256; ++first)
        for (int second = 0; second < 256; ++second) {
            float found[16];
            decode_bc4(from_bytes(first, second, codes).bytes, found);
            const int parts = first > second ? 7 : 5;
            for (int code = 0; code < 8; ++code) {
                int numerator = code == 0 ? parts * first : parts * second;
                if (code > 1) numerator = (parts + 1 - code) * first + (code - 1) * second;
                if (parts == 5 && code > 5) numerator = code == 6 ? 0 : 5 * 255;
                // The float nearest to the fraction.
                wrong += found[code] != float(double(numerator) / (255.0 * parts)) || found[code + 8] != found[code];
            }
        }
    CHECK(wrong == 0);
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

TEST_CASE("blocks of one value, and of a range below a byte, are closer than 8 bits") {
    shapes::noise random(3);
    for (int trial = 0; trial < 2000; ++trial) {
        const double base = 254.0 * random.uniform(), range = trial % 2 == 0 ? 0.0 : random.uniform();
        float values[16];
        for (float& v : values) v = float((base + range * random.uniform()) / 255.0);
        // Nearest bytes alone would be off by up to a half.
        CHECK(std::sqrt(encoded_error(values) / 16.0) <= 0.125);
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

TEST_CASE("hardly ever worse than ends at the extremes, and close to the best of all ends") {
    shapes::noise random(9);
    double found = 0.0, best = 0.0, plain = 0.0;
    for (int trial = 0; trial < 60; ++trial) {
        // Ramps, edges, zeros beside a range, noise.
        float values[16];
        const double base = random.uniform(), gx = 0.2 * random.uniform(), gy = 0.2 * random.uniform() - 0.1;
        const int kind = trial % 4;
        for (int t = 0; t < 16; ++t) {
            const int x = t % 4, y = t / 4;
            double v = base + gx * x + gy * y;
            if (kind == 1 && x > y) v = 0.3 * v;
            if (kind == 2 && random.uniform() < 0.4) v = 0.0;
            if (kind == 3) v = random.uniform();
            values[t] = float(std::clamp(v, 0.0, 1.0));
        }
        const double error = encoded_error(values), extremes = extremes_error(values);
        // Ends are rounded to bytes after they have been chosen: a quarter of a square byte a value, of small errors.
        CHECK(error <= 1.1 * extremes + 16.0 * 0.25);
        found += error;
        plain += extremes;
        best += least_error(values);
    }
    CHECK(found < 0.75 * plain);
    CHECK(found < 1.06 * best);
}

TEST_CASE("a row of blocks: what lies beyond the map repeats its border, and neighbors do not matter") {
    shapes::noise random(5);
    for (const int width : {1, 4, 6, 63, 64, 65, 129, 150})
        for (const int rows : {1, 2, 4}) {
            const std::vector<float> line(std::size_t(width), 0.0f);
            std::vector<std::vector<float>> values(std::size_t(rows), line);
            for (std::size_t y = 0; y < values.size(); ++y)
                for (std::size_t x = 0; x < values[y].size(); ++x) {
                    // Flat, with extremes, and noise, side by side.
                    const double v = x / 4 % 3 == 0   ? 0.3
                                     : x / 4 % 3 == 1 ? std::floor(2.5 * random.uniform()) / 2.0
                                                      : random.uniform();
                    values[y][x] = float(v);
                }
            const std::size_t blocks = std::size_t(width + 3) / 4;
            std::vector<std::byte> bytes(8 * blocks + 1, std::byte(0x5a));
            encode_bc4_row([&](int r) { return values[std::size_t(r)].data(); }, rows, width, bytes.data());
            CHECK(bytes.back() == std::byte(0x5a));
            for (std::size_t i = 0; i < blocks; ++i) {
                float own[16];
                for (std::size_t t = 0; t < 16; ++t)
                    own[t] =
                        values[std::min(t / 4, std::size_t(rows - 1))][std::min(4 * i + t % 4, std::size_t(width - 1))];
                block alone;
                encode_bc4(own, alone.bytes);
                CHECK(std::equal(alone.bytes, alone.bytes + 8, bytes.data() + 8 * i));
            }
        }
}

TEST_CASE("the bytes are the same in every build: other compilers, vectors, fused products") {
    // Dyadic values: ramps, a few of them at the extremes, and noise. The sum was taken of a build without vectors.
    shapes::noise random(11);
    std::uint64_t sum = 14695981039346656037u;
    for (int trial = 0; trial < 2000; ++trial) {
        float values[16];
        const int base = random.between(0, 4096), gx = random.between(-300, 300), gy = random.between(-300, 300);
        for (int t = 0; t < 16; ++t) {
            int v = base + gx * (t % 4) + gy * (t / 4);
            if (trial % 3 == 1 && random.between(0, 3) == 0) v = random.between(0, 1) * 4096;
            if (trial % 3 == 2) v = random.between(0, 4096);
            values[t] = float(std::clamp(v, 0, 4096)) / 4096.0f;
        }
        block b;
        encode_bc4(values, b.bytes);
        for (const std::byte byte : b.bytes) sum = (sum ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211u;
    }
    CHECK(sum == 15119099231915513840u);
}
