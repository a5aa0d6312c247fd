// What the passes over the whole image are told of it. The host's mirror is `FinalizeConstants` in
// src/passes/pipeline/constants.rs; the build compares the offsets.

struct FinalizeConstants {
    vec4 background; // linear, straight alpha
    vec2 half_size_px;
    vec2 middle_px;   // where the view's axis meets the image
    float focal_px;
    uint tile_height; // pixels; 0 without tiles
    float near;         // world unit; of an orthographic camera the depth where w is 0, from
    float eye_to_depth; // the plane where it is 1, which is so far from the eye
};
layout(push_constant, std430) uniform Push { FinalizeConstants push; };
