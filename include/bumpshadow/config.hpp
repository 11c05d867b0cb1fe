#pragma once

// What a build needs, said before anything else can fail. GCC and Clang go on after an #error, with hundreds of lines
// that bury it; a file that is not there stops them.
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ < 11
#error "bumpshadow needs GCC 11 or newer: choose a newer compiler, with CMake by -DCMAKE_CXX_COMPILER=..."
#include "the error above says what to do"
#elif defined(__clang__) && !defined(__apple_build_version__) && __clang_major__ < 13
#error "bumpshadow needs Clang 13 or newer: choose a newer compiler, with CMake by -DCMAKE_CXX_COMPILER=..."
#include "the error above says what to do"
#elif defined(_MSC_VER) && _MSC_VER < 1929
#error "bumpshadow needs Visual Studio 2019 16.11 or newer"
#elif !defined(__cpp_concepts) || __cplusplus < 202002L && (!defined(_MSVC_LANG) || _MSVC_LANG < 202002L)
#error "bumpshadow needs C++20: compile with -std=c++20 or /std:c++20, or link the CMake target bumpshadow::bumpshadow"
#include "the error above says what to do"
#endif

#include <version>
#if defined(_LIBCPP_VERSION) && !__has_include(<memory_resource>)
#error "bumpshadow needs libc++ 16 or newer (for <memory_resource>): choose a newer one, or -stdlib=libstdc++"
#include "the error above says what to do"
#endif

// What a build of bumpshadow can choose. Define a macro before the first include, the same in every translation unit.

// Checks for programmer errors (a texel outside the map handed to a single-texel function). Expected failures are a
// `status` instead, see status.hpp.
#ifndef BUMPSHADOW_ASSERT
#include <cassert>
#define BUMPSHADOW_ASSERT(condition) assert(condition)
#endif

// How hot loops are vectorized: values of BUMPSHADOW_SIMD. Never guessed from the headers that happen to be installed.
//   0  plain loops
//   1  the vector extensions of GCC and Clang (default there, but for WebAssembly without -msimd128, where they are
//      slower than 0); the width follows the target, e.g. -march=native
//   2  xsimd, which the build then has to provide
#define BUMPSHADOW_SIMD_NONE 0
// Value of BUMPSHADOW_SIMD for the compiler's own vectors.
#define BUMPSHADOW_SIMD_VECTOR_EXTENSIONS 1
// Value of BUMPSHADOW_SIMD for xsimd.
#define BUMPSHADOW_SIMD_XSIMD 2

// One of these three, the same in every translation unit.
#ifndef BUMPSHADOW_SIMD
#if (defined(__GNUC__) || defined(__clang__)) && (!defined(__wasm__) || defined(__wasm_simd128__))
#define BUMPSHADOW_SIMD BUMPSHADOW_SIMD_VECTOR_EXTENSIONS
#else
#define BUMPSHADOW_SIMD BUMPSHADOW_SIMD_NONE
#endif
#endif

#if BUMPSHADOW_SIMD < 0 || BUMPSHADOW_SIMD > 2
#error "BUMPSHADOW_SIMD is 0 (plain loops), 1 (vector extensions) or 2 (xsimd)"
#endif
