// Visibility splatting by ray casting as Botsch et al. 2005 have it: see inc/botsch.glsl. Moved along the ray by epsilon.
#version 460
#include "inc/botsch.glsl"

void main()
{
    vec3 p = view_center();
    p += push.epsilon * inversesqrt(dot(p, p)) * p;
    set_up(p, gl_PointSize);
}
