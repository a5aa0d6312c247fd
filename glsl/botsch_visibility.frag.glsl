// Visibility splatting by ray casting as Botsch et al. 2005 have it.
#version 460
#include "inc/botsch_ray.glsl"

void main()
{
    if (r2_and_depth(gl_FragDepth) > 1.0) {
        discard;
    }
}
