// The horizon towards a light, from a texel of each of two layers: 0, 45, 90, 135 and 180, 225, 270, 315 degrees. In
// whatever the layers store: sines as published, or slopes, over what stands for 1.
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.3.

// Equation 5.3. One set of factors serves every texture that is lit from the same direction.
BUMPSHADOW_FUNCTION float bumpshadow_sine_layers_factors(vec4 layer0, vec4 layer1, bumpshadow_eight factors) {
    return dot(layer0, factors.layer0) + dot(layer1, factors.layer1);
}

// The same straight from a texel of a biased cube, without the structure.
BUMPSHADOW_FUNCTION float bumpshadow_sine_layers_biased_cube(vec4 layer0, vec4 layer1, vec4 texel) {
    return dot(layer0, bumpshadow_layer0_biased_cube(texel)) + dot(layer1, bumpshadow_layer1_biased_cube(texel));
}

// The same as with bumpshadow_factors(light), by picking the two horizons that have a part: fewer instructions.
BUMPSHADOW_FUNCTION float bumpshadow_sine_layers(vec4 layer0, vec4 layer1, vec2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * inversesqrt(bumpshadow_square(light)));
    float along_x = light.x >= 0.0f ? layer0.x : layer1.x;
    float along_y = light.y >= 0.0f ? layer0.z : layer1.z;
    float diagonal_up = light.x >= 0.0f ? layer0.y : layer0.w;
    float diagonal_down = light.x >= 0.0f ? layer1.w : layer1.y;
    float axis = y > x ? along_y : along_x;
    float diagonal = light.y >= 0.0f ? diagonal_up : diagonal_down;
    return axis + part * (diagonal - axis);
}

// An array of both layers: the one to sample whole, and of the other one, 1 - this, only the first channel.
BUMPSHADOW_FUNCTION float bumpshadow_sine_first_layer(vec2 light) { return light.y >= 0.0f ? 0.0f : 1.0f; }

// What bumpshadow_sine_layers gives, from these two; fewer instructions still.
BUMPSHADOW_FUNCTION float bumpshadow_sine_half(vec4 first, float other, vec2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * inversesqrt(bumpshadow_square(light)));
    bool ahead = (light.x >= 0.0f) == (light.y >= 0.0f);
    float level = ahead ? first.x : other;
    float axis = y > x ? first.z : level;
    float diagonal = ahead ? first.y : first.w;
    return axis + part * (diagonal - axis);
}
