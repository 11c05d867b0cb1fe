// Bytes that are the same on every machine although numbers are rounded on the way, because none comes near to where a
// byte changes. What is expected was computed from the papers' equations by another program in double precision, which
// also gave the margins.

#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/factor_cube.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "golden/slopes.hpp"

using namespace bumpshadow;

namespace {

// FNV-1a, 64 bits (Fowler, Noll, Vo).
std::uint64_t hash_of(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::byte b : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3u;
    return hash;
}

}  // namespace

TEST_CASE("a factor cube") {
    // Figure 5.5 of Lengyel's chapter, from the angle of each texel's direction. The nearest to a step is 0.028 of one.
    const factor_cube cube;
    const texture_layout layout = layout_of(cube);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(write_factor_cube(cube, {bytes, layout}));
    CHECK(bytes.size() == 6144);
    CHECK(hash_of(bytes) == 0x4ca4bcdca6169a25u);
}

TEST_CASE("five coefficients of a Fourier series") {
    // Means of slope times sine or cosine over eight directions, in the default ranges. The nearest to a step is 0.005
    // of one, and sums of eight floats are off by 0.0002 of one at the most.
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
    CHECK(hash_of(bytes[0]) == 0x3d07bfaf384fbad2u);
    CHECK(hash_of(bytes[1]) == 0xbae256cb912a1b4du);
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
