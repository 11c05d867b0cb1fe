// bumpshadow: shadows of the bumps of a surface on itself, from baked horizon maps. HLSL for shader model 4
// and newer (FXC, DXC). MIT license. Generated; the single source is in shader/*.h beside it.
//
// How to paste it
//   1. Put this text above your pixel shader, or include it there.
//   2. Set the switches that follow, or define them before this text.
//   3. Bind a texture that `bake --encoding` or the library packed: repeat in all directions (a volume over an arc of
//      bearings: clamp along w), linear filter. Mips: of arrays and flat textures alone. Volumes are sampled at level
//      0, since their third coordinate jumps where bearings wrap, which the hardware would take for a far surface.
//   4. Call what your encoding needs (below) with the light in tangent space: +x along u, +y along v, +z outwards.
//   5. Multiply the light's color by the factor. Ambient light stays as it is.
//
// Switches
#ifndef BUMPSHADOW_BEARING
#define BUMPSHADOW_BEARING 2   // 0 exact, 1 quintic, 2 cubic, 3 octant, 4 diamond: the function that slices were baked for
#endif
#ifndef BUMPSHADOW_QUANTITY
#define BUMPSHADOW_QUANTITY 0  // what the texture stores: 0 slope, 1 sine, 2 angle
#endif
#ifndef BUMPSHADOW_EDGE
#define BUMPSHADOW_EDGE 1      // 0 hard, 1 soft inside the shadow, 2 soft and centered
#endif
#ifndef BUMPSHADOW_BELOW
#define BUMPSHADOW_BELOW 1     // 1: no light from below the surface; 0: your lights never shine from there
#endif
#ifndef BUMPSHADOW_SAMPLE
#define BUMPSHADOW_SAMPLE 0    // 1: functions that take samplers, at the end
#endif
#if BUMPSHADOW_BEARING < 0 || BUMPSHADOW_BEARING > 4
#error "BUMPSHADOW_BEARING is 0 (exact), 1 (quintic), 2 (cubic), 3 (octant) or 4 (diamond)"
#endif
#if BUMPSHADOW_QUANTITY < 0 || BUMPSHADOW_QUANTITY > 2
#error "BUMPSHADOW_QUANTITY is 0 (slope), 1 (sine) or 2 (angle)"
#endif
#if BUMPSHADOW_EDGE < 0 || BUMPSHADOW_EDGE > 2
#error "BUMPSHADOW_EDGE is 0 (hard), 1 (soft, inside the shadow) or 2 (soft, centered)"
#endif
#if BUMPSHADOW_BELOW != 0 && BUMPSHADOW_BELOW != 1
#error "BUMPSHADOW_BELOW is 0 or 1"
#endif
#if BUMPSHADOW_SAMPLE != 0 && BUMPSHADOW_SAMPLE != 1
#error "BUMPSHADOW_SAMPLE is 0 or 1"
#endif
//
// Before: a normal-mapped shader                          After: a few lines more
//
//   Texture2D diffuse_map, normal_map;                      Texture3D horizons;   // 8 slices
//   SamplerState linear_repeat;
//   float4 main(float2 uv : TEXCOORD0, float3 to_light : TEXCOORD1, float3 to_eye : TEXCOORD2) : SV_Target {
//       float3 light = normalize(to_light);
//       float3 n = normalize(normal_map.Sample(linear_repeat, uv).xyz * 2.0 - 1.0);
//       float3 base = diffuse_map.Sample(linear_repeat, uv).rgb;
//       float diffuse = max(dot(n, light), 0.0);
//       float gloss = pow(max(dot(n, normalize(light + normalize(to_eye))), 0.0), 32.0);
//       float shadow = shadow_map_factor();  // what you have
//                                                           float max_slope = 4.0;  // as bake printed it; at least 1e-6
//                                                           float w = bumpshadow_bearing(light.xy) + 0.5 / 8.0;
//                                                           shadow *= bumpshadow_shadow(bumpshadow_level(light) / max_slope,
//                                                                                       horizons.SampleLevel(linear_repeat, float3(uv, w), 0.0).r, 8.0);
//       return float4(base * (ambient + shadow * light_color * diffuse) + shadow * light_color * gloss, 1.0);
//   }
//
// A vertex at a time: next to nothing is left to a pixel. In the vertex shader, and then in the pixel shader
//
//   float3 light = bumpshadow_to_tangent_space(to_light, tangent, bitangent, normal);
//   float2 at = bumpshadow_vertex_bearing(light, max_slope);
//   pair = bumpshadow_bearing_pair(at.x);  // float2 and float, interpolated
//   level = at.y;
//
//   float w = bumpshadow_pick_bearing(pair, fwidth(pair)) + 0.5 / 8.0;
//   shadow *= bumpshadow_shadow(level / max_slope, horizons.SampleLevel(linear_repeat, float3(uv, w), 0.0).r, 8.0);
//
// Encodings: what is sampled, and the horizon that it gives: over what stands for 1, so that it is compared with
// bumpshadow_level(light) / max_slope (sines of 0 to 90 degrees: bumpshadow_level(light)), max_slope at least 1e-6.
//   tangent volume   float3 at = float3(uv, bumpshadow_volume_coordinate(bumpshadow_bearing(light.xy), offset));
//                    volume.SampleLevel(how, at, 0.0).r
//   slices, array    float3 a = bumpshadow_tangent_layers(bearing, phase, N);
//                    bumpshadow_tangent_horizon(map.Sample(how, float3(uv, a.x)).r, map.Sample(how, float3(uv, a.y)).r, a.z)
//     over an arc    the same with bumpshadow_arc_coordinate(bearing, start, scale, offset); its sampler clamps w
//     array of those float3 a = bumpshadow_arc_layers(bearing, start, scale, offset, N);
//                    bumpshadow_tangent_horizon(map.Sample(how, float3(uv, a.x)).r, map.Sample(how, float3(uv, a.y)).r, a.z)
//     one bearing    map.Sample(how, uv).r: a light that is fixed needs no bearing
//   slice layers     float p = bumpshadow_slice_position(bearing, phase, N);
//                    float3 a = bumpshadow_grouped_layers(p, N / 4);
//                    bumpshadow_grouped_horizon(map.Sample(how, float3(uv, a.x)), map.Sample(how, float3(uv, a.y)).r, a.z)
//     overlapping    float2 a = bumpshadow_overlapping_layer(p);
//                    bumpshadow_overlapping_horizon(map.Sample(how, float3(uv, a.x)), a.y)
//   sine layers      bumpshadow_sine_layers(first, second, light.xy), or with a factor cube:
//                    bumpshadow_sine_layers_biased_cube(first, second, cube.Sample(how, light))
//   Fourier          bumpshadow_fourier_5(bumpshadow_fourier_texel(map.Sample(how, uv), scale, offset), constant,
//                                         bumpshadow_fourier_direction(light.xy))
//   SSBump           bumpshadow_ssbump_light(map.Sample(how, uv).rgb, bumpshadow_ssbump_weights(light)), in place of
//                    diffuse * shadow; bumpshadow_ssbump_lightmaps for three lightmaps

