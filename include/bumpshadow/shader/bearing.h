// Bearing of a direction in the surface: a fraction of a turn, 0 along +x, 0.25 along +y, in [-0.125, 0.875]: a
// texture coordinate for a sampler that repeats. v of any length whose components' ratio can be computed; (0, 0) gives
// 0. The function has to be the one that the slices were baked for.
//
// Error against the true angle: exact 0, quintic 0.04, quadratic 0.21, octant (Forsyth) 1.90, diamond 4.07 degrees.

// Ratio of the components, in [-1, 1], counted from the nearest axis.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_ratio(vec2 v) {
    return abs(v.y) > abs(v.x) ? -v.x / v.y : v.y / (v.x == 0.0f ? 1.0f : v.x);
}

// Bearing of the nearest axis.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_axis(vec2 v) {
    return abs(v.y) > abs(v.x) ? (v.y > 0.0f ? 0.25f : 0.75f) : (v.x >= 0.0f ? 0.0f : 0.5f);
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_exact(vec2 v) {
    return bumpshadow_bearing_axis(v) + 0.15915494f * atan(bumpshadow_bearing_ratio(v));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_quintic(vec2 v) {
    float ratio = bumpshadow_bearing_ratio(v);
    float square = ratio * ratio;
    return bumpshadow_bearing_axis(v) + ratio * (0.125f + (1.0f - square) * (0.033321934f - 0.01210633f * square));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_quadratic(vec2 v) {
    float ratio = bumpshadow_bearing_ratio(v);
    return bumpshadow_bearing_axis(v) + ratio * (0.16846226f - 0.04346226f * abs(ratio));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_octant(vec2 v) {
    float ratio = bumpshadow_bearing_ratio(v);
    return bumpshadow_bearing_axis(v) + 0.1767767f * ratio * inversesqrt(1.0f + ratio * ratio);
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_diamond(vec2 v) {
    float ratio = bumpshadow_bearing_ratio(v);
    return bumpshadow_bearing_axis(v) + 0.25f * ratio / (1.0f + abs(ratio));
}
