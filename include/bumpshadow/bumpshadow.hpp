#pragma once

// All of bumpshadow's CPU side. Each header can also be included alone.

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/config.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>
#include <bumpshadow/version.hpp>
