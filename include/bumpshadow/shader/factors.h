// What each of eight horizons, at 0, 45 ... 315 degrees, adds to the one towards a light: two neighbors have a part,
// all others 0. They add up to 1.
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.3.

// The eight factors, in [0, 1].
struct bumpshadow_eight {
    vec4 layer0;  // 0, 45, 90, 135 degrees
    vec4 layer1;  // 180, 225, 270, 315 degrees
};

// From a factor cube as published, sampled with the light's direction: positive for layer 0, negative for layer 1
// (equation 5.3). A factor of 0 is stored as 128 and adds 1/255, so that all but the two wanted horizons leak a little.
BUMPSHADOW_FUNCTION bumpshadow_eight bumpshadow_factors_published_cube(vec4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = clamp(texel * 2.0f - 1.0f, 0.0f, 1.0f);
    factors.layer1 = clamp(texel * -2.0f + 1.0f, 0.0f, 1.0f);
    return factors;
}

// Factors of layer 0 from a cube in which 128 of 255 stands for 0: at the same cost, and nothing leaks.
BUMPSHADOW_FUNCTION vec4 bumpshadow_layer0_biased_cube(vec4 texel) {
    return clamp(texel * 2.007874f - 1.007874f, 0.0f, 1.0f);
}
// Factors of layer 1 from the same.
BUMPSHADOW_FUNCTION vec4 bumpshadow_layer1_biased_cube(vec4 texel) {
    return clamp(texel * -2.007874f + 1.007874f, 0.0f, 1.0f);
}
// Both.
BUMPSHADOW_FUNCTION bumpshadow_eight bumpshadow_factors_biased_cube(vec4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = bumpshadow_layer0_biased_cube(texel);
    factors.layer1 = bumpshadow_layer1_biased_cube(texel);
    return factors;
}

// How far a direction has turned from the nearest axis to the diagonal, 0 to 1. sine: of its angle to the axis, that is
// the smaller component of the unit vector, 0 to 0.7071. Within 0.35 degrees of the true angle, exact at both ends;
// goes on growing beyond.
BUMPSHADOW_FUNCTION float bumpshadow_turn_to_diagonal(float sine) { return sine * (1.1769721f + 0.3355101f * sine); }

// Without a cube. light: to the light, in the surface, of any length whose square neither overflows nor vanishes; (0,
// 0) counts as +x, as for bearings.
BUMPSHADOW_FUNCTION bumpshadow_eight bumpshadow_factors(vec2 light) {
    float inverse = inversesqrt(bumpshadow_square(light));
    float x = (light.x + 1e-15f) * inverse;
    float y = light.y * inverse;
    // The turn away from the other axis, with the component's sign.
    x = x * (1.1769721f + 0.3355101f * abs(x));
    y = y * (1.1769721f + 0.3355101f * abs(y));
    float along_x = 1.0f - abs(y);
    float along_y = 1.0f - abs(x);
    bumpshadow_eight factors;
    factors.layer0 = clamp(vec4(min(along_x, x), min(x, y), min(along_y, y), min(-x, y)), 0.0f, 1.0f);
    factors.layer1 = clamp(vec4(min(along_x, -x), min(-x, -y), min(along_y, -y), min(x, -y)), 0.0f, 1.0f);
    return factors;
}

// The same from a bearing, in turns, any number.
BUMPSHADOW_FUNCTION bumpshadow_eight bumpshadow_factors_of_bearing(float bearing) {
    // Turns to each direction of layer 0; the ones of layer 1 lie opposite.
    vec4 away = abs(fract(vec4(bearing, bearing, bearing, bearing) + vec4(0.5f, 0.375f, 0.25f, 0.125f)) - 0.5f);
    bumpshadow_eight factors;
    factors.layer0 = clamp(1.0f - 8.0f * away, 0.0f, 1.0f);
    factors.layer1 = clamp(8.0f * away - 3.0f, 0.0f, 1.0f);
    return factors;
}
