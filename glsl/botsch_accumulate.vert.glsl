// Attribute accumulation by ray casting as Botsch et al. 2005 have it: see inc/botsch.glsl. The point is as large as the
// low-pass filter at least; the normal looks to the eye, for shading.
#version 460
#include "inc/botsch.glsl"

layout(location = 4) flat out vec2 center_px; // in radii of the low-pass filter
layout(location = 5) flat out vec3 normal;
layout(location = 6) flat out vec3 color;

void main()
{
    vec3 p = view_center();
    float size_px;
    vec3 n = set_up(p, size_px);
    gl_PointSize = max(size_px, push.least_size_px);
    center_px = p.xy / p.z * push.size_px;
    normal = dot(n, p) > 0.0 ? -n : n;
    uvec2 packed = colors[gl_VertexIndex];
    color = vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x);
}
