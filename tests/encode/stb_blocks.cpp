// Blocks made by stb_dxt, which the programs link: read back, and compared with our own.

#include <doctest/doctest.h>

#if !BUMPSHADOW_TESTS_READ_IMAGES

TEST_CASE("blocks of stb_dxt") { MESSAGE("skipped: built without the programs, which have stb"); }

#else

#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/stb_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/shapes.hpp"

using namespace bumpshadow;

TEST_CASE("blocks of stb_dxt: one channel, read back, and no better than our own in sum") {
    shapes::noise random(4);
    double own = 0.0, stb = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        float values[16], found[16];
        const double base = random.uniform(), slope = 0.3 * random.uniform();
        for (int t = 0; t < 16; ++t) {
            const int x = t % 4, y = t / 4;
            values[t] = float(std::clamp(base + slope * x - 0.5 * slope * y, 0.0, 1.0));
        }
        std::byte block[8];
        const auto error = [&] {
            decode_bc4(block, found);
            double sum = 0.0;
            for (int t = 0; t < 16; ++t) sum += std::pow(double(found[t]) - double(values[t]), 2);
            return sum;
        };
        encode_bc4(values, block);
        own += error();
        encode_bc4_stb(values, block);
        const double e = error();
        stb += e;
        const auto [low, high] = std::minmax_element(values, values + 16);
        // Half a step of seven between the extremes, and half a byte.
        CHECK(std::sqrt(e / 16.0) <= double(*high - *low) / 14.0 + 1.0 / 255.0);
    }
    CHECK(own < 0.9 * stb);
}

TEST_CASE("blocks of stb_dxt: colors") {
    std::byte texels[64], block[8];
    for (int i = 0; i < 16; ++i) {
        const int color[4] = {i < 8 ? 255 : 0, 0, i < 8 ? 0 : 255, 7 * i};
        for (int c = 0; c < 4; ++c) texels[4 * i + c] = std::byte(color[c]);
    }
    encode_bc1_stb(texels, block);
    for (int i = 0; i < 16; ++i) {
        const glm::vec4 found = decode_bc1(block, i);
        CHECK(found.x == (i < 8 ? 1.0f : 0.0f));
        CHECK(found.y == 0.0f);
        CHECK(found.z == (i < 8 ? 0.0f : 1.0f));
        CHECK(found.w == 1.0f);
    }
}

#endif