// ---- bearing ----
//
// Bearing of a direction in the surface: a fraction of a turn, 0 along +x, 0.25 along +y, in [-0.125, 0.875]: a
// texture coordinate for a sampler that repeats. v of any length whose square neither overflows nor vanishes; (0, 0)
// gives 0. The function has to be the one that the slices were baked for.
//
// Error against the true angle: exact 0.00004, quintic 0.012, cubic 0.12, octant (Forsyth) 1.90, diamond 4.07
// degrees. All but diamond share the reciprocal square root with the slope of the light, which makes cubic cheaper.

// Square of a length, never 0. Its inverse root is shared by all that is computed from the same vector.
float bumpshadow_square(float2 v) { return v.x * v.x + (v.y * v.y + 1e-30); }

// Nearer to the y axis than to the x axis. Two comparisons, since those of the quadrant are needed anyway.
bool bumpshadow_steep(float2 v) { return (v.x >= v.y) != (v.x >= -v.y); }

// Component of v across the nearest axis.
float bumpshadow_across(float2 v) { return bumpshadow_steep(v) ? -v.x : v.y; }

// Bearing of v, given that of the direction whose component across is the same and whose other one is |x| on the x
// axis.
float bumpshadow_unfold(float2 v, float turns) {
    float past = turns - 0.25;
    return (v.x >= -v.y ? past : -past) + (bumpshadow_steep(v) ? 0.5 : 0.25);
}

// The true angle, by the minimax polynomial of arcsin: half of what atan costs, which reduces a range that is reduced
// already.
float bumpshadow_bearing_exact(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    float square = sine * sine;
    float high = 0.0116049032 + square * (square * 0.0181935507 - 0.00773401597);
    return bumpshadow_unfold(
        v, sine * (0.159153938 + square * (0.026577197 + square * (0.0111934934 + square * high))));
}

// s (c0 + c1 s^2 + c2 s^4), s being the sine of the angle from the nearest axis.
float bumpshadow_bearing_quintic(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    float square = sine * sine;
    return bumpshadow_unfold(v, sine * (0.15944586 + square * (0.022631394 + square * 0.024060546)));
}

// s (c0 + c1 s^2).
float bumpshadow_bearing_cubic(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    return bumpshadow_unfold(v, sine * (0.15703793 + 0.039477522 * sine * sine));
}

// Linear in s. Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, section 4.1.
float bumpshadow_bearing_octant(float2 v) {
    return bumpshadow_unfold(v, 0.1767767 * bumpshadow_across(v) * rsqrt(bumpshadow_square(v)));
}

// The perimeter of |x| + |y| = 1. No square root.
float bumpshadow_bearing_diamond(float2 v) {
    return bumpshadow_unfold(v, 0.25 * bumpshadow_across(v) / max(abs(v.x) + abs(v.y), 1e-30));
}

// ---- emboss ----
//
// Embossing in one pass: the difference of a height map and itself shifted towards the light, as brightness of a base
// texture ("Ups and Downs" of Bump Mapping with DirectX 6, Gamasutra 1999). Heights are stored in 0 to 0.5; the byte of
// 0.5 is 128.

// What is added to the texture coordinates of the inverse height map, so that sides which face the light are
// brightened. light: towards the light in tangent space, of any length whose square neither overflows nor vanishes, 1e-15
// to 1e19 (beyond, the shift is too small, down to 0); from a vertex for a light that is near, and then interpolated.
// amount: the shift of a light at the horizon, in texture coordinates (texels over extent). 0 for the zero vector.
float2 bumpshadow_emboss_shift(float3 light, float2 amount) {
    float inverse = rsqrt(max(dot(light, light), 1e-30));
    return float2(light.x * inverse * amount.x, light.y * inverse * amount.y);
}

// Inverse of a height, in place of a second texture.
float bumpshadow_emboss_inverse(float height) { return 0.50196078 - height; }

