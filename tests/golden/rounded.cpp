// Bytes that are the same on every machine although numbers are rounded on the way, because none comes near to where a
// byte changes. What is expected is computed here from the papers' equations in double precision.

#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/factor_cube.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "golden/slopes.hpp"

using namespace bumpshadow;

namespace {

// The nearest whole number, where rounding the other way would take more than `margin`.
int whole(double value, double margin) {
    const double nearest = std::floor(value + 0.5);
    REQUIRE(std::abs(value - nearest) < 0.5 - margin);
    return int(nearest);
}

}  // namespace

TEST_CASE("a factor cube") {
    // Figure 5.5 of Lengyel's chapter: linear in the angle between two of eight directions. 0 is 128, and opposite
    // directions share a channel. The rows of OpenGL's table of faces are +x -x +y -y +z -z.
    const factor_cube cube;
    const texture_layout layout = layout_of(cube);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(write_factor_cube(cube, {bytes, layout}));
    REQUIRE(bytes.size() == 6144);
    const auto direction = [](int face, double s, double t) -> std::array<double, 2> {
        switch (face) {
            case 0: return {1.0, -t};
            case 1: return {-1.0, -t};
            case 2: return {s, 1.0};
            case 3: return {s, -1.0};
            case 4: return {s, -t};
            default: return {-s, -t};
        }
    };
    int wrong = 0;
    for (int texel = 0; texel < 6 * 16 * 16; ++texel) {
        const int face = texel / 256, row = texel / 16 % 16, column = texel % 16;
        const auto [x, y] = direction(face, (column - 7.5) / 8.0, (row - 7.5) / 8.0);
        const double eighths = std::atan2(y, x) * 4.0 / std::acos(-1.0) + (y < 0.0 ? 8.0 : 0.0);
        const int first = int(eighths) % 8;
        std::array<double, 4> channels{};
        for (const int i : {first, first + 1})
            channels[std::size_t(i % 4)] = (1.0 - std::abs(eighths - i)) * (i % 8 < 4 ? 1.0 : -1.0);
        for (int c = 0; c < 4; ++c)
            wrong += std::to_integer<int>(bytes[std::size_t(4 * texel + c)]) !=
                     128 + whole(127.0 * channels[std::size_t(c)], 0.02);
    }
    CHECK(wrong == 0);
}

TEST_CASE("five coefficients of a Fourier series") {
    // Means of slope times sine or cosine over eight directions. A constant's byte is 255 times it; the others reach
    // from -1/pi to 1/pi, of which 1/pi is 127 steps above the byte for 0, 128. Sums of eight floats are off by 0.0002
    // of a step at the most.
    const golden::slopes map(8);
    const fourier encoding{.scale = {quantity::slope, golden::max_slope}};
    std::vector<std::byte> bytes[2];
    std::vector<texture> out;
    for (int i = 0; i < 2; ++i) {
        const texture_layout layout = layout_of(encoding, golden::extent, 1, i);
        bytes[i].resize(layout.required_size());
        out.push_back({bytes[i], layout});
    }
    REQUIRE(pack_fourier(map.view(), map.directions, encoding, {}, out));

    // Bearings go from +x towards +y, the angle t of the series from +y towards +x.
    const double root = std::sqrt(0.5), pi = std::acos(-1.0);
    const double x[8] = {1, root, 0, -root, -1, -root, 0, root}, y[8] = {0, root, 1, root, 0, -root, -1, -root};
    int wrong = 0;
    for (int texel = 0; texel < golden::extent.x * golden::extent.y; ++texel) {
        double constant = 0.0;
        std::array<double, 4> sums{};
        for (int i = 0; i < 8; ++i) {
            const double slope = golden::parts(i, texel % golden::extent.x, texel / golden::extent.x) / 256.0 / 8.0;
            constant += slope;
            sums[0] += slope * x[i];
            sums[1] += slope * y[i];
            sums[2] += slope * 2.0 * x[i] * y[i];
            sums[3] += slope * (y[i] * y[i] - x[i] * x[i]);
        }
        for (std::size_t c = 0; c < 4; ++c)
            wrong +=
                std::to_integer<int>(bytes[0][4 * std::size_t(texel) + c]) != 128 + whole(127.0 * pi * sums[c], 0.004);
        wrong += std::to_integer<int>(bytes[1][std::size_t(texel)]) != whole(255.0 * constant, 0.004);
    }
    CHECK(wrong == 0);
}

TEST_CASE("blocks of BC4") {
    // Values that two ends and whole sevenths between them hit: any other choice of ends is further off by a 49th of a
    // byte, squared, at the least.
    constexpr int places[16] = {0, 7, 1, 2, 3, 4, 5, 6, 7, 0, 6, 5, 4, 3, 2, 1};
    constexpr struct { int low, high; } cases[] = {{0, 255}, {10, 80}, {100, 107}, {3, 241}};
    for (const auto [low, high] : cases) {
        // 3 bits each, the first texel's lowest: 0 is the first end, 1 the second, 2 to 7 lie between.
        float values[16];
        std::uint64_t codes = 0;
        for (int t = 0; t < 16; ++t) {
            const int place = places[t];
            values[t] = float(low * 7 + (high - low) * place) / (7.0f * 255.0f);
            codes |= (place == 7 ? 0ull : place == 0 ? 1ull : 8ull - std::uint64_t(place)) << (3 * t);
        }
        std::array<std::byte, 8> block{}, wanted{std::byte(high), std::byte(low)};
        for (int i = 0; i < 6; ++i) wanted[std::size_t(i) + 2] = std::byte(codes >> (8 * i) & 255u);
        encode_bc4(values, block.data());
        CHECK(block == wanted);
    }
    // All 0 and all 1: both ends are that.
    std::array<float, 16> one_value{};
    std::array<std::byte, 8> block{};
    for (const int byte : {0, 255}) {
        one_value.fill(float(byte) / 255.0f);
        encode_bc4(one_value.data(), block.data());
        CHECK(block == std::array<std::byte, 8>{std::byte(byte), std::byte(byte)});
    }
}
