#pragma once

#include <bumpshadow/config.hpp>

// GLM's vectors. Every header has them from here, before anything else of GLM's: one that is missing or too old is
// named by a sentence, not by what fails for want of it.

#if !__has_include(<glm/ext/vector_int2.hpp>)
#error "bumpshadow needs GLM 0.9.9.8 or newer: install it (Debian, Ubuntu: libglm-dev) or add its folder with -I"
#include "the error above says what to do"
#endif

#include <glm/ext/vector_int2.hpp>
#if GLM_VERSION < 998
#error "bumpshadow needs GLM 0.9.9.8 or newer: install a newer one, with CMake set glm_DIR to its folder"
#include "the error above says what to do"
#endif
// Alone, each is supported. Together they leave vectors that no constant expression can hold.
#if defined(GLM_FORCE_CTOR_INIT) && GLM_CONFIG_SIMD == GLM_ENABLE
#error "bumpshadow needs GLM without GLM_FORCE_CTOR_INIT where GLM uses SIMD: define one of the two"
#include "the error above says what to do"
#endif

#include <glm/ext/vector_bool2.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/ext/vector_int4.hpp>