// Height and shifted inverse added: 128/255 where the surface is flat, more where it faces the light.
float bumpshadow_emboss_relief(float height, float shifted_inverse) {
    return clamp(height + shifted_inverse, 0.0, 1.0);
}

// The base texture times twice the relief, so that flat leaves it as it is, in light of a color.
float3 bumpshadow_emboss(float relief, float3 base, float3 color) {
    return min(2.0 * relief * base, float3(1.0, 1.0, 1.0)) * color;
}

// ---- factors ----
//
// What each of eight horizons, at 0, 45 ... 315 degrees, adds to the one towards a light: two neighbors have a part,
// all others 0. They add up to 1.
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.3.

// The eight factors, in [0, 1].
struct bumpshadow_eight {
    float4 layer0;  // 0, 45, 90, 135 degrees
    float4 layer1;  // 180, 225, 270, 315 degrees
};

// From a factor cube as published, sampled with the light's direction: positive for layer 0, negative for layer 1
// (equation 5.3). A factor of 0 is stored as 128 and adds 1/255, so that all but the two wanted horizons leak a little.
bumpshadow_eight bumpshadow_factors_published_cube(float4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = clamp(texel * 2.0 - 1.0, 0.0, 1.0);
    factors.layer1 = clamp(texel * -2.0 + 1.0, 0.0, 1.0);
    return factors;
}

// Factors of layer 0 from a cube in which 128 of 255 stands for 0: at the same cost, and nothing leaks.
float4 bumpshadow_layer0_biased_cube(float4 texel) {
    return clamp(texel * 2.007874 - 1.007874, 0.0, 1.0);
}

// Factors of layer 1 from the same.
float4 bumpshadow_layer1_biased_cube(float4 texel) {
    return clamp(texel * -2.007874 + 1.007874, 0.0, 1.0);
}

// Both.
bumpshadow_eight bumpshadow_factors_biased_cube(float4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = bumpshadow_layer0_biased_cube(texel);
    factors.layer1 = bumpshadow_layer1_biased_cube(texel);
    return factors;
}

// How far a direction has turned from the nearest axis to the diagonal, 0 to 1. sine: of its angle to the axis, that is
// the smaller component of the unit vector, 0 to 0.7071. Within 0.35 degrees of the true angle, exact at both ends;
// goes on growing beyond.
float bumpshadow_turn_to_diagonal(float sine) { return sine * (1.1769721 + 0.3355101 * sine); }

// Without a cube. light: to the light, in the surface, of any length whose square neither overflows nor vanishes; (0,
// 0) counts as +x, as for bearings.
bumpshadow_eight bumpshadow_factors(float2 light) {
    float inverse = rsqrt(bumpshadow_square(light));
    float x = (light.x + 1e-15) * inverse;
    float y = light.y * inverse;
    // The turn away from the other axis, with the component's sign.
    x = x * (1.1769721 + 0.3355101 * abs(x));
    y = y * (1.1769721 + 0.3355101 * abs(y));
    float along_x = 1.0 - abs(y);
    float along_y = 1.0 - abs(x);
    bumpshadow_eight factors;
    factors.layer0 = clamp(float4(min(along_x, x), min(x, y), min(along_y, y), min(-x, y)), 0.0, 1.0);
    factors.layer1 = clamp(float4(min(along_x, -x), min(-x, -y), min(along_y, -y), min(x, -y)), 0.0, 1.0);
    return factors;
}

// The same from a bearing, in turns, any number.
bumpshadow_eight bumpshadow_factors_of_bearing(float bearing) {
    // Turns to each direction of layer 0; the ones of layer 1 lie opposite.
    float4 away = abs(frac(float4(bearing, bearing, bearing, bearing) + float4(0.5, 0.375, 0.25, 0.125)) - 0.5);
    bumpshadow_eight factors;
    factors.layer0 = clamp(1.0 - 8.0 * away, 0.0, 1.0);
    factors.layer1 = clamp(8.0 * away - 3.0, 0.0, 1.0);
    return factors;
}

// ---- fourier ----
//
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
float2 bumpshadow_fourier_direction(float2 light) {
    return light * rsqrt(bumpshadow_square(light));
}

// Coefficients from a texel.
float4 bumpshadow_fourier_texel(float4 texel, float4 scale, float4 offset) {
    return texel * scale + offset;
}

// The same where signed square roots are stored.
float4 bumpshadow_fourier_root_texel(float4 texel, float4 scale, float4 offset) {
    float4 root = texel * scale + offset;
    return root * abs(root);
}

// For a texture of one channel.
float bumpshadow_fourier_root_constant(float texel, float scale, float offset) {
    float root = texel * scale + offset;
    return root * abs(root);
}

// The series is summed from its end: `higher` turned by t, and the next lower pair added.
float2 bumpshadow_fourier_turn(float2 higher, float2 lower, float2 direction) {
    return float2(lower.x + higher.x * direction.y - higher.y * direction.x,
                lower.y + higher.y * direction.y + higher.x * direction.x);
}

// Horizon towards a light, 3 coefficients. texel: decoded; direction: from bumpshadow_fourier_direction.
float bumpshadow_fourier_3(float3 texel, float2 direction) {
    return texel.z + texel.x * direction.x + texel.y * direction.y;
}

// 5 coefficients, the constant from the second texture.
float bumpshadow_fourier_5(float4 texel, float constant, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(texel.z, texel.w), float2(texel.x, texel.y), direction);
    return constant + pair.x * direction.x + pair.y * direction.y;
}

