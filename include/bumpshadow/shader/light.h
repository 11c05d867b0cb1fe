// Elevation of a light, seen from the surface, in the quantity that a texture stores. `light` points to the light in
// tangent space, of any length whose square neither overflows nor vanishes. A light straight up gives a large finite
// number, the zero vector 0.

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
