// Normals as textures store them, to unit normals in tangent space (+y along growing v). `y` is 1 for a map whose y
// points along growing v (y-down, D3D) and -1 for one that points the other way (y-up, GL). Error of 8 bits, mean and
// largest: 0.17 and 0.39 degrees, in the partial-derivative form 0.15 and 0.32 times max_slope.

// stored: the three channels, in [0, 1]; (1, 1, 1) / 2, which has no direction, gives straight up.
BUMPSHADOW_FUNCTION vec3 bumpshadow_normal(vec3 stored, float y) {
    vec3 normal = vec3(2.0f * stored.x - 1.0f, y * (2.0f * stored.y - 1.0f), 2.0f * stored.z - 1.0f);
    float square = dot(normal, normal);
    return square > 1e-4f ? normal * inversesqrt(square) : vec3(0.0f, 0.0f, 1.0f);
}

// Partial-derivative form: stored are dz/dx and dz/dy of the surface, over max_slope, from [-1, 1] to [0, 1]. Needs two
// channels, and derivatives of several maps may be added. Steeper slopes are not stored. max_slope: up to 1e18, whose
// square does not overflow.
BUMPSHADOW_FUNCTION vec3 bumpshadow_normal_of_derivatives(vec2 stored, float max_slope, float y) {
    vec3 normal = vec3(max_slope * (1.0f - 2.0f * stored.x), y * max_slope * (1.0f - 2.0f * stored.y), 1.0f);
    return normal * inversesqrt(dot(normal, normal));
}