// 7 coefficients. more: those of the second texture.
float bumpshadow_fourier_7(float4 texel, float3 more, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(more.x, more.y), float2(texel.z, texel.w), direction);
    return bumpshadow_fourier_5(float4(texel.x, texel.y, pair.x, pair.y), more.z, direction);
}

// 9 coefficients, the constant from the third texture.
float bumpshadow_fourier_9(float4 texel, float4 more, float constant, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(more.z, more.w), float2(more.x, more.y), direction);
    return bumpshadow_fourier_7(texel, float3(pair.x, pair.y, constant), direction);
}

// ---- light ----
//
// Elevation of a light, seen from the surface, in the quantity that a texture stores. `light` points to the light in
// tangent space, of any length whose square neither overflows nor vanishes; beyond that the level is wrong or infinite,
// but a number. A light straight up gives a large finite number, the zero vector 0.
//
// A texture stores slopes over max_slope, which is 0 for a flat map: divide by max(max_slope, 1e-6), so that 0 / 0 does
// not arise.

// Tangent of the elevation, at most 1e15 light.z in size.
float bumpshadow_slope(float3 light) {
    return light.z * rsqrt(bumpshadow_square(float2(light.x, light.y)));
}

// Sine of the elevation.
float bumpshadow_sine(float3 light) {
    return light.z * rsqrt(light.z * light.z + bumpshadow_square(float2(light.x, light.y)));
}

// Elevation in radians.
float bumpshadow_angle(float3 light) { return atan(bumpshadow_slope(light)); }

// ---- normal ----
//
// Normals as textures store them, to unit normals in tangent space (+y along growing v). `y` is 1 for a map whose y
// points along growing v (y-down, D3D) and -1 for one that points the other way (y-up, GL). Error of 8 bits, mean and
// largest: 0.17 and 0.39 degrees, in the partial-derivative form 0.15 and 0.32 times max_slope.

// stored: the three channels, in [0, 1]; (1, 1, 1) / 2, which has no direction, gives straight up.
float3 bumpshadow_normal(float3 stored, float y) {
    float3 normal = float3(2.0 * stored.x - 1.0, y * (2.0 * stored.y - 1.0), 2.0 * stored.z - 1.0);
    float square = dot(normal, normal);
    return square > 1e-4 ? normal * rsqrt(square) : float3(0.0, 0.0, 1.0);
}

// Partial-derivative form: stored are dz/dx and dz/dy of the surface, over max_slope, from [-1, 1] to [0, 1]. Needs two
// channels, and derivatives of several maps may be added. Steeper slopes are not stored. max_slope: up to 1e18, whose
// square does not overflow.
float3 bumpshadow_normal_of_derivatives(float2 stored, float max_slope, float y) {
    float3 normal = float3(max_slope * (1.0 - 2.0 * stored.x), y * max_slope * (1.0 - 2.0 * stored.y), 1.0);
    return normal * rsqrt(dot(normal, normal));
}

// ---- shadow ----
//
// Shadow factor: 0 in shadow, 1 in light, and in [0, 1] for every input. `light` and `horizon` in the quantity that the
// texture stores, both over what stands for 1 there or both as they are; the edge of the shadow is 1 / k wide in it. A
// light below the surface (light < 0) gives 0, and one exactly on the horizon is lit (hard, c = 1) or half lit (c =
// 0.5). An infinite level gives 1, and one that is not a number (0 / 0, or infinity with k = 0) 0; but GLSL promises
// nothing of such numbers, and Mesa's atan makes others of them: any factor in [0, 1].

// No soft edge: the limit of large k.
float bumpshadow_shadow_hard(float light, float horizon) {
    // In this order, max takes the 0 where the other is not a number; here and below.
    return light >= max(0.0, horizon) ? 1.0 : 0.0;
}

// clamp(k (light - horizon) + c, 0, 1), for a light that is never below the surface or does not shine there anyway.
float bumpshadow_shadow_soft_above(float light, float horizon, float k, float c) {
    // clamp may keep what is not a number.
    return min(max(0.0, min(k, 1e30) * (light - horizon) + c), 1.0);
}

// The same, and 0 for a light below the surface. c = 1: the edge lies inside the shadow (Lengyel 2016, equation 5.4); c
// = 0.5: it is centered. k from 0 to infinity.
float bumpshadow_shadow_soft(float light, float horizon, float k, float c) {
    return light >= 0.0 ? bumpshadow_shadow_soft_above(light, horizon, k, c) : 0.0;
}

// Shadows that end with distance, all three in one unit: the factor up to `start`, 1 from `end` on.
float bumpshadow_shadow_fade(float factor, float distance, float start, float end) {
    return lerp(factor, 1.0, min(max(0.0, (distance - start) / max(end - start, 1e-30)), 1.0));
}

// Place i of taps x taps of a pixel that covers many texels, row by row: from its middle, in sides of the pixel. The mean
// of their factors is the share of the pixel that is lit. Both are whole numbers, taps 1 to 1024, i below taps * taps.
float2 bumpshadow_pixel_place(float i, float taps) {
    float row = floor((i + 0.5) / taps);
    return float2((i - row * taps + 0.5) / taps - 0.5, (row + 0.5) / taps - 0.5);
}

// ---- sine_layers ----
//
// The horizon towards a light, from a texel of each of two layers: 0, 45, 90, 135 and 180, 225, 270, 315 degrees. In
// whatever the layers store: sines as published, or slopes, over what stands for 1.
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.3.

// Equation 5.3. One set of factors serves every texture that is lit from the same direction.
float bumpshadow_sine_layers_factors(float4 layer0, float4 layer1, bumpshadow_eight factors) {
    return dot(layer0, factors.layer0) + dot(layer1, factors.layer1);
}

