#pragma once

#include <bumpshadow/glm.hpp>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

// The shader snippets as C++: the files below are the single source of what GLSL and HLSL get, so what the CPU
// reference computes is what a GPU runs.

// Shaders cannot write (min)(a, b) as headers have to after <windows.h>.
#pragma push_macro("min")
#pragma push_macro("max")
#undef min
#undef max

namespace bumpshadow::shader {

using glm::abs;
using glm::atan;
using glm::clamp;
using glm::dot;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::sqrt;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// What a snippet's function begins with; GLSL and HLSL have nothing there.
#define BUMPSHADOW_FUNCTION [[nodiscard]] inline

#include <bumpshadow/shader/bearing.h>
#include <bumpshadow/shader/emboss.h>
#include <bumpshadow/shader/factors.h>
#include <bumpshadow/shader/fourier.h>
#include <bumpshadow/shader/light.h>
#include <bumpshadow/shader/normal.h>
#include <bumpshadow/shader/shadow.h>
#include <bumpshadow/shader/sine_layers.h>
#include <bumpshadow/shader/slice_layers.h>
#include <bumpshadow/shader/ssbump.h>
#include <bumpshadow/shader/tangent_volume.h>
#include <bumpshadow/shader/vertex.h>

#undef BUMPSHADOW_FUNCTION

}  // namespace bumpshadow::shader

#pragma pop_macro("max")
#pragma pop_macro("min")
