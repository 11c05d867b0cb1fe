// Bearing of a direction in the surface: a fraction of a turn, 0 along +x, 0.25 along +y, in [-0.125, 0.875]: a
// texture coordinate for a sampler that repeats. v of any length whose square neither overflows nor vanishes; (0, 0)
// gives 0. The function has to be the one that the slices were baked for.
//
// Error against the true angle: exact 0, quintic 0.012, cubic 0.12, quadratic 0.21, octant (Forsyth) 1.90, diamond 4.07
// degrees. Cubic, quintic and octant share the reciprocal square root with the slope of the light.

// Square of a length, never 0. Its inverse root is shared by all that is computed from the same vector.
BUMPSHADOW_FUNCTION float bumpshadow_square(vec2 v) { return v.x * v.x + (v.y * v.y + 1e-30f); }

// Component of v across the nearest axis.
BUMPSHADOW_FUNCTION float bumpshadow_across(vec2 v) { return abs(v.y) > abs(v.x) ? -v.x : v.y; }

// Bearing of v, given that of the direction whose component across is the same and whose other one is |x| on the x
// axis.
BUMPSHADOW_FUNCTION float bumpshadow_unfold(vec2 v, float turns) {
    bool steep = abs(v.y) > abs(v.x);
    float half_turn = (steep ? v.y : v.x) < 0.0f ? 0.5f - turns : turns;
    return steep ? half_turn + 0.25f : half_turn;
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_exact(vec2 v) {
    float along = max(max(abs(v.x), abs(v.y)), 1e-30f);
    return bumpshadow_unfold(v, 0.15915494f * atan(bumpshadow_across(v) / along));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_quintic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    float square = sine * sine;
    return bumpshadow_unfold(v, sine * (0.15944586f + square * (0.022631394f + square * 0.024060546f)));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_cubic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    return bumpshadow_unfold(v, sine * (0.15703793f + 0.039477522f * sine * sine));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_quadratic(vec2 v) {
    float ratio = bumpshadow_across(v) / max(max(abs(v.x), abs(v.y)), 1e-30f);
    return bumpshadow_unfold(v, ratio * (0.16846226f - 0.04346226f * abs(ratio)));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_octant(vec2 v) {
    return bumpshadow_unfold(v, 0.1767767f * bumpshadow_across(v) * inversesqrt(bumpshadow_square(v)));
}

BUMPSHADOW_FUNCTION float bumpshadow_bearing_diamond(vec2 v) {
    return bumpshadow_unfold(v, 0.25f * bumpshadow_across(v) / max(abs(v.x) + abs(v.y), 1e-30f));
}