// The same straight from a texel of a biased cube, without the structure.
float bumpshadow_sine_layers_biased_cube(float4 layer0, float4 layer1, float4 texel) {
    return dot(layer0, bumpshadow_layer0_biased_cube(texel)) + dot(layer1, bumpshadow_layer1_biased_cube(texel));
}

// The same as with bumpshadow_factors(light), by picking the two horizons that have a part: fewer instructions.
float bumpshadow_sine_layers(float4 layer0, float4 layer1, float2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * rsqrt(bumpshadow_square(light)));
    float along_x = light.x >= 0.0 ? layer0.x : layer1.x;
    float along_y = light.y >= 0.0 ? layer0.z : layer1.z;
    float diagonal_up = light.x >= 0.0 ? layer0.y : layer0.w;
    float diagonal_down = light.x >= 0.0 ? layer1.w : layer1.y;
    float axis = y > x ? along_y : along_x;
    float diagonal = light.y >= 0.0 ? diagonal_up : diagonal_down;
    return axis + part * (diagonal - axis);
}

// An array of both layers: the one to sample whole, and of the other one, 1 - this, only the first channel.
float bumpshadow_sine_first_layer(float2 light) { return light.y >= 0.0 ? 0.0 : 1.0; }

// What bumpshadow_sine_layers gives, from these two; fewer instructions still.
float bumpshadow_sine_half(float4 first, float other, float2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * rsqrt(bumpshadow_square(light)));
    bool ahead = (light.x >= 0.0) == (light.y >= 0.0);
    float level = ahead ? first.x : other;
    float axis = y > x ? first.z : level;
    float diagonal = ahead ? first.y : first.w;
    return axis + part * (diagonal - axis);
}

// ---- slice_layers ----
//
// Horizons as four neighboring slices in each RGBA layer of an array (encode/slice_layers.hpp): N slices, slice i at
// bearing phase + i / N. Layers are numbers for the third coordinate of an array texture. Values are the stored
// quantity over what stands for 1, and are compared with a light in the same unit.

// Position of a bearing among the slices, in [0, N], N by rounding alone. phase and bearing may have any sign.
float bumpshadow_slice_position(float bearing, float phase, float slices) {
    return frac(bearing - phase) * slices;
}

// Four slices a layer, two fetches; layers = N / 4. x, y: layers; z: position from the first channel of layer x on, in
// [0, 4].
float3 bumpshadow_grouped_layers(float position, float layers) {
    // A little less than a quarter, so that N finds the last layer; a place of 4 is as good as 0 in the next one.
    float layer = floor(position * 0.24999996);
    float next = layer + 1.0;
    return float3(layer, next < layers ? next : 0.0, position - 4.0 * layer);
}

// Horizon from layer x, and the first channel of layer y.
float bumpshadow_grouped_horizon(float4 values, float next_value, float place) {
    // Of the two neighbors one is even, the other odd.
    float past = place - 2.0;
    float even = abs(past) < 1.0 ? values.z : (past < 0.0 ? values.x : next_value);
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}

// Layers that overlap by one slice, one fetch. x: layer; y: position from its first channel on, in [0, 3].
float2 bumpshadow_overlapping_layer(float position) {
    // A little less than a third, so that N finds the last layer.
    float layer = floor(position * 0.33333328);
    return float2(layer, position - 3.0 * layer);
}

// Horizon from the layer.
float bumpshadow_overlapping_horizon(float4 values, float place) {
    float past = place - 2.0;
    float even = past < -1.0 ? values.x : values.z;
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}

// ---- ssbump ----
//
// Self-shadowed bump maps: three masks, red, green and blue, one for each vector of an orthonormal basis around the
// surface normal (Ols 2010; Green 2007, Efficient Self-Shadowed Radiosity Normal Mapping). In tangent space they are
//   red (sqrt(2/3), 0, 1/sqrt(3)), green (-1/sqrt(6), 1/sqrt(2), 1/sqrt(3)), blue (-1/sqrt(6), -1/sqrt(2), 1/sqrt(3)).
// masks: what the texture holds. Where the y of the map and that of the tangent space point opposite ways, pass the
// masks through bumpshadow_ssbump_other_hand first. All functions are finite for masks, vectors and lights of up to 1e15
// and lightmaps of up to 1e6; where squares overflow they give the zero vector or what is not a number.

// Left-handed (y-down) masks to right-handed (y-up) ones and back: green and blue swapped, which is the same as
// swapping the last two vectors of the basis. Doing both undoes it.
float3 bumpshadow_ssbump_other_hand(float3 masks) { return float3(masks.x, masks.z, masks.y); }

// Sum of the basis vectors, each times its mask; not unit length.
float3 bumpshadow_ssbump_sum(float3 masks) {
    return float3(0.81649658 * masks.x - 0.40824829 * (masks.y + masks.z), 0.70710678 * (masks.y - masks.z),
                0.57735027 * (masks.x + masks.y + masks.z));
}

// Three dots with the basis, the inverse of the sum: the masks of a unit normal as long as none is negative, which they
// are not up to a tilt of 35.26 degrees, asin(1/sqrt(3)); beyond, some bearings make one negative.
float3 bumpshadow_ssbump_project(float3 v) {
    float up = 0.57735027 * v.z;
    float side = 0.70710678 * v.y;
    float back = up - 0.40824829 * v.x;
    return float3(0.81649658 * v.x + up, back + side, back - side);
}

