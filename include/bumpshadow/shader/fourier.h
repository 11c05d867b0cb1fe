// The horizon towards a light from a Fourier series over the bearing: 3, 5, 7 or 9 coefficients. In whatever the
// coefficients were made of: sines, slopes or angles, over what stands for 1 there.
// With t = 0 along +y and 90 degrees along +x, as in the post below, the channels of the textures are
//   3  (sin t, cos t, constant, -)
//   5  (sin t, cos t, sin 2t, cos 2t)  (constant)
//   7  (sin t, cos t, sin 2t, cos 2t)  (sin 3t, cos 3t, constant, -)
//   9  (sin t, cos t, sin 2t, cos 2t)  (sin 3t, cos 3t, sin 4t, cos 4t)  (constant)
// scale, offset: those of the encoding, for a texture each; they hold the doubling of all but the constant.
// Source: Radial horizon maps ("Self-shadowing textures using radial horizon maps", 2010).

// (sin t, cos t) of a light's direction in the surface, of any length whose square neither overflows nor vanishes; (0,
// 0) gives (0, 0), which leaves the constant alone.
BUMPSHADOW_FUNCTION vec2 bumpshadow_fourier_direction(vec2 light) {
    return light * inversesqrt(bumpshadow_square(light));
}

// Coefficients from a texel.
BUMPSHADOW_FUNCTION vec4 bumpshadow_fourier_texel(vec4 texel, vec4 scale, vec4 offset) {
    return texel * scale + offset;
}

// The same where signed square roots are stored.
BUMPSHADOW_FUNCTION vec4 bumpshadow_fourier_root_texel(vec4 texel, vec4 scale, vec4 offset) {
    vec4 root = texel * scale + offset;
    return root * abs(root);
}

// For a texture of one channel.
BUMPSHADOW_FUNCTION float bumpshadow_fourier_root_constant(float texel, float scale, float offset) {
    float root = texel * scale + offset;
    return root * abs(root);
}

// The series is summed from its end: `higher` turned by t, and the next lower pair added.
BUMPSHADOW_FUNCTION vec2 bumpshadow_fourier_turn(vec2 higher, vec2 lower, vec2 direction) {
    return vec2(lower.x + higher.x * direction.y - higher.y * direction.x,
                lower.y + higher.y * direction.y + higher.x * direction.x);
}

// Horizon towards a light, 3 coefficients. texel: decoded; direction: from bumpshadow_fourier_direction.
BUMPSHADOW_FUNCTION float bumpshadow_fourier_3(vec3 texel, vec2 direction) {
    return texel.z + texel.x * direction.x + texel.y * direction.y;
}

// 5 coefficients, the constant from the second texture.
BUMPSHADOW_FUNCTION float bumpshadow_fourier_5(vec4 texel, float constant, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(texel.z, texel.w), vec2(texel.x, texel.y), direction);
    return constant + pair.x * direction.x + pair.y * direction.y;
}

// 7 coefficients. more: those of the second texture.
BUMPSHADOW_FUNCTION float bumpshadow_fourier_7(vec4 texel, vec3 more, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(more.x, more.y), vec2(texel.z, texel.w), direction);
    return bumpshadow_fourier_5(vec4(texel.x, texel.y, pair.x, pair.y), more.z, direction);
}

// 9 coefficients, the constant from the third texture.
BUMPSHADOW_FUNCTION float bumpshadow_fourier_9(vec4 texel, vec4 more, float constant, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(more.z, more.w), vec2(more.x, more.y), direction);
    return bumpshadow_fourier_7(texel, vec3(pair.x, pair.y, constant), direction);
}
