// Embossing in one pass: the difference of a height map and itself shifted towards the light, as brightness of a base
// texture ("Ups and Downs" of Bump Mapping with DirectX 6, Gamasutra 1999). Heights are stored in 0 to 0.5; the byte of
// 0.5 is 128.

// What is added to the texture coordinates of the inverse height map, so that sides which face the light are
// brightened. light: towards the light in tangent space, of any length whose square neither overflows nor vanishes, 1e-15
// to 1e19 (beyond, the shift is too small, down to 0); from a vertex for a light that is near, and then interpolated.
// amount: the shift of a light at the horizon, in texture coordinates (texels over extent). 0 for the zero vector.
BUMPSHADOW_FUNCTION vec2 bumpshadow_emboss_shift(vec3 light, vec2 amount) {
    float inverse = inversesqrt(max(dot(light, light), 1e-30f));
    return vec2(light.x * inverse * amount.x, light.y * inverse * amount.y);
}

// Inverse of a height, in place of a second texture.
BUMPSHADOW_FUNCTION float bumpshadow_emboss_inverse(float height) { return 0.50196078f - height; }

// Height and shifted inverse added: 128/255 where the surface is flat, more where it faces the light.
BUMPSHADOW_FUNCTION float bumpshadow_emboss_relief(float height, float shifted_inverse) {
    return clamp(height + shifted_inverse, 0.0f, 1.0f);
}

// The base texture times twice the relief, so that flat leaves it as it is, in light of a color.
BUMPSHADOW_FUNCTION vec3 bumpshadow_emboss(float relief, vec3 base, vec3 color) {
    return min(2.0f * relief * base, vec3(1.0f, 1.0f, 1.0f)) * color;
}
