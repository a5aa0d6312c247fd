// Visibility splatting: the depth of the splat, moved away from the eye by epsilon (Guennebaud et al. 2006, section 2;
// Pajarola et al. 2003, figure 15). Reversed depth: nearer is larger. extra().x is 1 / f.
//
// LAYER: of triangles in a transparent layer; PEELED: only what is behind the layer before this one; see peel.glsl.
// Permutations: plain full center rays | _ peeled
// Permutations: triangles | _ layer layer_peeled
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#if defined(LAYER_PEELED)
#define LAYER
#define PEELED
#endif
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/coverage.glsl"
#if defined(PEELED)
#include "inc/peel.glsl"
#endif

// What is seen here must be accumulated later, or a pixel would hide what is behind and stay empty. The passes are
// different pipelines, whose divisions may differ in the last bits: so visibility covers a hair less.
const float HAIR = 1.0 - 4e-6;

void main()
{
    Covered fragment = covered(HAIR * COVERAGE_R2);
#if defined(PEELED)
    peel(fragment.w);
#endif
#if !defined(TRIANGLES) || defined(LAYER)
    gl_FragDepth = fragment.w * extra().x;
#endif
}
