#pragma once

// Generated from the .h files beside it by the target `shaders`: change those.
// clang-format off

#include <array>
#include <cstdint>
#include <string_view>

#include <bumpshadow/config.hpp>

namespace bumpshadow::shader_text {

// A function or structure; `needs` has a bit for each snippet that it uses, through others too, and its own.
struct snippet {
    std::string_view name, comment, glsl, hlsl;
    std::array<std::uint64_t, 4> needs;
};

// Each stands after those that it needs.
inline constexpr snippet snippets[] = {
    {"bumpshadow_square",
R"~(// Square of a length, never 0. Its inverse root is shared by all that is computed from the same vector.
)~",
R"~(float bumpshadow_square(vec2 v) { return v.x * v.x + (v.y * v.y + 1e-30); }
)~",
R"~(float bumpshadow_square(float2 v) { return v.x * v.x + (v.y * v.y + 1e-30); }
)~",
     {0x1u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_steep",
R"~(// Nearer to the y axis than to the x axis. Two comparisons, since those of the quadrant are needed anyway.
)~",
R"~(bool bumpshadow_steep(vec2 v) { return (v.x >= v.y) != (v.x >= -v.y); }
)~",
R"~(bool bumpshadow_steep(float2 v) { return (v.x >= v.y) != (v.x >= -v.y); }
)~",
     {0x2u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_across",
R"~(// Component of v across the nearest axis.
)~",
R"~(float bumpshadow_across(vec2 v) { return bumpshadow_steep(v) ? -v.x : v.y; }
)~",
R"~(float bumpshadow_across(float2 v) { return bumpshadow_steep(v) ? -v.x : v.y; }
)~",
     {0x6u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_unfold",
R"~(// Bearing of v, given that of the direction whose component across is the same and whose other one is |x| on the x
// axis.
)~",
R"~(float bumpshadow_unfold(vec2 v, float turns) {
    float past = turns - 0.25;
    return (v.x >= -v.y ? past : -past) + (bumpshadow_steep(v) ? 0.5 : 0.25);
}
)~",
R"~(float bumpshadow_unfold(float2 v, float turns) {
    float past = turns - 0.25;
    return (v.x >= -v.y ? past : -past) + (bumpshadow_steep(v) ? 0.5 : 0.25);
}
)~",
     {0xau, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_exact",
R"~(// The true angle, by the minimax polynomial of arcsin: half of what atan costs, which reduces a range that is reduced
// already.
)~",
R"~(float bumpshadow_bearing_exact(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    float square = sine * sine;
    float high = 0.0116049032 + square * (square * 0.0181935507 - 0.00773401597);
    return bumpshadow_unfold(
        v, sine * (0.159153938 + square * (0.026577197 + square * (0.0111934934 + square * high))));
}
)~",
R"~(float bumpshadow_bearing_exact(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    float square = sine * sine;
    float high = 0.0116049032 + square * (square * 0.0181935507 - 0.00773401597);
    return bumpshadow_unfold(
        v, sine * (0.159153938 + square * (0.026577197 + square * (0.0111934934 + square * high))));
}
)~",
     {0x1fu, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_quintic",
R"~(// s (c0 + c1 s^2 + c2 s^4), s being the sine of the angle from the nearest axis.
)~",
R"~(float bumpshadow_bearing_quintic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    float square = sine * sine;
    return bumpshadow_unfold(v, sine * (0.15944586 + square * (0.022631394 + square * 0.024060546)));
}
)~",
R"~(float bumpshadow_bearing_quintic(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    float square = sine * sine;
    return bumpshadow_unfold(v, sine * (0.15944586 + square * (0.022631394 + square * 0.024060546)));
}
)~",
     {0x2fu, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_cubic",
R"~(// s (c0 + c1 s^2).
)~",
R"~(float bumpshadow_bearing_cubic(vec2 v) {
    float sine = bumpshadow_across(v) * inversesqrt(bumpshadow_square(v));
    return bumpshadow_unfold(v, sine * (0.15703793 + 0.039477522 * sine * sine));
}
)~",
R"~(float bumpshadow_bearing_cubic(float2 v) {
    float sine = bumpshadow_across(v) * rsqrt(bumpshadow_square(v));
    return bumpshadow_unfold(v, sine * (0.15703793 + 0.039477522 * sine * sine));
}
)~",
     {0x4fu, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_octant",
R"~(// Linear in s. Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, section 4.1.
)~",
R"~(float bumpshadow_bearing_octant(vec2 v) {
    return bumpshadow_unfold(v, 0.1767767 * bumpshadow_across(v) * inversesqrt(bumpshadow_square(v)));
}
)~",
R"~(float bumpshadow_bearing_octant(float2 v) {
    return bumpshadow_unfold(v, 0.1767767 * bumpshadow_across(v) * rsqrt(bumpshadow_square(v)));
}
)~",
     {0x8fu, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_diamond",
R"~(// The perimeter of |x| + |y| = 1. No square root.
)~",
R"~(float bumpshadow_bearing_diamond(vec2 v) {
    return bumpshadow_unfold(v, 0.25 * bumpshadow_across(v) / max(abs(v.x) + abs(v.y), 1e-30));
}
)~",
R"~(float bumpshadow_bearing_diamond(float2 v) {
    return bumpshadow_unfold(v, 0.25 * bumpshadow_across(v) / max(abs(v.x) + abs(v.y), 1e-30));
}
)~",
     {0x10eu, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_emboss_shift",
R"~(// What is added to the texture coordinates of the inverse height map, so that sides which face the light are
// brightened. light: towards the light in tangent space, of any length whose square neither overflows nor vanishes, 1e-15
// to 1e19 (beyond, the shift is too small, down to 0); from a vertex for a light that is near, and then interpolated.
// amount: the shift of a light at the horizon, in texture coordinates (texels over extent). 0 for the zero vector.
)~",
R"~(vec2 bumpshadow_emboss_shift(vec3 light, vec2 amount) {
    float inverse = inversesqrt(max(dot(light, light), 1e-30));
    return vec2(light.x * inverse * amount.x, light.y * inverse * amount.y);
}
)~",
R"~(float2 bumpshadow_emboss_shift(float3 light, float2 amount) {
    float inverse = rsqrt(max(dot(light, light), 1e-30));
    return float2(light.x * inverse * amount.x, light.y * inverse * amount.y);
}
)~",
     {0x200u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_emboss_inverse",
R"~(// Inverse of a height, in place of a second texture.
)~",
R"~(float bumpshadow_emboss_inverse(float height) { return 0.50196078 - height; }
)~",
R"~(float bumpshadow_emboss_inverse(float height) { return 0.50196078 - height; }
)~",
     {0x400u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_emboss_relief",
R"~(// Height and shifted inverse added: 128/255 where the surface is flat, more where it faces the light.
)~",
R"~(float bumpshadow_emboss_relief(float height, float shifted_inverse) {
    return clamp(height + shifted_inverse, 0.0, 1.0);
}
)~",
R"~(float bumpshadow_emboss_relief(float height, float shifted_inverse) {
    return clamp(height + shifted_inverse, 0.0, 1.0);
}
)~",
     {0x800u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_emboss",
R"~(// The base texture times twice the relief, so that flat leaves it as it is, in light of a color.
)~",
R"~(vec3 bumpshadow_emboss(float relief, vec3 base, vec3 color) {
    return min(2.0 * relief * base, vec3(1.0, 1.0, 1.0)) * color;
}
)~",
R"~(float3 bumpshadow_emboss(float relief, float3 base, float3 color) {
    return min(2.0 * relief * base, float3(1.0, 1.0, 1.0)) * color;
}
)~",
     {0x1000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_eight",
R"~(// The eight factors, in [0, 1].
)~",
R"~(struct bumpshadow_eight {
    vec4 layer0;  // 0, 45, 90, 135 degrees
    vec4 layer1;  // 180, 225, 270, 315 degrees
};
)~",
R"~(struct bumpshadow_eight {
    float4 layer0;  // 0, 45, 90, 135 degrees
    float4 layer1;  // 180, 225, 270, 315 degrees
};
)~",
     {0x2000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_factors_published_cube",
R"~(// From a factor cube as published, sampled with the light's direction: positive for layer 0, negative for layer 1
// (equation 5.3). A factor of 0 is stored as 128 and adds 1/255, so that all but the two wanted horizons leak a little.
)~",
R"~(bumpshadow_eight bumpshadow_factors_published_cube(vec4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = clamp(texel * 2.0 - 1.0, 0.0, 1.0);
    factors.layer1 = clamp(texel * -2.0 + 1.0, 0.0, 1.0);
    return factors;
}
)~",
R"~(bumpshadow_eight bumpshadow_factors_published_cube(float4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = clamp(texel * 2.0 - 1.0, 0.0, 1.0);
    factors.layer1 = clamp(texel * -2.0 + 1.0, 0.0, 1.0);
    return factors;
}
)~",
     {0x6000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_layer0_biased_cube",
R"~(// Factors of layer 0 from a cube in which 128 of 255 stands for 0: at the same cost, and nothing leaks.
)~",
R"~(vec4 bumpshadow_layer0_biased_cube(vec4 texel) {
    return clamp(texel * 2.007874 - 1.007874, 0.0, 1.0);
}
)~",
R"~(float4 bumpshadow_layer0_biased_cube(float4 texel) {
    return clamp(texel * 2.007874 - 1.007874, 0.0, 1.0);
}
)~",
     {0x8000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_layer1_biased_cube",
R"~(// Factors of layer 1 from the same.
)~",
R"~(vec4 bumpshadow_layer1_biased_cube(vec4 texel) {
    return clamp(texel * -2.007874 + 1.007874, 0.0, 1.0);
}
)~",
R"~(float4 bumpshadow_layer1_biased_cube(float4 texel) {
    return clamp(texel * -2.007874 + 1.007874, 0.0, 1.0);
}
)~",
     {0x10000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_factors_biased_cube",
R"~(// Both.
)~",
R"~(bumpshadow_eight bumpshadow_factors_biased_cube(vec4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = bumpshadow_layer0_biased_cube(texel);
    factors.layer1 = bumpshadow_layer1_biased_cube(texel);
    return factors;
}
)~",
R"~(bumpshadow_eight bumpshadow_factors_biased_cube(float4 texel) {
    bumpshadow_eight factors;
    factors.layer0 = bumpshadow_layer0_biased_cube(texel);
    factors.layer1 = bumpshadow_layer1_biased_cube(texel);
    return factors;
}
)~",
     {0x3a000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_turn_to_diagonal",
R"~(// How far a direction has turned from the nearest axis to the diagonal, 0 to 1. sine: of its angle to the axis, that is
// the smaller component of the unit vector, 0 to 0.7071. Within 0.35 degrees of the true angle, exact at both ends;
// goes on growing beyond.
)~",
R"~(float bumpshadow_turn_to_diagonal(float sine) { return sine * (1.1769721 + 0.3355101 * sine); }
)~",
R"~(float bumpshadow_turn_to_diagonal(float sine) { return sine * (1.1769721 + 0.3355101 * sine); }
)~",
     {0x40000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_factors",
R"~(// Without a cube. light: to the light, in the surface, of any length whose square neither overflows nor vanishes; (0,
// 0) counts as +x, as for bearings.
)~",
R"~(bumpshadow_eight bumpshadow_factors(vec2 light) {
    float inverse = inversesqrt(bumpshadow_square(light));
    float x = (light.x + 1e-15) * inverse;
    float y = light.y * inverse;
    // The turn away from the other axis, with the component's sign.
    x = x * (1.1769721 + 0.3355101 * abs(x));
    y = y * (1.1769721 + 0.3355101 * abs(y));
    float along_x = 1.0 - abs(y);
    float along_y = 1.0 - abs(x);
    bumpshadow_eight factors;
    factors.layer0 = clamp(vec4(min(along_x, x), min(x, y), min(along_y, y), min(-x, y)), 0.0, 1.0);
    factors.layer1 = clamp(vec4(min(along_x, -x), min(-x, -y), min(along_y, -y), min(x, -y)), 0.0, 1.0);
    return factors;
}
)~",
R"~(bumpshadow_eight bumpshadow_factors(float2 light) {
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
)~",
     {0x82001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_factors_of_bearing",
R"~(// The same from a bearing, in turns, any number.
)~",
R"~(bumpshadow_eight bumpshadow_factors_of_bearing(float bearing) {
    // Turns to each direction of layer 0; the ones of layer 1 lie opposite.
    vec4 away = abs(fract(vec4(bearing, bearing, bearing, bearing) + vec4(0.5, 0.375, 0.25, 0.125)) - 0.5);
    bumpshadow_eight factors;
    factors.layer0 = clamp(1.0 - 8.0 * away, 0.0, 1.0);
    factors.layer1 = clamp(8.0 * away - 3.0, 0.0, 1.0);
    return factors;
}
)~",
R"~(bumpshadow_eight bumpshadow_factors_of_bearing(float bearing) {
    // Turns to each direction of layer 0; the ones of layer 1 lie opposite.
    float4 away = abs(frac(float4(bearing, bearing, bearing, bearing) + float4(0.5, 0.375, 0.25, 0.125)) - 0.5);
    bumpshadow_eight factors;
    factors.layer0 = clamp(1.0 - 8.0 * away, 0.0, 1.0);
    factors.layer1 = clamp(8.0 * away - 3.0, 0.0, 1.0);
    return factors;
}
)~",
     {0x102000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_direction",
R"~(// (sin t, cos t) of a light's direction in the surface, of any length whose square neither overflows nor vanishes; (0,
// 0) gives (0, 0), which leaves the constant alone.
)~",
R"~(vec2 bumpshadow_fourier_direction(vec2 light) {
    return light * inversesqrt(bumpshadow_square(light));
}
)~",
R"~(float2 bumpshadow_fourier_direction(float2 light) {
    return light * rsqrt(bumpshadow_square(light));
}
)~",
     {0x200001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_texel",
R"~(// Coefficients from a texel.
)~",
R"~(vec4 bumpshadow_fourier_texel(vec4 texel, vec4 scale, vec4 offset) {
    return texel * scale + offset;
}
)~",
R"~(float4 bumpshadow_fourier_texel(float4 texel, float4 scale, float4 offset) {
    return texel * scale + offset;
}
)~",
     {0x400000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_root_texel",
R"~(// The same where signed square roots are stored.
)~",
R"~(vec4 bumpshadow_fourier_root_texel(vec4 texel, vec4 scale, vec4 offset) {
    vec4 root = texel * scale + offset;
    return root * abs(root);
}
)~",
R"~(float4 bumpshadow_fourier_root_texel(float4 texel, float4 scale, float4 offset) {
    float4 root = texel * scale + offset;
    return root * abs(root);
}
)~",
     {0x800000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_root_constant",
R"~(// For a texture of one channel.
)~",
R"~(float bumpshadow_fourier_root_constant(float texel, float scale, float offset) {
    float root = texel * scale + offset;
    return root * abs(root);
}
)~",
R"~(float bumpshadow_fourier_root_constant(float texel, float scale, float offset) {
    float root = texel * scale + offset;
    return root * abs(root);
}
)~",
     {0x1000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_turn",
R"~(// The series is summed from its end: `higher` turned by t, and the next lower pair added.
)~",
R"~(vec2 bumpshadow_fourier_turn(vec2 higher, vec2 lower, vec2 direction) {
    return vec2(lower.x + higher.x * direction.y - higher.y * direction.x,
                lower.y + higher.y * direction.y + higher.x * direction.x);
}
)~",
R"~(float2 bumpshadow_fourier_turn(float2 higher, float2 lower, float2 direction) {
    return float2(lower.x + higher.x * direction.y - higher.y * direction.x,
                lower.y + higher.y * direction.y + higher.x * direction.x);
}
)~",
     {0x2000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_3",
R"~(// Horizon towards a light, 3 coefficients. texel: decoded; direction: from bumpshadow_fourier_direction.
)~",
R"~(float bumpshadow_fourier_3(vec3 texel, vec2 direction) {
    return texel.z + texel.x * direction.x + texel.y * direction.y;
}
)~",
R"~(float bumpshadow_fourier_3(float3 texel, float2 direction) {
    return texel.z + texel.x * direction.x + texel.y * direction.y;
}
)~",
     {0x4000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_5",
R"~(// 5 coefficients, the constant from the second texture.
)~",
R"~(float bumpshadow_fourier_5(vec4 texel, float constant, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(texel.z, texel.w), vec2(texel.x, texel.y), direction);
    return constant + pair.x * direction.x + pair.y * direction.y;
}
)~",
R"~(float bumpshadow_fourier_5(float4 texel, float constant, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(texel.z, texel.w), float2(texel.x, texel.y), direction);
    return constant + pair.x * direction.x + pair.y * direction.y;
}
)~",
     {0xa000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_7",
R"~(// 7 coefficients. more: those of the second texture.
)~",
R"~(float bumpshadow_fourier_7(vec4 texel, vec3 more, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(more.x, more.y), vec2(texel.z, texel.w), direction);
    return bumpshadow_fourier_5(vec4(texel.x, texel.y, pair.x, pair.y), more.z, direction);
}
)~",
R"~(float bumpshadow_fourier_7(float4 texel, float3 more, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(more.x, more.y), float2(texel.z, texel.w), direction);
    return bumpshadow_fourier_5(float4(texel.x, texel.y, pair.x, pair.y), more.z, direction);
}
)~",
     {0x1a000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_fourier_9",
R"~(// 9 coefficients, the constant from the third texture.
)~",
R"~(float bumpshadow_fourier_9(vec4 texel, vec4 more, float constant, vec2 direction) {
    vec2 pair = bumpshadow_fourier_turn(vec2(more.z, more.w), vec2(more.x, more.y), direction);
    return bumpshadow_fourier_7(texel, vec3(pair.x, pair.y, constant), direction);
}
)~",
R"~(float bumpshadow_fourier_9(float4 texel, float4 more, float constant, float2 direction) {
    float2 pair = bumpshadow_fourier_turn(float2(more.z, more.w), float2(more.x, more.y), direction);
    return bumpshadow_fourier_7(texel, float3(pair.x, pair.y, constant), direction);
}
)~",
     {0x3a000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_slope",
R"~(// Tangent of the elevation, at most 1e15 light.z in size.
)~",
R"~(float bumpshadow_slope(vec3 light) {
    return light.z * inversesqrt(bumpshadow_square(vec2(light.x, light.y)));
}
)~",
R"~(float bumpshadow_slope(float3 light) {
    return light.z * rsqrt(bumpshadow_square(float2(light.x, light.y)));
}
)~",
     {0x40000001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine",
R"~(// Sine of the elevation.
)~",
R"~(float bumpshadow_sine(vec3 light) {
    return light.z * inversesqrt(light.z * light.z + bumpshadow_square(vec2(light.x, light.y)));
}
)~",
R"~(float bumpshadow_sine(float3 light) {
    return light.z * rsqrt(light.z * light.z + bumpshadow_square(float2(light.x, light.y)));
}
)~",
     {0x80000001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_angle",
R"~(// Elevation in radians.
)~",
R"~(float bumpshadow_angle(vec3 light) { return atan(bumpshadow_slope(light)); }
)~",
R"~(float bumpshadow_angle(float3 light) { return atan(bumpshadow_slope(light)); }
)~",
     {0x140000001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_normal",
R"~(// stored: the three channels, in [0, 1]; (1, 1, 1) / 2, which has no direction, gives straight up.
)~",
R"~(vec3 bumpshadow_normal(vec3 stored, float y) {
    vec3 normal = vec3(2.0 * stored.x - 1.0, y * (2.0 * stored.y - 1.0), 2.0 * stored.z - 1.0);
    float square = dot(normal, normal);
    return square > 1e-4 ? normal * inversesqrt(square) : vec3(0.0, 0.0, 1.0);
}
)~",
R"~(float3 bumpshadow_normal(float3 stored, float y) {
    float3 normal = float3(2.0 * stored.x - 1.0, y * (2.0 * stored.y - 1.0), 2.0 * stored.z - 1.0);
    float square = dot(normal, normal);
    return square > 1e-4 ? normal * rsqrt(square) : float3(0.0, 0.0, 1.0);
}
)~",
     {0x200000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_normal_of_derivatives",
R"~(// Partial-derivative form: stored are dz/dx and dz/dy of the surface, over max_slope, from [-1, 1] to [0, 1]. Needs two
// channels, and derivatives of several maps may be added. Steeper slopes are not stored. max_slope: up to 1e18, whose
// square does not overflow.
)~",
R"~(vec3 bumpshadow_normal_of_derivatives(vec2 stored, float max_slope, float y) {
    vec3 normal = vec3(max_slope * (1.0 - 2.0 * stored.x), y * max_slope * (1.0 - 2.0 * stored.y), 1.0);
    return normal * inversesqrt(dot(normal, normal));
}
)~",
R"~(float3 bumpshadow_normal_of_derivatives(float2 stored, float max_slope, float y) {
    float3 normal = float3(max_slope * (1.0 - 2.0 * stored.x), y * max_slope * (1.0 - 2.0 * stored.y), 1.0);
    return normal * rsqrt(dot(normal, normal));
}
)~",
     {0x400000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_shadow_hard",
R"~(// No soft edge: the limit of large k.
)~",
R"~(float bumpshadow_shadow_hard(float light, float horizon) {
    // In this order, max takes the 0 where the other is not a number; here and below.
    return light >= max(0.0, horizon) ? 1.0 : 0.0;
}
)~",
R"~(float bumpshadow_shadow_hard(float light, float horizon) {
    // In this order, max takes the 0 where the other is not a number; here and below.
    return light >= max(0.0, horizon) ? 1.0 : 0.0;
}
)~",
     {0x800000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_shadow_soft_above",
R"~(// clamp(k (light - horizon) + c, 0, 1), for a light that is never below the surface or does not shine there anyway.
)~",
R"~(float bumpshadow_shadow_soft_above(float light, float horizon, float k, float c) {
    // clamp may keep what is not a number.
    return min(max(0.0, min(k, 1e30) * (light - horizon) + c), 1.0);
}
)~",
R"~(float bumpshadow_shadow_soft_above(float light, float horizon, float k, float c) {
    // clamp may keep what is not a number.
    return min(max(0.0, min(k, 1e30) * (light - horizon) + c), 1.0);
}
)~",
     {0x1000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_shadow_soft",
R"~(// The same, and 0 for a light below the surface. c = 1: the edge lies inside the shadow (Lengyel 2016, equation 5.4); c
// = 0.5: it is centered. k from 0 to infinity.
)~",
R"~(float bumpshadow_shadow_soft(float light, float horizon, float k, float c) {
    return light >= 0.0 ? bumpshadow_shadow_soft_above(light, horizon, k, c) : 0.0;
}
)~",
R"~(float bumpshadow_shadow_soft(float light, float horizon, float k, float c) {
    return light >= 0.0 ? bumpshadow_shadow_soft_above(light, horizon, k, c) : 0.0;
}
)~",
     {0x3000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_shadow_fade",
R"~(// Shadows that end with distance, all three in one unit: the factor up to `start`, 1 from `end` on.
)~",
R"~(float bumpshadow_shadow_fade(float factor, float distance, float start, float end) {
    return mix(factor, 1.0, min(max(0.0, (distance - start) / max(end - start, 1e-30)), 1.0));
}
)~",
R"~(float bumpshadow_shadow_fade(float factor, float distance, float start, float end) {
    return lerp(factor, 1.0, min(max(0.0, (distance - start) / max(end - start, 1e-30)), 1.0));
}
)~",
     {0x4000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_pixel_place",
R"~(// Place i of taps x taps of a pixel that covers many texels, row by row: from its middle, in sides of the pixel. The mean
// of their factors is the share of the pixel that is lit. Both are whole numbers, taps 1 to 1024, i below taps * taps.
)~",
R"~(vec2 bumpshadow_pixel_place(float i, float taps) {
    float row = floor((i + 0.5) / taps);
    return vec2((i - row * taps + 0.5) / taps - 0.5, (row + 0.5) / taps - 0.5);
}
)~",
R"~(float2 bumpshadow_pixel_place(float i, float taps) {
    float row = floor((i + 0.5) / taps);
    return float2((i - row * taps + 0.5) / taps - 0.5, (row + 0.5) / taps - 0.5);
}
)~",
     {0x8000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine_layers_factors",
R"~(// Equation 5.3. One set of factors serves every texture that is lit from the same direction.
)~",
R"~(float bumpshadow_sine_layers_factors(vec4 layer0, vec4 layer1, bumpshadow_eight factors) {
    return dot(layer0, factors.layer0) + dot(layer1, factors.layer1);
}
)~",
R"~(float bumpshadow_sine_layers_factors(float4 layer0, float4 layer1, bumpshadow_eight factors) {
    return dot(layer0, factors.layer0) + dot(layer1, factors.layer1);
}
)~",
     {0x10000002000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine_layers_biased_cube",
R"~(// The same straight from a texel of a biased cube, without the structure.
)~",
R"~(float bumpshadow_sine_layers_biased_cube(vec4 layer0, vec4 layer1, vec4 texel) {
    return dot(layer0, bumpshadow_layer0_biased_cube(texel)) + dot(layer1, bumpshadow_layer1_biased_cube(texel));
}
)~",
R"~(float bumpshadow_sine_layers_biased_cube(float4 layer0, float4 layer1, float4 texel) {
    return dot(layer0, bumpshadow_layer0_biased_cube(texel)) + dot(layer1, bumpshadow_layer1_biased_cube(texel));
}
)~",
     {0x20000018000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine_layers",
R"~(// The same as with bumpshadow_factors(light), by picking the two horizons that have a part: fewer instructions.
)~",
R"~(float bumpshadow_sine_layers(vec4 layer0, vec4 layer1, vec2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * inversesqrt(bumpshadow_square(light)));
    float along_x = light.x >= 0.0 ? layer0.x : layer1.x;
    float along_y = light.y >= 0.0 ? layer0.z : layer1.z;
    float diagonal_up = light.x >= 0.0 ? layer0.y : layer0.w;
    float diagonal_down = light.x >= 0.0 ? layer1.w : layer1.y;
    float axis = y > x ? along_y : along_x;
    float diagonal = light.y >= 0.0 ? diagonal_up : diagonal_down;
    return axis + part * (diagonal - axis);
}
)~",
R"~(float bumpshadow_sine_layers(float4 layer0, float4 layer1, float2 light) {
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
)~",
     {0x40000040001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine_first_layer",
R"~(// An array of both layers: the one to sample whole, and of the other one, 1 - this, only the first channel.
)~",
R"~(float bumpshadow_sine_first_layer(vec2 light) { return light.y >= 0.0 ? 0.0 : 1.0; }
)~",
R"~(float bumpshadow_sine_first_layer(float2 light) { return light.y >= 0.0 ? 0.0 : 1.0; }
)~",
     {0x80000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_sine_half",
R"~(// What bumpshadow_sine_layers gives, from these two; fewer instructions still.
)~",
R"~(float bumpshadow_sine_half(vec4 first, float other, vec2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * inversesqrt(bumpshadow_square(light)));
    bool ahead = (light.x >= 0.0) == (light.y >= 0.0);
    float level = ahead ? first.x : other;
    float axis = y > x ? first.z : level;
    float diagonal = ahead ? first.y : first.w;
    return axis + part * (diagonal - axis);
}
)~",
R"~(float bumpshadow_sine_half(float4 first, float other, float2 light) {
    float x = abs(light.x);
    float y = abs(light.y);
    float part = bumpshadow_turn_to_diagonal(min(x, y) * rsqrt(bumpshadow_square(light)));
    bool ahead = (light.x >= 0.0) == (light.y >= 0.0);
    float level = ahead ? first.x : other;
    float axis = y > x ? first.z : level;
    float diagonal = ahead ? first.y : first.w;
    return axis + part * (diagonal - axis);
}
)~",
     {0x100000040001u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_slice_position",
R"~(// Position of a bearing among the slices, in [0, N], N by rounding alone. phase and bearing may have any sign.
)~",
R"~(float bumpshadow_slice_position(float bearing, float phase, float slices) {
    return fract(bearing - phase) * slices;
}
)~",
R"~(float bumpshadow_slice_position(float bearing, float phase, float slices) {
    return frac(bearing - phase) * slices;
}
)~",
     {0x200000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_grouped_layers",
R"~(// Four slices a layer, two fetches; layers = N / 4. x, y: layers; z: position from the first channel of layer x on, in
// [0, 4].
)~",
R"~(vec3 bumpshadow_grouped_layers(float position, float layers) {
    // A little less than a quarter, so that N finds the last layer; a place of 4 is as good as 0 in the next one.
    float layer = floor(position * 0.24999996);
    float next = layer + 1.0;
    return vec3(layer, next < layers ? next : 0.0, position - 4.0 * layer);
}
)~",
R"~(float3 bumpshadow_grouped_layers(float position, float layers) {
    // A little less than a quarter, so that N finds the last layer; a place of 4 is as good as 0 in the next one.
    float layer = floor(position * 0.24999996);
    float next = layer + 1.0;
    return float3(layer, next < layers ? next : 0.0, position - 4.0 * layer);
}
)~",
     {0x400000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_grouped_horizon",
R"~(// Horizon from layer x, and the first channel of layer y.
)~",
R"~(float bumpshadow_grouped_horizon(vec4 values, float next_value, float place) {
    // Of the two neighbors one is even, the other odd.
    float past = place - 2.0;
    float even = abs(past) < 1.0 ? values.z : (past < 0.0 ? values.x : next_value);
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}
)~",
R"~(float bumpshadow_grouped_horizon(float4 values, float next_value, float place) {
    // Of the two neighbors one is even, the other odd.
    float past = place - 2.0;
    float even = abs(past) < 1.0 ? values.z : (past < 0.0 ? values.x : next_value);
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}
)~",
     {0x800000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_overlapping_layer",
R"~(// Layers that overlap by one slice, one fetch. x: layer; y: position from its first channel on, in [0, 3].
)~",
R"~(vec2 bumpshadow_overlapping_layer(float position) {
    // A little less than a third, so that N finds the last layer.
    float layer = floor(position * 0.33333328);
    return vec2(layer, position - 3.0 * layer);
}
)~",
R"~(float2 bumpshadow_overlapping_layer(float position) {
    // A little less than a third, so that N finds the last layer.
    float layer = floor(position * 0.33333328);
    return float2(layer, position - 3.0 * layer);
}
)~",
     {0x1000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_overlapping_horizon",
R"~(// Horizon from the layer.
)~",
R"~(float bumpshadow_overlapping_horizon(vec4 values, float place) {
    float past = place - 2.0;
    float even = past < -1.0 ? values.x : values.z;
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}
)~",
R"~(float bumpshadow_overlapping_horizon(float4 values, float place) {
    float past = place - 2.0;
    float even = past < -1.0 ? values.x : values.z;
    float odd = past < 0.0 ? values.y : values.w;
    return odd + abs(abs(past) - 1.0) * (even - odd);
}
)~",
     {0x2000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_other_hand",
R"~(// Left-handed (y-down) masks to right-handed (y-up) ones and back: green and blue swapped, which is the same as
// swapping the last two vectors of the basis. Doing both undoes it.
)~",
R"~(vec3 bumpshadow_ssbump_other_hand(vec3 masks) { return vec3(masks.x, masks.z, masks.y); }
)~",
R"~(float3 bumpshadow_ssbump_other_hand(float3 masks) { return float3(masks.x, masks.z, masks.y); }
)~",
     {0x4000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_sum",
R"~(// Sum of the basis vectors, each times its mask; not unit length.
)~",
R"~(vec3 bumpshadow_ssbump_sum(vec3 masks) {
    return vec3(0.81649658 * masks.x - 0.40824829 * (masks.y + masks.z), 0.70710678 * (masks.y - masks.z),
                0.57735027 * (masks.x + masks.y + masks.z));
}
)~",
R"~(float3 bumpshadow_ssbump_sum(float3 masks) {
    return float3(0.81649658 * masks.x - 0.40824829 * (masks.y + masks.z), 0.70710678 * (masks.y - masks.z),
                0.57735027 * (masks.x + masks.y + masks.z));
}
)~",
     {0x8000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_project",
R"~(// Three dots with the basis, the inverse of the sum: the masks of a unit normal as long as none is negative, which they
// are not up to a tilt of 35.26 degrees, asin(1/sqrt(3)); beyond, some bearings make one negative.
)~",
R"~(vec3 bumpshadow_ssbump_project(vec3 v) {
    float up = 0.57735027 * v.z;
    float side = 0.70710678 * v.y;
    float back = up - 0.40824829 * v.x;
    return vec3(0.81649658 * v.x + up, back + side, back - side);
}
)~",
R"~(float3 bumpshadow_ssbump_project(float3 v) {
    float up = 0.57735027 * v.z;
    float side = 0.70710678 * v.y;
    float back = up - 0.40824829 * v.x;
    return float3(0.81649658 * v.x + up, back + side, back - side);
}
)~",
     {0x10000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_normal",
R"~(// Unit normal: of the surface for masks without occlusion, else bent towards where it is open. Black, and whatever is
// shorter than 1e-4, gives straight up.
)~",
R"~(vec3 bumpshadow_ssbump_normal(vec3 masks) {
    vec3 sum = bumpshadow_ssbump_sum(masks);
    float square = dot(sum, sum);
    return square > 1e-8 ? sum * inversesqrt(square) : vec3(0.0, 0.0, 1.0);
}
)~",
R"~(float3 bumpshadow_ssbump_normal(float3 masks) {
    float3 sum = bumpshadow_ssbump_sum(masks);
    float square = dot(sum, sum);
    return square > 1e-8 ? sum * rsqrt(square) : float3(0.0, 0.0, 1.0);
}
)~",
     {0x28000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_world_red",
R"~(// The basis concatenated with the way from tangent space to the world, whose axes are unit vectors in the world: once a
// vertex or a pixel. Any of the sums above then lands in the world. This is the vector of the red mask.
)~",
R"~(vec3 bumpshadow_ssbump_world_red(vec3 tangent, vec3 normal) {
    return 0.81649658 * tangent + 0.57735027 * normal;
}
)~",
R"~(float3 bumpshadow_ssbump_world_red(float3 tangent, float3 normal) {
    return 0.81649658 * tangent + 0.57735027 * normal;
}
)~",
     {0x40000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_world_green",
R"~(// The vector of the green mask in the world.
)~",
R"~(vec3 bumpshadow_ssbump_world_green(vec3 tangent, vec3 bitangent, vec3 normal) {
    return 0.70710678 * bitangent - 0.40824829 * tangent + 0.57735027 * normal;
}
)~",
R"~(float3 bumpshadow_ssbump_world_green(float3 tangent, float3 bitangent, float3 normal) {
    return 0.70710678 * bitangent - 0.40824829 * tangent + 0.57735027 * normal;
}
)~",
     {0x80000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_world_blue",
R"~(// The vector of the blue mask in the world.
)~",
R"~(vec3 bumpshadow_ssbump_world_blue(vec3 tangent, vec3 bitangent, vec3 normal) {
    return 0.57735027 * normal - 0.40824829 * tangent - 0.70710678 * bitangent;
}
)~",
R"~(float3 bumpshadow_ssbump_world_blue(float3 tangent, float3 bitangent, float3 normal) {
    return 0.57735027 * normal - 0.40824829 * tangent - 0.70710678 * bitangent;
}
)~",
     {0x100000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_world_normal",
R"~(// Straight to a unit normal in the world; red, green, blue: from the three functions above. Black gives the zero
// vector, and masks shorter than 1e-10 a shorter one.
)~",
R"~(vec3 bumpshadow_ssbump_world_normal(vec3 masks, vec3 red, vec3 green, vec3 blue) {
    vec3 sum = masks.x * red + masks.y * green + masks.z * blue;
    return sum * inversesqrt(max(dot(sum, sum), 1e-20));
}
)~",
R"~(float3 bumpshadow_ssbump_world_normal(float3 masks, float3 red, float3 green, float3 blue) {
    float3 sum = masks.x * red + masks.y * green + masks.z * blue;
    return sum * rsqrt(max(dot(sum, sum), 1e-20));
}
)~",
     {0x200000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_reflection",
R"~(// Where a ray from the eye goes on to: `eye` points to the eye, `normal` is unit length, both in the same space.
)~",
R"~(vec3 bumpshadow_reflection(vec3 eye, vec3 normal) { return 2.0 * dot(normal, eye) * normal - eye; }
)~",
R"~(float3 bumpshadow_reflection(float3 eye, float3 normal) { return 2.0 * dot(normal, eye) * normal - eye; }
)~",
     {0x400000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_detail",
R"~(// A gray detail map multiplied in: the recovered normal stays. detail: 1 changes nothing.
)~",
R"~(vec3 bumpshadow_ssbump_detail(vec3 masks, float detail) { return masks * detail; }
)~",
R"~(float3 bumpshadow_ssbump_detail(float3 masks, float detail) { return masks * detail; }
)~",
     {0x800000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_detail_masks",
R"~(// A second SSBump map as detail, packed so that flat is 0.5. The product may exceed 1: a target of 8 bits clamps it.
)~",
R"~(vec3 bumpshadow_ssbump_detail_masks(vec3 masks, vec3 detail) { return 2.0 * masks * detail; }
)~",
R"~(float3 bumpshadow_ssbump_detail_masks(float3 masks, float3 detail) { return 2.0 * masks * detail; }
)~",
     {0x1000000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_lightmaps",
R"~(// Diffuse light from three lightmaps, one for each basis vector b, each simply multiplied by its mask. Exact for a
// light from anywhere that all three face, since the basis is orthonormal. Lightmaps that hold the irradiance on planes
// facing b, the integral of L max(0, b . w), make broad light brighter than it is: an even sky on a flat texel 1.37
// times. With the dot not clamped (and the sum clamped at 0) that is exact, too. Measured on six height maps under
// suns of 25 and 50 degrees and a sky: root mean square error over the mean of traced light 24 % with directional
// occlusion, 29 % with ambient and 51 % without; dots not clamped: 19, 18 and 27 %.
)~",
R"~(vec3 bumpshadow_ssbump_lightmaps(vec3 masks, vec3 red, vec3 green, vec3 blue) {
    return masks.x * red + masks.y * green + masks.z * blue;
}
)~",
R"~(float3 bumpshadow_ssbump_lightmaps(float3 masks, float3 red, float3 green, float3 blue) {
    return masks.x * red + masks.y * green + masks.z * blue;
}
)~",
     {0x2000000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_normal_lightmaps",
R"~(// The same lightmaps with an ordinary normal map (McTaggart 2004, Half-Life 2 / Valve Source Shading): weights are the
// squares of the clamped dots, over their sum. A normal of any length from 1e-10 to 1e15.
)~",
R"~(vec3 bumpshadow_normal_lightmaps(vec3 normal, vec3 red, vec3 green, vec3 blue) {
    vec3 dots = max(bumpshadow_ssbump_project(normal), 0.0);
    vec3 squares = dots * dots;
    float sum = max(squares.x + squares.y + squares.z, 1e-20);
    return (squares.x * red + squares.y * green + squares.z * blue) * (1.0 / sum);
}
)~",
R"~(float3 bumpshadow_normal_lightmaps(float3 normal, float3 red, float3 green, float3 blue) {
    float3 dots = max(bumpshadow_ssbump_project(normal), 0.0);
    float3 squares = dots * dots;
    float sum = max(squares.x + squares.y + squares.z, 1e-20);
    return (squares.x * red + squares.y * green + squares.z * blue) * (1.0 / sum);
}
)~",
     {0x4010000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_weights",
R"~(// A dynamic light projected on the basis: three dots, clamped. light: towards the light in tangent space, as long as it
// is strong. Once an object or vertex for lights that are far. As with a normal map, a light below the surface still
// shines on slopes that face it, down to 54.7 degrees below; where it must not, pass the zero vector.
)~",
R"~(vec3 bumpshadow_ssbump_weights(vec3 light) { return max(bumpshadow_ssbump_project(light), 0.0); }
)~",
R"~(float3 bumpshadow_ssbump_weights(float3 light) { return max(bumpshadow_ssbump_project(light), 0.0); }
)~",
     {0x8010000000000000u, 0x0u, 0x0u, 0x0u}},
    {"bumpshadow_ssbump_light",
R"~(// Diffuse light of a dynamic light; weights: from the function above. In place of the clamped dot of normal and light,
// and of a shadow factor. At most the length of the masks times that of the light, not 1: with a unit light 1.003 for
// baked masks of 8 bits, sqrt(3) for white ones.
)~",
R"~(float bumpshadow_ssbump_light(vec3 masks, vec3 weights) { return dot(masks, weights); }
)~",
R"~(float bumpshadow_ssbump_light(float3 masks, float3 weights) { return dot(masks, weights); }
)~",
     {0x0u, 0x1u, 0x0u, 0x0u}},
    {"bumpshadow_volume_coordinate",
R"~(// Third coordinate of a volume texture that repeats, for one fetch, at level 0: where bearings wrap the coordinate
// jumps, and implicit derivatives would ask for a coarse level there. offset: 0.5 / N - phase
)~",
R"~(float bumpshadow_volume_coordinate(float bearing, float offset) { return bearing + offset; }
)~",
R"~(float bumpshadow_volume_coordinate(float bearing, float offset) { return bearing + offset; }
)~",
     {0x0u, 0x2u, 0x0u, 0x0u}},
    {"bumpshadow_tangent_layers",
R"~(// An array of layers, for two fetches: x, y: the two layers, z: part of the second one. phase and bearing may have any
// sign.
)~",
R"~(vec3 bumpshadow_tangent_layers(float bearing, float phase, float slices) {
    float position = fract(bearing - phase) * slices;
    float layer = min(floor(position), slices - 1.0);
    float next = layer + 1.0;
    return vec3(layer, next < slices ? next : 0.0, position - layer);
}
)~",
R"~(float3 bumpshadow_tangent_layers(float bearing, float phase, float slices) {
    float position = frac(bearing - phase) * slices;
    float layer = min(floor(position), slices - 1.0);
    float next = layer + 1.0;
    return float3(layer, next < slices ? next : 0.0, position - layer);
}
)~",
     {0x0u, 0x4u, 0x0u, 0x0u}},
    {"bumpshadow_arc_coordinate",
R"~(// Third coordinate of a volume texture that is clamped along it, for one fetch. Bearings beyond the arc get the nearer
// end.
)~",
R"~(float bumpshadow_arc_coordinate(float bearing, float start, float scale, float offset) {
    return scale * fract(bearing - start) + offset;
}
)~",
R"~(float bumpshadow_arc_coordinate(float bearing, float start, float scale, float offset) {
    return scale * frac(bearing - start) + offset;
}
)~",
     {0x0u, 0x8u, 0x0u, 0x0u}},
    {"bumpshadow_arc_layers",
R"~(// The two layers of an array (x, y), and the part of the second one (z). Layer y may be one too many where its part is
// 0: hardware clamps it.
)~",
R"~(vec3 bumpshadow_arc_layers(float bearing, float start, float scale, float offset, float slices) {
    float position = clamp(scale * fract(bearing - start) + offset, 0.0, slices - 1.0);
    float layer = floor(position);
    return vec3(layer, layer + 1.0, position - layer);
}
)~",
R"~(float3 bumpshadow_arc_layers(float bearing, float start, float scale, float offset, float slices) {
    float position = clamp(scale * frac(bearing - start) + offset, 0.0, slices - 1.0);
    float layer = floor(position);
    return float3(layer, layer + 1.0, position - layer);
}
)~",
     {0x0u, 0x10u, 0x0u, 0x0u}},
    {"bumpshadow_tangent_horizon",
R"~(// Horizon from the values of the two layers.
)~",
R"~(float bumpshadow_tangent_horizon(float value, float next_value, float part) {
    return mix(value, next_value, part);
}
)~",
R"~(float bumpshadow_tangent_horizon(float value, float next_value, float part) {
    return lerp(value, next_value, part);
}
)~",
     {0x0u, 0x20u, 0x0u, 0x0u}},
    {"bumpshadow_to_tangent_space",
R"~(// Into tangent space: the axes are unit vectors, at right angles to each other.
)~",
R"~(vec3 bumpshadow_to_tangent_space(vec3 v, vec3 tangent, vec3 bitangent, vec3 normal) {
    return vec3(dot(v, tangent), dot(v, bitangent), dot(v, normal));
}
)~",
R"~(float3 bumpshadow_to_tangent_space(float3 v, float3 tangent, float3 bitangent, float3 normal) {
    return float3(dot(v, tangent), dot(v, bitangent), dot(v, normal));
}
)~",
     {0x0u, 0x40u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_slope",
R"~(// Slope of a light, cut at `most`: a vertex that the light stands above would outweigh all others. max_slope serves for
// c = 1, and max_slope (1 + 0.5 / k) for c = 0.5.
)~",
R"~(float bumpshadow_vertex_slope(vec3 light, float most) {
    return clamp(bumpshadow_slope(light), -most, most);
}
)~",
R"~(float bumpshadow_vertex_slope(float3 light, float most) {
    return clamp(bumpshadow_slope(light), -most, most);
}
)~",
     {0x40000001u, 0x80u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_bearing_exact",
R"~(// Bearing (x, turns) and slope (y, cut at `most`) of a light; the bearing by bumpshadow_bearing_exact.
)~",
R"~(vec2 bumpshadow_vertex_bearing_exact(vec3 light, float most) {
    return vec2(bumpshadow_bearing_exact(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float2 bumpshadow_vertex_bearing_exact(float3 light, float most) {
    return float2(bumpshadow_bearing_exact(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
     {0x4000001fu, 0x180u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_bearing_quintic",
R"~(// The same by bumpshadow_bearing_quintic.
)~",
R"~(vec2 bumpshadow_vertex_bearing_quintic(vec3 light, float most) {
    return vec2(bumpshadow_bearing_quintic(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float2 bumpshadow_vertex_bearing_quintic(float3 light, float most) {
    return float2(bumpshadow_bearing_quintic(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
     {0x4000002fu, 0x280u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_bearing_cubic",
R"~(// The same by bumpshadow_bearing_cubic.
)~",
R"~(vec2 bumpshadow_vertex_bearing_cubic(vec3 light, float most) {
    return vec2(bumpshadow_bearing_cubic(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float2 bumpshadow_vertex_bearing_cubic(float3 light, float most) {
    return float2(bumpshadow_bearing_cubic(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
     {0x4000004fu, 0x480u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_bearing_octant",
R"~(// The same by bumpshadow_bearing_octant.
)~",
R"~(vec2 bumpshadow_vertex_bearing_octant(vec3 light, float most) {
    return vec2(bumpshadow_bearing_octant(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float2 bumpshadow_vertex_bearing_octant(float3 light, float most) {
    return float2(bumpshadow_bearing_octant(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
     {0x4000008fu, 0x880u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_bearing_diamond",
R"~(// The same by bumpshadow_bearing_diamond.
)~",
R"~(vec2 bumpshadow_vertex_bearing_diamond(vec3 light, float most) {
    return vec2(bumpshadow_bearing_diamond(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float2 bumpshadow_vertex_bearing_diamond(float3 light, float most) {
    return float2(bumpshadow_bearing_diamond(float2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
)~",
     {0x4000010fu, 0x1080u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_direction",
R"~(// Direction (xy, of length 1; 0 straight up, so that such a vertex leaves the direction to the others) and slope (z).
// Of length 1 while the square of the light's xy neither overflows nor vanishes, from 1e-15 to 1e19; beyond, shorter.
)~",
R"~(vec3 bumpshadow_vertex_direction(vec3 light, float most) {
    float inverse = inversesqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return vec3(light.x * inverse, light.y * inverse, bumpshadow_vertex_slope(light, most));
}
)~",
R"~(float3 bumpshadow_vertex_direction(float3 light, float most) {
    float inverse = rsqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return float3(light.x * inverse, light.y * inverse, bumpshadow_vertex_slope(light, most));
}
)~",
     {0x40000001u, 0x2080u, 0x0u, 0x0u}},
    {"bumpshadow_vertex_direction_sine",
R"~(// The same with the sine (z), which needs no cut.
)~",
R"~(vec3 bumpshadow_vertex_direction_sine(vec3 light) {
    float inverse = inversesqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return vec3(light.x * inverse, light.y * inverse, bumpshadow_sine(light));
}
)~",
R"~(float3 bumpshadow_vertex_direction_sine(float3 light) {
    float inverse = rsqrt(max(light.x * light.x + light.y * light.y, 1e-30));
    return float3(light.x * inverse, light.y * inverse, bumpshadow_sine(light));
}
)~",
     {0x80000001u, 0x4000u, 0x0u, 0x0u}},
    {"bumpshadow_unwrap_bearings",
R"~(// Bearings of a triangle's vertices moved by whole turns to within half a turn of the first, as Direct3D's wrap mode
// did: 0.1, 0.2, 0.9 becomes 0.1, 0.2, -0.1. For geometry and mesh shaders, and for lights that are fixed in a mesh.
)~",
R"~(vec3 bumpshadow_unwrap_bearings(vec3 bearings) {
    return vec3(bearings.x, bearings.y - floor(bearings.y - bearings.x + 0.5),
                bearings.z - floor(bearings.z - bearings.x + 0.5));
}
)~",
R"~(float3 bumpshadow_unwrap_bearings(float3 bearings) {
    return float3(bearings.x, bearings.y - floor(bearings.y - bearings.x + 0.5),
                bearings.z - floor(bearings.z - bearings.x + 0.5));
}
)~",
     {0x0u, 0x8000u, 0x0u, 0x0u}},
    {"bumpshadow_bearings_go_round",
R"~(// True where the light stands above the triangle: its unwrapped bearings go round, and no bearings that are
// interpolated linearly can be right.
)~",
R"~(bool bumpshadow_bearings_go_round(vec3 unwrapped) { return abs(unwrapped.y - unwrapped.z) > 0.5; }
)~",
R"~(bool bumpshadow_bearings_go_round(float3 unwrapped) { return abs(unwrapped.y - unwrapped.z) > 0.5; }
)~",
     {0x0u, 0x10000u, 0x0u, 0x0u}},
    {"bumpshadow_bearing_pair",
R"~(// Without neighbors: interpolate a bearing twice, once with its seam at 0 and once at half a turn. A triangle that
// spans less than half a turn crosses one of the two at most; there that one changes faster. Source: Tarini,
// Cylindrical and Toroidal Parameterizations Without Vertex Seams, 2012.
)~",
R"~(vec2 bumpshadow_bearing_pair(float bearing) {
    return vec2(fract(bearing), fract(bearing + 0.5) - 0.5);
}
)~",
R"~(float2 bumpshadow_bearing_pair(float bearing) {
    return float2(frac(bearing), frac(bearing + 0.5) - 0.5);
}
)~",
     {0x0u, 0x20000u, 0x0u, 0x0u}},
    {"bumpshadow_pick_bearing",
R"~(// change: fwidth of the pair.
)~",
R"~(float bumpshadow_pick_bearing(vec2 pair, vec2 change) {
    return change.y < change.x ? pair.y : pair.x;
}
)~",
R"~(float bumpshadow_pick_bearing(float2 pair, float2 change) {
    return change.y < change.x ? pair.y : pair.x;
}
)~",
     {0x0u, 0x40000u, 0x0u, 0x0u}},
};

}  // namespace bumpshadow::shader_text
