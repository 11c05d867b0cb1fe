#pragma once

// Settings that encoders, shaders and programs have in common. Needs no GLM.

#include <bumpshadow/config.hpp>

namespace bumpshadow {

// The bearing functions by name; bearing.hpp defines them. Octant without its phase.
enum class bearing_function : unsigned char { exact, quintic, cubic, octant, diamond };

// What of a horizon's elevation a texture stores. Any function that grows with the elevation serves, as long as the
// light is compared in the same one; they differ in how well they interpolate between slices and spend their bits.
enum class quantity : unsigned char {
    slope,  // its tangent, rise over run (Forsyth)
    sine,   // its sine (Lengyel)
    angle,  // the elevation itself, in radians
};

}  // namespace bumpshadow
