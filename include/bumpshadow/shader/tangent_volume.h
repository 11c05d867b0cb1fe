// Horizons as slices of one channel (encode/tangent_volume.hpp): N slices, slice i at bearing phase + i / N. Values are
// the stored quantity over what stands for 1, and are compared with a light in the same unit.
// Source: Forsyth, Self-shadowing Bumpmap using 3D Texture Hardware, sections 3 and 4.

// Third coordinate of a volume texture that repeats, for one fetch. offset: 0.5 / N - phase
BUMPSHADOW_FUNCTION float bumpshadow_volume_coordinate(float bearing, float offset) { return bearing + offset; }

// An array of layers, for two fetches: x, y: the two layers, z: part of the second one. phase and bearing may have any
// sign.
BUMPSHADOW_FUNCTION vec3 bumpshadow_tangent_layers(float bearing, float phase, float slices) {
    float position = fract(bearing - phase) * slices;
    float layer = min(floor(position), slices - 1.0f);
    float next = layer + 1.0f;
    return vec3(layer, next < slices ? next : 0.0f, position - layer);
}

// Horizon from the two values.
BUMPSHADOW_FUNCTION float bumpshadow_tangent_horizon(float value, float next_value, float part) {
    return mix(value, next_value, part);
}
