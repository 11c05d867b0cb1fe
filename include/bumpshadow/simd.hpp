#pragma once

#include <cstdint>
#include <utility>

#include <bumpshadow/config.hpp>

#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_XSIMD
// It does not compile where <windows.h> has defined these.
#pragma push_macro("min")
#pragma push_macro("max")
#undef min
#undef max
#include <xsimd/xsimd.hpp>
#pragma pop_macro("max")
#pragma pop_macro("min")
#endif
#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_VECTOR_EXTENSIONS
#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE__)
#include <xmmintrin.h>
#endif
#endif

// The few operations that the hot loops need, on `width` floats at a time. Memory need not be aligned.
//   whole      values from 0 to below 2^31 without their fractions
//   larger, smaller  of numbers; what they make of NaN differs between machines
// Of two packs a, b, taken as one row of 2 width values:
//   next<n>    values n ... n + width - 1, n = 1 if not given
//   even, odd  every other one, from the first or from the second
//   zip_low, zip_high  a[0] b[0] a[1] b[1] ..., its first and its second half
// The width follows the target of the translation unit: compile all of them for the same one.
namespace bumpshadow::simd {

#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_XSIMD

using pack = xsimd::batch<float>;
inline constexpr int width = int(pack::size);

inline pack load(const float* from) { return pack::load_unaligned(from); }
inline void store(float* to, pack a) { a.store_unaligned(to); }
inline pack splat(float a) { return pack(a); }
inline pack add(pack a, pack b) { return a + b; }
inline pack subtract(pack a, pack b) { return a - b; }
inline pack multiply(pack a, pack b) { return a * b; }
// On Arm xsimd multiplies by an estimate of the inverse; every other quotient is the nearest float.
#if defined(__aarch64__)
inline pack divide(pack a, pack b) { return pack(vdivq_f32(a, b)); }
#else
inline pack divide(pack a, pack b) { return a / b; }
#endif
inline pack multiply_add(pack a, pack b, pack c) { return xsimd::fma(a, b, c); }
// GCC 12 warns of a value that AVX-512 leaves undefined on purpose.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
inline pack whole(pack a) { return xsimd::to_float(xsimd::to_int(a)); }
inline pack larger(pack a, pack b) { return (xsimd::max)(a, b); }
inline pack smaller(pack a, pack b) { return (xsimd::min)(a, b); }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
inline pack select_greater(pack a, pack b, pack yes, pack no) { return xsimd::select(a > b, yes, no); }

// Through memory: what the library calls by these names differs between its versions and targets.
template <class Lane>
inline pack choose(pack a, pack b, Lane lane) {
    alignas(64) float from[2 * width], to[width];
    store(from, a);
    store(from + width, b);
    for (int i = 0; i < width; ++i) to[i] = from[lane(i)];
    return load(to);
}

#elif BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_VECTOR_EXTENSIONS

#if defined(__AVX512F__)
inline constexpr int width = 16;
#elif defined(__AVX__)
inline constexpr int width = 8;
#else
inline constexpr int width = 4;
#endif

typedef float pack __attribute__((vector_size(4 * width)));
typedef float unaligned_pack __attribute__((vector_size(4 * width), aligned(4), may_alias));

inline pack load(const float* from) { return *reinterpret_cast<const unaligned_pack*>(from); }
inline void store(float* to, pack a) { *reinterpret_cast<unaligned_pack*>(to) = a; }
template <int... Lane>
inline pack splat(float a, std::integer_sequence<int, Lane...>) {
    return pack{(static_cast<void>(Lane), a)...};
}
inline pack splat(float a) { return splat(a, std::make_integer_sequence<int, width>()); }
inline pack add(pack a, pack b) { return a + b; }
inline pack subtract(pack a, pack b) { return a - b; }
inline pack multiply(pack a, pack b) { return a * b; }
inline pack divide(pack a, pack b) { return a / b; }
inline pack multiply_add(pack a, pack b, pack c) { return a * b + c; }
inline pack select_greater(pack a, pack b, pack yes, pack no) { return a > b ? yes : no; }
inline pack whole(pack a) {
    typedef int integers __attribute__((vector_size(4 * width)));
    return __builtin_convertvector(__builtin_convertvector(a, integers), pack);
}
// Said by name, since GCC makes a comparison and a choice of a > b ? a : b where one is a constant.
inline pack larger(pack a, pack b) {
#if defined(__AVX512F__)
    return _mm512_maskz_max_ps(0xffff, a, b);
#elif defined(__AVX__)
    return _mm256_max_ps(a, b);
#elif defined(__SSE__)
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
inline pack smaller(pack a, pack b) {
#if defined(__AVX512F__)
    return _mm512_maskz_min_ps(0xffff, a, b);
#elif defined(__AVX__)
    return _mm256_min_ps(a, b);
#elif defined(__SSE__)
    return _mm_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}

template <int... Lane>
inline pack shuffle(pack a, pack b) {
#if defined(__clang__)
    return __builtin_shufflevector(a, b, Lane...);
#else  // GCC has that since 12 only
    typedef std::int32_t lane_numbers __attribute__((vector_size(4 * width)));
    return __builtin_shuffle(a, b, lane_numbers{Lane...});
#endif
}
template <int First, int Step, int... Lane>
inline pack pick(pack a, pack b, std::integer_sequence<int, Lane...>) {
    return shuffle<(First + Lane * Step)...>(a, b);
}
template <int First, int... Lane>
inline pack alternate(pack a, pack b, std::integer_sequence<int, Lane...>) {
    return shuffle<(First + Lane / 2 + (Lane % 2) * width)...>(a, b);
}
using lanes = std::make_integer_sequence<int, width>;
template <int Ahead = 1>
inline pack next(pack here, pack after) {
    return pick<Ahead, 1>(here, after, lanes());
}
inline pack even(pack a, pack b) { return pick<0, 2>(a, b, lanes()); }
inline pack odd(pack a, pack b) { return pick<1, 2>(a, b, lanes()); }
inline pack zip_low(pack a, pack b) { return alternate<0>(a, b, lanes()); }
inline pack zip_high(pack a, pack b) { return alternate<width / 2>(a, b, lanes()); }

#else

inline constexpr int width = 8;
struct pack {
    float lane[width];
};

template <class Function>
inline pack for_lanes(Function function) {
    pack result;
    for (int i = 0; i < width; ++i) result.lane[i] = function(i);
    return result;
}
inline pack load(const float* from) {
    return for_lanes([&](int i) { return from[i]; });
}
inline void store(float* to, const pack& a) {
    for (int i = 0; i < width; ++i) to[i] = a.lane[i];
}
inline pack splat(float a) {
    return for_lanes([&](int) { return a; });
}
inline pack add(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] + b.lane[i]; });
}
inline pack subtract(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] - b.lane[i]; });
}
inline pack multiply(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] * b.lane[i]; });
}
inline pack divide(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] / b.lane[i]; });
}
inline pack multiply_add(const pack& a, const pack& b, const pack& c) {
    return for_lanes([&](int i) { return a.lane[i] * b.lane[i] + c.lane[i]; });
}
inline pack whole(const pack& a) {
    return for_lanes([&](int i) { return float(int(a.lane[i])); });
}
inline pack larger(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i]; });
}
inline pack smaller(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i]; });
}
inline pack select_greater(const pack& a, const pack& b, const pack& yes, const pack& no) {
    return for_lanes([&](int i) { return a.lane[i] > b.lane[i] ? yes.lane[i] : no.lane[i]; });
}
template <class Lane>
inline pack choose(const pack& a, const pack& b, Lane lane) {
    return for_lanes([&](int i) { return lane(i) < width ? a.lane[lane(i)] : b.lane[lane(i) - width]; });
}

