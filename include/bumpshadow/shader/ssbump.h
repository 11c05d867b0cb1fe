// Self-shadowed bump maps: three masks, red, green and blue, one for each vector of an orthonormal basis around the
// surface normal (Ols 2010; Green 2007, Efficient Self-Shadowed Radiosity Normal Mapping). In tangent space they are
//   red (sqrt(2/3), 0, 1/sqrt(3)), green (-1/sqrt(6), 1/sqrt(2), 1/sqrt(3)), blue (-1/sqrt(6), -1/sqrt(2), 1/sqrt(3)).
// masks: what the texture holds. Where the y of the map and that of the tangent space point opposite ways, pass the
// masks through bumpshadow_ssbump_other_hand first. All functions are finite for masks, vectors and lights of up to 1e15
// and lightmaps of up to 1e6; where squares overflow they give the zero vector or what is not a number.

// Left-handed (y-down) masks to right-handed (y-up) ones and back: green and blue swapped, which is the same as
// swapping the last two vectors of the basis. Doing both undoes it.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_other_hand(vec3 masks) { return vec3(masks.x, masks.z, masks.y); }

// Sum of the basis vectors, each times its mask; not unit length.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_sum(vec3 masks) {
    return vec3(0.81649658f * masks.x - 0.40824829f * (masks.y + masks.z), 0.70710678f * (masks.y - masks.z),
                0.57735027f * (masks.x + masks.y + masks.z));
}

// Three dots with the basis, the inverse of the sum: the masks of a unit normal as long as none is negative, which they
// are not up to a tilt of 35.26 degrees, asin(1/sqrt(3)); beyond, some bearings make one negative.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_project(vec3 v) {
    float up = 0.57735027f * v.z;
    float side = 0.70710678f * v.y;
    float back = up - 0.40824829f * v.x;
    return vec3(0.81649658f * v.x + up, back + side, back - side);
}

// Unit normal: of the surface for masks without occlusion, else bent towards where it is open. Black, and whatever is
// shorter than 1e-4, gives straight up.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_normal(vec3 masks) {
    vec3 sum = bumpshadow_ssbump_sum(masks);
    float square = dot(sum, sum);
    return square > 1e-8f ? sum * inversesqrt(square) : vec3(0.0f, 0.0f, 1.0f);
}

// The basis concatenated with the way from tangent space to the world, whose axes are unit vectors in the world: once a
// vertex or a pixel. Any of the sums above then lands in the world. This is the vector of the red mask.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_world_red(vec3 tangent, vec3 normal) {
    return 0.81649658f * tangent + 0.57735027f * normal;
}
// The vector of the green mask in the world.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_world_green(vec3 tangent, vec3 bitangent, vec3 normal) {
    return 0.70710678f * bitangent - 0.40824829f * tangent + 0.57735027f * normal;
}
// The vector of the blue mask in the world.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_world_blue(vec3 tangent, vec3 bitangent, vec3 normal) {
    return 0.57735027f * normal - 0.40824829f * tangent - 0.70710678f * bitangent;
}

// Straight to a unit normal in the world; red, green, blue: from the three functions above. Black gives the zero
// vector, and masks shorter than 1e-10 a shorter one.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_world_normal(vec3 masks, vec3 red, vec3 green, vec3 blue) {
    vec3 sum = masks.x * red + masks.y * green + masks.z * blue;
    return sum * inversesqrt(max(dot(sum, sum), 1e-20f));
}

// Where a ray from the eye goes on to: `eye` points to the eye, `normal` is unit length, both in the same space.
BUMPSHADOW_FUNCTION vec3 bumpshadow_reflection(vec3 eye, vec3 normal) { return 2.0f * dot(normal, eye) * normal - eye; }

// A gray detail map multiplied in: the recovered normal stays. detail: 1 changes nothing.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_detail(vec3 masks, float detail) { return masks * detail; }

// A second SSBump map as detail, packed so that flat is 0.5. The product may exceed 1: a target of 8 bits clamps it.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_detail_masks(vec3 masks, vec3 detail) { return 2.0f * masks * detail; }

// Diffuse light from three lightmaps, one for each basis vector b, each simply multiplied by its mask. Exact for a
// light from anywhere that all three face, since the basis is orthonormal. Lightmaps that hold the irradiance on planes
// facing b, the integral of L max(0, b . w), make broad light brighter than it is: an even sky on a flat texel 1.37
// times. With the dot not clamped (and the sum clamped at 0) that is exact, too. Measured on six height maps under
// suns of 25 and 50 degrees and a sky: root mean square error over the mean of traced light 24 % with directional
// occlusion, 29 % with ambient and 51 % without; dots not clamped: 19, 18 and 27 %.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_lightmaps(vec3 masks, vec3 red, vec3 green, vec3 blue) {
    return masks.x * red + masks.y * green + masks.z * blue;
}

// The same lightmaps with an ordinary normal map (McTaggart 2004, Half-Life 2 / Valve Source Shading): weights are the
// squares of the clamped dots, over their sum. A normal of any length from 1e-10 to 1e15.
BUMPSHADOW_FUNCTION vec3 bumpshadow_normal_lightmaps(vec3 normal, vec3 red, vec3 green, vec3 blue) {
    vec3 dots = max(bumpshadow_ssbump_project(normal), 0.0f);
    vec3 squares = dots * dots;
    float sum = max(squares.x + squares.y + squares.z, 1e-20f);
    return (squares.x * red + squares.y * green + squares.z * blue) * (1.0f / sum);
}

// A dynamic light projected on the basis: three dots, clamped. light: towards the light in tangent space, as long as it
// is strong. Once an object or vertex for lights that are far. As with a normal map, a light below the surface still
// shines on slopes that face it, down to 54.7 degrees below; where it must not, pass the zero vector.
BUMPSHADOW_FUNCTION vec3 bumpshadow_ssbump_weights(vec3 light) { return max(bumpshadow_ssbump_project(light), 0.0f); }

// Diffuse light of a dynamic light; weights: from the function above. In place of the clamped dot of normal and light,
// and of a shadow factor. At most the length of the masks times that of the light, not 1: with a unit light 1.003 for
// baked masks of 8 bits, sqrt(3) for white ones.
BUMPSHADOW_FUNCTION float bumpshadow_ssbump_light(vec3 masks, vec3 weights) { return dot(masks, weights); }