// Unit normal: of the surface for masks without occlusion, else bent towards where it is open. Black, and whatever is
// shorter than 1e-4, gives straight up.
float3 bumpshadow_ssbump_normal(float3 masks) {
    float3 sum = bumpshadow_ssbump_sum(masks);
    float square = dot(sum, sum);
    return square > 1e-8 ? sum * rsqrt(square) : float3(0.0, 0.0, 1.0);
}

// The basis concatenated with the way from tangent space to the world, whose axes are unit vectors in the world: once a
// vertex or a pixel. Any of the sums above then lands in the world. This is the vector of the red mask.
float3 bumpshadow_ssbump_world_red(float3 tangent, float3 normal) {
    return 0.81649658 * tangent + 0.57735027 * normal;
}

// The vector of the green mask in the world.
float3 bumpshadow_ssbump_world_green(float3 tangent, float3 bitangent, float3 normal) {
    return 0.70710678 * bitangent - 0.40824829 * tangent + 0.57735027 * normal;
}

// The vector of the blue mask in the world.
float3 bumpshadow_ssbump_world_blue(float3 tangent, float3 bitangent, float3 normal) {
    return 0.57735027 * normal - 0.40824829 * tangent - 0.70710678 * bitangent;
}

// Straight to a unit normal in the world; red, green, blue: from the three functions above. Black gives the zero
// vector, and masks shorter than 1e-10 a shorter one.
float3 bumpshadow_ssbump_world_normal(float3 masks, float3 red, float3 green, float3 blue) {
    float3 sum = masks.x * red + masks.y * green + masks.z * blue;
    return sum * rsqrt(max(dot(sum, sum), 1e-20));
}

// Where a ray from the eye goes on to: `eye` points to the eye, `normal` is unit length, both in the same space.
float3 bumpshadow_reflection(float3 eye, float3 normal) { return 2.0 * dot(normal, eye) * normal - eye; }

// A gray detail map multiplied in: the recovered normal stays. detail: 1 changes nothing.
float3 bumpshadow_ssbump_detail(float3 masks, float detail) { return masks * detail; }

// A second SSBump map as detail, packed so that flat is 0.5. The product may exceed 1: a target of 8 bits clamps it.
float3 bumpshadow_ssbump_detail_masks(float3 masks, float3 detail) { return 2.0 * masks * detail; }

// Diffuse light from three lightmaps, one for each basis vector b, each simply multiplied by its mask. Exact for a
// light from anywhere that all three face, since the basis is orthonormal. Lightmaps that hold the irradiance on planes
// facing b, the integral of L max(0, b . w), make broad light brighter than it is: an even sky on a flat texel 1.37
// times. With the dot not clamped (and the sum clamped at 0) that is exact, too. Measured on six height maps under
// suns of 25 and 50 degrees and a sky: root mean square error over the mean of traced light 24 % with directional
// occlusion, 29 % with ambient and 51 % without; dots not clamped: 19, 18 and 27 %.
float3 bumpshadow_ssbump_lightmaps(float3 masks, float3 red, float3 green, float3 blue) {
    return masks.x * red + masks.y * green + masks.z * blue;
}

// The same lightmaps with an ordinary normal map (McTaggart 2004, Half-Life 2 / Valve Source Shading): weights are the
// squares of the clamped dots, over their sum. A normal of any length from 1e-10 to 1e15.
float3 bumpshadow_normal_lightmaps(float3 normal, float3 red, float3 green, float3 blue) {
    float3 dots = max(bumpshadow_ssbump_project(normal), 0.0);
    float3 squares = dots * dots;
    float sum = max(squares.x + squares.y + squares.z, 1e-20);
    return (squares.x * red + squares.y * green + squares.z * blue) * (1.0 / sum);
}

// A dynamic light projected on the basis: three dots, clamped. light: towards the light in tangent space, as long as it
// is strong. Once an object or vertex for lights that are far. As with a normal map, a light below the surface still
// shines on slopes that face it, down to 54.7 degrees below; where it must not, pass the zero vector.
float3 bumpshadow_ssbump_weights(float3 light) { return max(bumpshadow_ssbump_project(light), 0.0); }

// Diffuse light of a dynamic light; weights: from the function above. In place of the clamped dot of normal and light,
// and of a shadow factor. At most the length of the masks times that of the light, not 1: with a unit light 1.003 for
// baked masks of 8 bits, sqrt(3) for white ones.
float bumpshadow_ssbump_light(float3 masks, float3 weights) { return dot(masks, weights); }

// ---- tangent_volume ----
//
// Horizons as slices of one channel (encode/tangent_volume.hpp): N slices, slice i at bearing phase + i / N. Values are
// the stored quantity over what stands for 1, and are compared with a light in the same unit.
// Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, sections 3 and 4.

// Third coordinate of a volume texture that repeats, for one fetch, at level 0: where bearings wrap the coordinate
// jumps, and implicit derivatives would ask for a coarse level there. offset: 0.5 / N - phase
float bumpshadow_volume_coordinate(float bearing, float offset) { return bearing + offset; }

// An array of layers, for two fetches: x, y: the two layers, z: part of the second one. phase and bearing may have any
// sign.
float3 bumpshadow_tangent_layers(float bearing, float phase, float slices) {
    float position = frac(bearing - phase) * slices;
    float layer = min(floor(position), slices - 1.0);
    float next = layer + 1.0;
    return float3(layer, next < slices ? next : 0.0, position - layer);
}

