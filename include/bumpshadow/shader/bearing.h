// Bearing of a direction in the surface: a fraction of a turn, 0 along +x, 0.25 along +y, in [-0.125, 0.875]: a
// texture coordinate for a sampler that repeats. v of any length whose square neither overflows nor vanishes; (0, 0)
// gives 0. The function has to be the one that the slices were baked for.
//
// Error against the true angle: exact 0.00004, quintic 0.012, cubic 0.12, octant (Forsyth) 1.90, diamond 4.07
// degrees. All but diamond share the reciprocal square root with the slope of the light, which makes cubic cheaper.

// Square of a length, never 0. Its inverse root is shared by all that is computed from the same vector.
BUMPSHADOW_FUNCTION float bumpshadow_square(vec2 v) { return v.x * v.x + (v.y * v.y + 1e-30f); }

// Nearer to the y axis than to the x axis. Two comparisons, since those of the quadrant are needed anyway.
BUMPSHADOW_FUNCTION bool bumpshadow_steep(vec2 v) { return (v.x >= v.y) != (v.x >= -v.y); }

// Component of v across the nearest axis.
BUMPSHADOW_FUNCTION float bumpshadow_across(vec2 v) { return bumpshadow_steep(v) ? -v.x : v.y; }

// Bearing of v, given that of the direction whose component across is the same and whose other one is |x| on the x
// axis.
BUMPSHADOW_FUNCTION float bumpshadow_unfold(vec2 v, float turns) {
    float past = turns - 0.25f;
    return (v.x >= -v.y ? past : -past) + (bumpshadow_steep(v) ? 0.5f : 0.25f);
}

// The true angle, by the minimax polynomial of arcsin: half of what atan costs, which reduces a range that is reduced
// already.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_exact(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    float square = sine * sine;
    float high = 0.0116049032f + square * (square * 0.0181935507f - 0.00773401597f);
    return bumpshadow_unfold(
        v, sine * (0.159153938f + square * (0.026577197f + square * (0.0111934934f + square * high))));
}

// s (c0 + c1 s^2 + c2 s^4), s being the sine of the angle from the nearest axis.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_quintic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    float square = sine * sine;
    return bumpshadow_unfold(v, sine * (0.15944586f + square * (0.022631394f + square * 0.024060546f)));
}

// s (c0 + c1 s^2).
BUMPSHADOW_FUNCTION float bumpshadow_bearing_cubic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    return bumpshadow_unfold(v, sine * (0.15703793f + 0.039477522f * sine * sine));
}

// Linear in s. Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, section 4.1.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_octant(vec2 v) {
    return bumpshadow_unfold(v, 0.1767767f * bumpshadow_across(v) * inversesqrt(bumpshadow_square(v)));
}

// The perimeter of |x| + |y| = 1. No square root.
BUMPSHADOW_FUNCTION float bumpshadow_bearing_diamond(vec2 v) {
    return bumpshadow_unfold(v, 0.25f * bumpshadow_across(v) / max(abs(v.x) + abs(v.y), 1e-30f));
}
