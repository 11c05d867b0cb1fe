// Shadow factor: 0 in shadow, 1 in light, and in [0, 1] for every input. `light` and `horizon` in the quantity that the
// texture stores, both over what stands for 1 there or both as they are; the edge of the shadow is 1 / k wide in it. A
// light below the surface (light < 0) gives 0, and one exactly on the horizon is lit (hard, c = 1) or half lit (c =
// 0.5). An infinite level gives 1, and one that is not a number (0 / 0, or infinity with k = 0) 0; but GLSL promises
// nothing of such numbers, and Mesa's atan makes others of them: any factor in [0, 1].

// No soft edge: the limit of large k.
BUMPSHADOW_FUNCTION float bumpshadow_shadow_hard(float light, float horizon) {
    // In this order, max takes the 0 where the other is not a number; here and below.
    return light >= max(0.0f, horizon) ? 1.0f : 0.0f;
}

// clamp(k (light - horizon) + c, 0, 1), for a light that is never below the surface or does not shine there anyway.
BUMPSHADOW_FUNCTION float bumpshadow_shadow_soft_above(float light, float horizon, float k, float c) {
    // clamp may keep what is not a number.
    return min(max(0.0f, min(k, 1e30f) * (light - horizon) + c), 1.0f);
}

// The same, and 0 for a light below the surface. c = 1: the edge lies inside the shadow (Lengyel 2016, equation 5.4); c
// = 0.5: it is centered. k from 0 to infinity.
BUMPSHADOW_FUNCTION float bumpshadow_shadow_soft(float light, float horizon, float k, float c) {
    return light >= 0.0f ? bumpshadow_shadow_soft_above(light, horizon, k, c) : 0.0f;
}

// Shadows that end with distance, all three in one unit: the factor up to `start`, 1 from `end` on.
BUMPSHADOW_FUNCTION float bumpshadow_shadow_fade(float factor, float distance, float start, float end) {
    return mix(factor, 1.0f, min(max(0.0f, (distance - start) / max(end - start, 1e-30f)), 1.0f));
}

// Place i of taps x taps of a pixel that covers many texels, row by row: from its middle, in sides of the pixel. The mean
// of their factors is the share of the pixel that is lit. Both are whole numbers, taps 1 to 1024, i below taps * taps.
BUMPSHADOW_FUNCTION vec2 bumpshadow_pixel_place(float i, float taps) {
    float row = floor((i + 0.5f) / taps);
    return vec2((i - row * taps + 0.5f) / taps - 0.5f, (row + 0.5f) / taps - 0.5f);
}