// Third coordinate of a volume texture that is clamped along it, for one fetch. Bearings beyond the arc get the nearer
// end.
float bumpshadow_arc_coordinate(float bearing, float start, float scale, float offset) {
    return scale * frac(bearing - start) + offset;
}

// The two layers of an array (x, y), and the part of the second one (z). Layer y may be one too many where its part is
// 0: hardware clamps it.
float3 bumpshadow_arc_layers(float bearing, float start, float scale, float offset, float slices) {
    float position = clamp(scale * frac(bearing - start) + offset, 0.0, slices - 1.0);
    float layer = floor(position);
    return float3(layer, layer + 1.0, position - layer);
}

// Horizon from the values of the two layers.
float bumpshadow_tangent_horizon(float value, float next_value, float part) {
    return lerp(value, next_value, part);
}

// ---- vertex ----
//
// What can be computed a vertex (or an object) at a time and interpolated over triangles.
//
// Three sets of interpolants, from the fewest instructions a pixel to the smallest error:
//   bearing, level           nothing left to do a pixel; needs the seam fix below, and is undefined over the triangle
//                            that the light stands above (Forsyth, Self-shadowing Bumpmap, section 4.1)
//   direction (2), level     a bearing a pixel; no seam, and defined everywhere
//   the light itself (3)     bearing and level a pixel; exact for a point light over a flat triangle

// Into tangent space: the axes are unit vectors, at right angles to each other.
float3 bumpshadow_to_tangent_space(float3 v, float3 tangent, float3 bitangent, float3 normal) {
    return float3(dot(v, tangent), dot(v, bitangent), dot(v, normal));
}

// Slope of a light, cut at `most`: a vertex that the light stands above would outweigh all others. max_slope serves for
// c = 1, and max_slope (1 + 0.5 / k) for c = 0.5.
float bumpshadow_vertex_slope(float3 light, float most) {
    return clamp(bumpshadow_slope(light), -most, most);
}

