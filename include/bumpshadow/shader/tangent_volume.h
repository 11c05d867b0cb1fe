// Horizons as slices of one channel (encode/tangent_volume.hpp): N slices, slice i at bearing phase + i / N. Values are
// the stored quantity over what stands for 1, and are compared with a light in the same unit.
// Source: Forsyth 2002, Self-shadowing Bumpmap using 3D Texture Hardware, sections 3 and 4.

// Third coordinate of a volume texture that repeats, for one fetch, at level 0: where bearings wrap the coordinate
// jumps, and implicit derivatives would ask for a coarse level there. offset: 0.5 / N - phase
BUMPSHADOW_FUNCTION float bumpshadow_volume_coordinate(float bearing, float offset) { return bearing + offset; }

// An array of layers, for two fetches: x, y: the two layers, z: part of the second one. phase and bearing may have any
// sign.
BUMPSHADOW_FUNCTION vec3 bumpshadow_tangent_layers(float bearing, float phase, float slices) {
    float position = fract(bearing - phase) * slices;
    float layer = min(floor(position), slices - 1.0f);
    float next = layer + 1.0f;
    return vec3(layer, next < slices ? next : 0.0f, position - layer);
}

// ---- Slices over an arc of bearings: start, scale and offset are those of arc_coordinate_of ----

// Third coordinate of a volume texture that is clamped along it, for one fetch. Bearings beyond the arc get the nearer
// end.
BUMPSHADOW_FUNCTION float bumpshadow_arc_coordinate(float bearing, float start, float scale, float offset) {
    return scale * fract(bearing - start) + offset;
}

// The two layers of an array (x, y), and the part of the second one (z). Layer y may be one too many where its part is
// 0: hardware clamps it.
BUMPSHADOW_FUNCTION vec3 bumpshadow_arc_layers(float bearing, float start, float scale, float offset, float slices) {
    float position = clamp(scale * fract(bearing - start) + offset, 0.0f, slices - 1.0f);
    float layer = floor(position);
    return vec3(layer, layer + 1.0f, position - layer);
}

// Horizon from the values of the two layers.
BUMPSHADOW_FUNCTION float bumpshadow_tangent_horizon(float value, float next_value, float part) {
    return mix(value, next_value, part);
}
