#pragma once

// What a set-up costs and what it gets wrong on a given height map: includes all of measure/. Sizes for the cost in
// memory are texture_layout::bytes_per_texel() and fetches().

#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/measure/flip.hpp>
#include <bumpshadow/measure/image.hpp>
#include <bumpshadow/measure/mismatch.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/measure/time.hpp>