// Bearing (x, turns) and slope (y, cut at `most`) of a light; the bearing by bumpshadow_bearing_exact.
float2 bumpshadow_vertex_bearing_exact(float3 light, float most) {
    return float2(bumpshadow_bearing_exact(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// The same by bumpshadow_bearing_quintic.
float2 bumpshadow_vertex_bearing_quintic(float3 light, float most) {
    return float2(bumpshadow_bearing_quintic(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// The same by bumpshadow_bearing_cubic.
float2 bumpshadow_vertex_bearing_cubic(float3 light, float most) {
    return float2(bumpshadow_bearing_cubic(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// The same by bumpshadow_bearing_octant.
float2 bumpshadow_vertex_bearing_octant(float3 light, float most) {
    return float2(bumpshadow_bearing_octant(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// The same by bumpshadow_bearing_diamond.
float2 bumpshadow_vertex_bearing_diamond(float3 light, float most) {
    return float2(bumpshadow_bearing_diamond(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// Direction (xy, of length 1; 0 straight up, so that such a vertex leaves the direction to the others) and slope (z).
// Of length 1 while the square of the light's xy neither overflows nor vanishes, from 1e-15 to 1e19; beyond, shorter.
float3 bumpshadow_vertex_direction(float3 light, float most) {
    float inverse = rsqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return float3(light.x * inverse, light.y * inverse, bumpshadow_vertex_slope(light, most));
}

// The same with the sine (z), which needs no cut.
float3 bumpshadow_vertex_direction_sine(float3 light) {
    float inverse = rsqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return float3(light.x * inverse, light.y * inverse, bumpshadow_sine(light));
}

// Bearings of a triangle's vertices moved by whole turns to within half a turn of the first, as Direct3D's wrap mode
// did: 0.1, 0.2, 0.9 becomes 0.1, 0.2, -0.1. For geometry and mesh shaders, and for lights that are fixed in a mesh.
float3 bumpshadow_unwrap_bearings(float3 bearings) {
    return float3(bearings.x, bearings.y - floor(bearings.y - bearings.x + 0.5),
                bearings.z - floor(bearings.z - bearings.x + 0.5));
}

// True where the light stands above the triangle: its unwrapped bearings go round, and no bearings that are
// interpolated linearly can be right.
bool bumpshadow_bearings_go_round(float3 unwrapped) { return abs(unwrapped.y - unwrapped.z) > 0.5; }

// Without neighbors: interpolate a bearing twice, once with its seam at 0 and once at half a turn. A triangle that
// spans less than half a turn crosses one of the two at most; there that one changes faster. Source: Tarini,
// Cylindrical and Toroidal Parameterizations Without Vertex Seams, 2012.
float2 bumpshadow_bearing_pair(float bearing) {
    return float2(frac(bearing), frac(bearing + 0.5) - 0.5);
}

// change: fwidth of the pair.
float bumpshadow_pick_bearing(float2 pair, float2 change) {
    return change.y < change.x ? pair.y : pair.x;
}

// ---- short names, as the switches choose ----

float bumpshadow_bearing(float2 v) {
#if BUMPSHADOW_BEARING == 0
    return bumpshadow_bearing_exact(v);
#elif BUMPSHADOW_BEARING == 1
    return bumpshadow_bearing_quintic(v);
#elif BUMPSHADOW_BEARING == 2
    return bumpshadow_bearing_cubic(v);
#elif BUMPSHADOW_BEARING == 3
    return bumpshadow_bearing_octant(v);
#else
    return bumpshadow_bearing_diamond(v);
#endif
}

// Elevation of a light in the quantity that is stored, not scaled.
float bumpshadow_level(float3 light) {
#if BUMPSHADOW_QUANTITY == 0
    return bumpshadow_slope(light);
#elif BUMPSHADOW_QUANTITY == 1
    return bumpshadow_sine(light);
#else
    return bumpshadow_angle(light);
#endif
}

// Bearing and elevation of a light a vertex at a time. The elevation is cut at `most`, since a vertex that the light
// stands above would outweigh all others: max_slope for slopes, 1 for sines.
float2 bumpshadow_vertex_bearing(float3 light, float most) {
    return float2(bumpshadow_bearing(light.xy), clamp(bumpshadow_level(light), -most, most));
}

// k does not matter for a hard edge.
float bumpshadow_shadow(float light, float horizon, float k) {
#if BUMPSHADOW_EDGE == 0
    return bumpshadow_shadow_hard(light, horizon);
#elif BUMPSHADOW_BELOW == 0
    return bumpshadow_shadow_soft_above(light, horizon, k, BUMPSHADOW_EDGE == 1 ? 1.0 : 0.5);
#else
    return bumpshadow_shadow_soft(light, horizon, k, BUMPSHADOW_EDGE == 1 ? 1.0 : 0.5);
#endif
}

#if BUMPSHADOW_SAMPLE == 1

// ---- horizons from textures: the stored value, over what stands for 1 ----

// offset: 0.5 / N - phase. Level 0 of the volume, at any distance.
float bumpshadow_sample_volume(Texture3D map, SamplerState how, float2 uv, float3 light, float offset) {
    return map.SampleLevel(how, float3(uv, bumpshadow_volume_coordinate(bumpshadow_bearing(light.xy), offset)), 0.0).r;
}

float bumpshadow_sample_slices(Texture2DArray map, SamplerState how, float2 uv, float3 light, float phase, float slices) {
    float3 at = bumpshadow_tangent_layers(bumpshadow_bearing(light.xy), phase, slices);
    return bumpshadow_tangent_horizon(map.Sample(how, float3(uv, at.x)).r, map.Sample(how, float3(uv, at.y)).r, at.z);
}

// Over an arc of bearings. start, scale, offset: those of arc_coordinate_of; the volume is clamped along its third
// coordinate.
float bumpshadow_sample_arc(Texture3D map, SamplerState how, float2 uv, float3 light, float start, float scale, float offset) {
    float w = bumpshadow_arc_coordinate(bumpshadow_bearing(light.xy), start, scale, offset);
    return map.SampleLevel(how, float3(uv, w), 0.0).r;
}

float bumpshadow_sample_arc_slices(Texture2DArray map, SamplerState how, float2 uv, float3 light, float start, float scale, float offset,
                                   float slices) {
    float3 at = bumpshadow_arc_layers(bumpshadow_bearing(light.xy), start, scale, offset, slices);
    return bumpshadow_tangent_horizon(map.Sample(how, float3(uv, at.x)).r, map.Sample(how, float3(uv, at.y)).r, at.z);
}

float bumpshadow_sample_grouped(Texture2DArray map, SamplerState how, float2 uv, float3 light, float phase, float slices) {
    float position = bumpshadow_slice_position(bumpshadow_bearing(light.xy), phase, slices);
    float3 at = bumpshadow_grouped_layers(position, slices * 0.25);
    return bumpshadow_grouped_horizon(map.Sample(how, float3(uv, at.x)), map.Sample(how, float3(uv, at.y)).r, at.z);
}

float bumpshadow_sample_overlapping(Texture2DArray map, SamplerState how, float2 uv, float3 light, float phase, float slices) {
    float2 at = bumpshadow_overlapping_layer(
        bumpshadow_slice_position(bumpshadow_bearing(light.xy), phase, slices));
    return bumpshadow_overlapping_horizon(map.Sample(how, float3(uv, at.x)), at.y);
}

float bumpshadow_sample_sine_layers(Texture2DArray map, SamplerState how, float2 uv, float3 light) {
    float first = bumpshadow_sine_first_layer(light.xy);
    return bumpshadow_sine_half(map.Sample(how, float3(uv, first)), map.Sample(how, float3(uv, 1.0 - first)).r, light.xy);
}

float bumpshadow_sample_two_maps(Texture2D first, Texture2D second, SamplerState how, float2 uv, float3 light) {
    return bumpshadow_sine_layers(first.Sample(how, uv), second.Sample(how, uv), light.xy);
}

// Factors from a cube, biased.
float bumpshadow_sample_with_cube(Texture2DArray map, TextureCube cube, SamplerState how, float2 uv, float3 light) {
    return bumpshadow_sine_layers_biased_cube(map.Sample(how, float3(uv, 0.0)), map.Sample(how, float3(uv, 1.0)),
                                              cube.Sample(how, light));
}

// scale, offset: of the four coefficients; constant: scale and offset of the one in the second texture.
float bumpshadow_sample_fourier_5(Texture2D map, Texture2D constant_map, SamplerState how, float2 uv, float3 light, float4 scale, float4 offset,
                                  float2 constant) {
    return bumpshadow_fourier_5(bumpshadow_fourier_texel(map.Sample(how, uv), scale, offset),
                                constant_map.Sample(how, uv).r * constant.x + constant.y,
                                bumpshadow_fourier_direction(light.xy));
}

// Diffuse brightness, shadow included; a light below the surface gives some on slopes that face it.
float bumpshadow_sample_ssbump(Texture2D map, SamplerState how, float2 uv, float3 light) {
    return bumpshadow_ssbump_light(map.Sample(how, uv).rgb, bumpshadow_ssbump_weights(light));
}

#endif
