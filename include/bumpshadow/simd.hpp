#pragma once

#include <bumpshadow/config.hpp>

#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_XSIMD
#include <xsimd/xsimd.hpp>
#endif

// The few operations that the hot loops need, on `width` floats at a time. Memory need not be aligned.
// The width follows the target of the translation unit: compile all of them for the same one.
namespace bumpshadow::simd {

#if BUMPSHADOW_SIMD == BUMPSHADOW_SIMD_XSIMD

using pack = xsimd::batch<float>;
inline constexpr int width = int(pack::size);

inline pack load(const float* from) { return pack::load_unaligned(from); }
inline void store(float* to, pack a) { a.store_unaligned(to); }
inline pack splat(float a) { return pack(a); }
inline pack subtract(pack a, pack b) { return a - b; }
inline pack multiply(pack a, pack b) { return a * b; }
inline pack multiply_add(pack a, pack b, pack c) { return xsimd::fma(a, b, c); }
inline pack max(pack a, pack b) { return xsimd::max(a, b); }
inline pack select_greater(pack a, pack b, pack yes, pack no) { return xsimd::select(a > b, yes, no); }

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
inline pack splat(float a) { return pack{} + a; }
inline pack subtract(pack a, pack b) { return a - b; }
inline pack multiply(pack a, pack b) { return a * b; }
inline pack multiply_add(pack a, pack b, pack c) { return a * b + c; }
inline pack max(pack a, pack b) { return a > b ? a : b; }
inline pack select_greater(pack a, pack b, pack yes, pack no) { return a > b ? yes : no; }

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
inline pack subtract(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] - b.lane[i]; });
}
inline pack multiply(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] * b.lane[i]; });
}
inline pack multiply_add(const pack& a, const pack& b, const pack& c) {
    return for_lanes([&](int i) { return a.lane[i] * b.lane[i] + c.lane[i]; });
}
inline pack max(const pack& a, const pack& b) {
    return for_lanes([&](int i) { return a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i]; });
}
inline pack select_greater(const pack& a, const pack& b, const pack& yes, const pack& no) {
    return for_lanes([&](int i) { return a.lane[i] > b.lane[i] ? yes.lane[i] : no.lane[i]; });
}

#endif

}  // namespace bumpshadow::simd
