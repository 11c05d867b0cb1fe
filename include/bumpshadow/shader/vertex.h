// What can be computed a vertex (or an object) at a time and interpolated over triangles.
//
// Three sets of interpolants, from the fewest instructions a pixel to the smallest error:
//   bearing, level           nothing left to do a pixel; needs the seam fix below, and is undefined over the triangle
//                            that the light stands above (Forsyth, Self-shadowing Bumpmap, section 4.1)
//   direction (2), level     a bearing a pixel; no seam, and defined everywhere
//   the light itself (3)     bearing and level a pixel; exact for a point light over a flat triangle

// Into tangent space: the axes are unit vectors, at right angles to each other.
BUMPSHADOW_FUNCTION vec3 bumpshadow_to_tangent_space(vec3 v, vec3 tangent, vec3 bitangent, vec3 normal) {
    return vec3(dot(v, tangent), dot(v, bitangent), dot(v, normal));
}

// Slope of a light, cut at `most`: a vertex that the light stands above would outweigh all others. max_slope serves for
// c = 1, and max_slope (1 + 0.5 / k) for c = 0.5.
BUMPSHADOW_FUNCTION float bumpshadow_vertex_slope(vec3 light, float most) {
    return clamp(bumpshadow_slope(light), -most, most);
}

// Bearing (x, turns) and slope (y, cut at `most`) of a light; the bearing by bumpshadow_bearing_exact.
BUMPSHADOW_FUNCTION vec2 bumpshadow_vertex_bearing_exact(vec3 light, float most) {
    return vec2(bumpshadow_bearing_exact(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
// The same by bumpshadow_bearing_quintic.
BUMPSHADOW_FUNCTION vec2 bumpshadow_vertex_bearing_quintic(vec3 light, float most) {
    return vec2(bumpshadow_bearing_quintic(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
// The same by bumpshadow_bearing_cubic.
BUMPSHADOW_FUNCTION vec2 bumpshadow_vertex_bearing_cubic(vec3 light, float most) {
    return vec2(bumpshadow_bearing_cubic(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
// The same by bumpshadow_bearing_octant.
BUMPSHADOW_FUNCTION vec2 bumpshadow_vertex_bearing_octant(vec3 light, float most) {
    return vec2(bumpshadow_bearing_octant(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}
// The same by bumpshadow_bearing_diamond.
BUMPSHADOW_FUNCTION vec2 bumpshadow_vertex_bearing_diamond(vec3 light, float most) {
    return vec2(bumpshadow_bearing_diamond(vec2(light.x, light.y)), bumpshadow_vertex_slope(light, most));
}

// Direction (xy, of length 1; 0 straight up, so that such a vertex leaves the direction to the others) and slope (z).
// Of length 1 while the square of the light's xy neither overflows nor vanishes, from 1e-15 to 1e19; beyond, shorter.
BUMPSHADOW_FUNCTION vec3 bumpshadow_vertex_direction(vec3 light, float most) {
    float inverse = inversesqrt(max(light.x * light.x + light.y * light.y, 1e-30f));
    return vec3(light.x * inverse, light.y * inverse, bumpshadow_vertex_slope(light, most));
}

// The same with the sine (z), which needs no cut.
BUMPSHADOW_FUNCTION vec3 bumpshadow_vertex_direction_sine(vec3 light) {
    float inverse = inversesqrt(max(light.x * light.x + light.y * light.y, 1e-30f));
    return vec3(light.x * inverse, light.y * inverse, bumpshadow_sine(light));
}

// ---- The seam ----

// Bearings of a triangle's vertices moved by whole turns to within half a turn of the first, as Direct3D's wrap mode
// did: 0.1, 0.2, 0.9 becomes 0.1, 0.2, -0.1. For geometry and mesh shaders, and for lights that are fixed in a mesh.
BUMPSHADOW_FUNCTION vec3 bumpshadow_unwrap_bearings(vec3 bearings) {
    return vec3(bearings.x, bearings.y - floor(bearings.y - bearings.x + 0.5f),
                bearings.z - floor(bearings.z - bearings.x + 0.5f));
}

// True where the light stands above the triangle: its unwrapped bearings go round, and no bearings that are
// interpolated linearly can be right.
BUMPSHADOW_FUNCTION bool bumpshadow_bearings_go_round(vec3 unwrapped) { return abs(unwrapped.y - unwrapped.z) > 0.5f; }

// Without neighbors: interpolate a bearing twice, once with its seam at 0 and once at half a turn. A triangle that
// spans less than half a turn crosses one of the two at most; there that one changes faster. Source: Tarini,
// Cylindrical and Toroidal Parameterizations Without Vertex Seams, 2012.
BUMPSHADOW_FUNCTION vec2 bumpshadow_bearing_pair(float bearing) {
    return vec2(fract(bearing), fract(bearing + 0.5f) - 0.5f);
}

// change: fwidth of the pair.
BUMPSHADOW_FUNCTION float bumpshadow_pick_bearing(vec2 pair, vec2 change) {
    return change.y < change.x ? pair.y : pair.x;
}
