// Horizons as four neighboring slices in each RGBA layer of an array (encode/slice_layers.hpp): N slices, slice i at
// bearing phase + i / N. Layers are numbers for the third coordinate of an array texture. Values are the stored
// quantity over what stands for 1, and are compared with a light in the same unit.

// Position of a bearing among the slices, in [0, N], N by rounding alone. phase and bearing may have any sign.
BUMPSHADOW_FUNCTION float bumpshadow_slice_position(float bearing, float phase, float slices) {
    return fract(bearing - phase) * slices;
}

// Four slices a layer, two fetches; layers = N / 4. x, y: layers; z: position from the first channel of layer x on, in
// [0, 4].
BUMPSHADOW_FUNCTION vec3 bumpshadow_grouped_layers(float position, float layers) {
    // A little less than a quarter, so that N finds the last layer; a place of 4 is as good as 0 in the next one.
    float layer = floor(position * 0.24999996f);
    float next = layer + 1.0f;
    return vec3(layer, next < layers ? next : 0.0f, position - 4.0f * layer);
}

// Horizon from layer x, and the first channel of layer y.
BUMPSHADOW_FUNCTION float bumpshadow_grouped_horizon(vec4 values, float next_value, float place) {
    // Of the two neighbors one is even, the other odd.
    float past = place - 2.0f;
    float even = abs(past) < 1.0f ? values.z : (past < 0.0f ? values.x : next_value);
    float odd = past < 0.0f ? values.y : values.w;
    return odd + abs(abs(past) - 1.0f) * (even - odd);
}

// Layers that overlap by one slice, one fetch. x: layer; y: position from its first channel on, in [0, 3].
BUMPSHADOW_FUNCTION vec2 bumpshadow_overlapping_layer(float position) {
    // A little less than a third, so that N finds the last layer.
    float layer = floor(position * 0.33333328f);
    return vec2(layer, position - 3.0f * layer);
}

// Horizon from the layer.
BUMPSHADOW_FUNCTION float bumpshadow_overlapping_horizon(vec4 values, float place) {
    float past = place - 2.0f;
    float even = past < -1.0f ? values.x : values.z;
    float odd = past < 0.0f ? values.y : values.w;
    return odd + abs(abs(past) - 1.0f) * (even - odd);
}