#endif

#if BUMPSHADOW_SIMD != BUMPSHADOW_SIMD_VECTOR_EXTENSIONS
template <int Ahead = 1>
inline pack next(const pack& here, const pack& after) {
    return choose(here, after, [](int i) { return i + Ahead; });
}
inline pack even(const pack& a, const pack& b) {
    return choose(a, b, [](int i) { return 2 * i; });
}
inline pack odd(const pack& a, const pack& b) {
    return choose(a, b, [](int i) { return 2 * i + 1; });
}
inline pack zip_low(const pack& a, const pack& b) {
    return choose(a, b, [](int i) { return i / 2 + (i % 2) * width; });
}
inline pack zip_high(const pack& a, const pack& b) {
    return choose(a, b, [](int i) { return (i + width) / 2 + (i % 2) * width; });
}
#endif

// Stores to memory that is not read again soon, past the caches where the machine can: half the traffic, since the old
// content is not fetched. Other threads see it after stream_end().
inline void stream(float* to, const pack& a) {
#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_VECTOR_EXTENSIONS && defined(__SSE__)
    if (reinterpret_cast<std::uintptr_t>(to) % sizeof(pack) == 0) {
#if defined(__AVX512F__)
        _mm512_stream_ps(to, a);
#elif defined(__AVX__)
        _mm256_stream_ps(to, a);
#else
        _mm_stream_ps(to, a);
#endif
        return;
    }
#endif
    store(to, a);
}
inline void stream_end() {
#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_VECTOR_EXTENSIONS && defined(__SSE__)
    _mm_sfence();
#endif
}

// Transposes a square of width x width values: zipping the two halves log2(width) times does it.
inline void transpose(pack (&rows)[width]) {
    for (int round = 1; round < width; round *= 2) {
        pack zipped[width];
        for (int i = 0; i < width / 2; ++i) {
            zipped[2 * i] = zip_low(rows[i], rows[i + width / 2]);
            zipped[2 * i + 1] = zip_high(rows[i], rows[i + width / 2]);
        }
        for (int i = 0; i < width; ++i) rows[i] = zipped[i];
    }
}

}  // namespace bumpshadow::simd
