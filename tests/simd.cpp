// Every operation on packs, lane by lane, and the widths that the target has.

#include <bumpshadow/simd.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace simd = bumpshadow::simd;

namespace {

constexpr int width = simd::width;
using lanes = std::array<float, std::size_t(width)>;

#if BUMPSHADOW_SIMD != BUMPSHADOW_SIMD_NONE
#if defined(__AVX512F__)
static_assert(width == 16);
#elif defined(__AVX__)
static_assert(width == 8);
#elif defined(__SSE2__) || defined(__ARM_NEON) || defined(__wasm_simd128__)
static_assert(width == 4);
#endif
#endif

lanes stored(const simd::pack& a) {
    lanes result;
    simd::store(result.data(), a);
    return result;
}

template <class Function>
lanes each(Function function) {
    lanes result;
    for (int i = 0; i < width; ++i) result[std::size_t(i)] = function(i);
    return result;
}

}  // namespace

TEST_CASE("packs lane by lane") {
    // Loaded from a place that is aligned to floats only. Small whole numbers, whose products and sums are exact.
    std::array<float, std::size_t(2 * width + 1)> row;
    for (int i = 0; i <= 2 * width; ++i) row[std::size_t(i)] = float((5 * i + 3) % 11 - 4);
    const auto value = [&](int i) { return row[std::size_t(i + 1)]; };
    const auto other = [&](int i) { return value(i + width); };
    const simd::pack a = simd::load(&row[1]), b = simd::load(&row[std::size_t(width + 1)]);

    CHECK(stored(a) == each(value));
    CHECK(stored(simd::splat(0.1f)) == each([](int) { return 0.1f; }));
    CHECK(stored(simd::add(a, b)) == each([&](int i) { return value(i) + other(i); }));
    CHECK(stored(simd::subtract(a, b)) == each([&](int i) { return value(i) - other(i); }));
    CHECK(stored(simd::multiply(a, b)) == each([&](int i) { return value(i) * other(i); }));
    for (const float by : {8.0f, 3.0f, 49.0f, 1e-3f})
        CHECK(stored(simd::divide(a, simd::splat(by))) == each([&](int i) { return value(i) / by; }));
    CHECK(stored(simd::multiply_add(a, b, simd::splat(3.0f))) ==
          each([&](int i) { return value(i) * other(i) + 3.0f; }));
    CHECK(stored(simd::larger(a, b)) == each([&](int i) { return std::fmax(value(i), other(i)); }));
    CHECK(stored(simd::smaller(a, b)) == each([&](int i) { return std::fmin(value(i), other(i)); }));
    CHECK(stored(simd::select_greater(a, b, simd::splat(1.0f), simd::splat(2.0f))) ==
          each([&](int i) { return value(i) > other(i) ? 1.0f : 2.0f; }));

    CHECK(stored(simd::next(a, b)) == each([&](int i) { return value(i + 1); }));
    CHECK(stored(simd::next<2>(a, b)) == each([&](int i) { return value(i + 2); }));
    CHECK(stored(simd::next<width - 1>(a, b)) == each([&](int i) { return value(i + width - 1); }));
    CHECK(stored(simd::even(a, b)) == each([&](int i) { return value(2 * i); }));
    CHECK(stored(simd::odd(a, b)) == each([&](int i) { return value(2 * i + 1); }));
    CHECK(stored(simd::zip_low(a, b)) == each([&](int i) { return i % 2 == 0 ? value(i / 2) : other(i / 2); }));
    CHECK(stored(simd::zip_high(a, b)) ==
          each([&](int i) { return i % 2 == 0 ? value((i + width) / 2) : other((i + width) / 2); }));
}

TEST_CASE("fractions are cut off up to the largest whole float below 2^31") {
    for (const float v : {0.0f, 0.25f, 0.99999994f, 1.0f, 1.5f, 8388607.5f, 2147483520.0f})
        CHECK(stored(simd::whole(simd::splat(v))) == each([&](int) { return std::trunc(v); }));
}

TEST_CASE("streams to aligned and to other places") {
    alignas(64) std::array<float, std::size_t(3 * width)> to{};
    float* const places[] = {&to[0], &to[std::size_t(width + 1)]};
    for (float* place : places) simd::stream(place, simd::splat(7.0f));
    simd::stream_end();
    for (int i = 0; i < 3 * width; ++i) {
        const bool written = i < width || (i > width && i <= 2 * width);
        CHECK(to[std::size_t(i)] == (written ? 7.0f : 0.0f));
    }
}
