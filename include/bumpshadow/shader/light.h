// Elevation of a light, seen from the surface, in the quantity that a texture stores. `light` points to the light in
// tangent space, of any length whose square neither overflows nor vanishes; beyond that the level is wrong or infinite,
// but a number. A light straight up gives a large finite number, the zero vector 0.
//
// A texture stores slopes over max_slope, which is 0 for a flat map: divide by max(max_slope, 1e-6), so that 0 / 0 does
// not arise.

// Tangent of the elevation, at most 1e15 light.z in size.
BUMPSHADOW_FUNCTION float bumpshadow_slope(vec3 light) {
    return light.z * inversesqrt(bumpshadow_square(vec2(light.x, light.y)));
}

// Sine of the elevation.
BUMPSHADOW_FUNCTION float bumpshadow_sine(vec3 light) {
    return light.z * inversesqrt(light.z * light.z + bumpshadow_square(vec2(light.x, light.y)));
}

// Elevation in radians.
BUMPSHADOW_FUNCTION float bumpshadow_angle(vec3 light) { return atan(bumpshadow_slope(light)); }
