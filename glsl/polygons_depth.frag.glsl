// Polygons in the visibility pass of a transparent layer: their depth, moved away from the eye by epsilon, as a length: near /
// (z + epsilon) = w near / (near + epsilon w). PEELED: only what is behind the layer before; see peel.glsl.
// Permutations: _ peeled
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#if defined(PEELED)
#include "inc/peel.glsl"
#endif

void main()
{
#if defined(PEELED)
    peel(gl_FragCoord.z);
#endif
    float w = gl_FragCoord.z;
    float epsilon = FORMULA(FORMULA_POLYGON_SHIFT, frame.epsilon_length);
    // Exactly w without epsilon.
    gl_FragDepth = epsilon > 0.0 ? w * (frame.near / (frame.near + epsilon * w)) : w;
}
