// Polygons in the visibility pass of a transparent layer: their depth, moved away from the eye by epsilon, as a length: near /
// (z + epsilon) = w near / (near + epsilon w).
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/config.glsl"
#include "inc/projection.glsl"
#include "inc/peel.glsl"
#define PLANES_SET 2
#define PLANES_BINDING BIND_READ_PLANES
#include "inc/planes.glsl"

void main()
{
    float w = gl_FragCoord.z;
    if (PLANES > 0 && is_cut_off(gl_FragCoord.xy - frame.middle_px, w)) {
        discard;
    }
    if (PEELED) {
        peel(w);
    }
    float epsilon = FORMULA(FORMULA_POLYGON_SHIFT, frame.epsilon_length);
    // Exactly w without epsilon.
    float shift = ORTHOGRAPHIC ? epsilon / frame.near : frame.near / (frame.near + epsilon * w);
    gl_FragDepth = epsilon > 0.0 ? shifted(w, shift) : w;
}
