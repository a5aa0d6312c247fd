// Visibility splatting: the depth of the splat, moved away from the eye by epsilon (Guennebaud et al. 2006, section 2;
// Pajarola et al. 2003, figure 15). Reversed depth: nearer is larger.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/coverage.glsl"

void main()
{
    gl_FragDepth = covered_uvw().z * per_px_y_and_shift.w;
}
