#pragma once

// All of bumpshadow's CPU side, but encode/stb_blocks.hpp, which needs stb. Each header can also be included alone.

#include <bumpshadow/glm.hpp>  // first: it says what is missing

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/choices.hpp>
#include <bumpshadow/config.hpp>
#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/emboss_shift.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/plan.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/reference/pixel_shadow.hpp>
#include <bumpshadow/reference/reflection.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/reference/shadow_edge.hpp>
#include <bumpshadow/reference/triangle.hpp>
#include <bumpshadow/shader/bake_plan.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>
#include <bumpshadow/version.hpp>
