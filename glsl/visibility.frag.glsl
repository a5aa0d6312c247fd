// Visibility splatting: the depth of the splat, moved away from the eye by epsilon (Guennebaud et al. 2006, section 2;
// Pajarola et al. 2003, figure 15). Reversed depth: nearer is larger. extra().x is the shift.
//
// OWN_DEPTH: of triangles in a transparent layer.
// Permutations: plain full center rays | _ clipped
// Permutations: triangles | _ own_depth | _ clipped
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#if defined(TRIANGLES) && !defined(OWN_DEPTH)
#define MOVED_DEPTH // the rasterizer's
#endif
#include "inc/coverage.glsl"
#include "inc/peel.glsl"

// What is seen here must be accumulated later, or a pixel would hide what is behind and stay empty. The passes are
// different pipelines, whose divisions may differ in the last bits: so visibility covers a hair less.
const float HAIR = 1.0 - 4e-6;

void main()
{
    Covered fragment = covered(HAIR * COVERAGE_R2);
    if (PEELED) {
        peel(fragment.w);
    }
#if !defined(TRIANGLES) || defined(OWN_DEPTH)
    gl_FragDepth = shifted(fragment.w, extra().x);
#endif
}
