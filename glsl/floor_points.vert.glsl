// For the floor benchmark: a pass-through vertex stage.
#version 460
#include "inc/config.glsl"

layout(set = 1, binding = BIND_LIST_POINTS, std430) readonly buffer FloorPoints { vec4 points[]; }; // x, y, depth, size

void main()
{
    vec4 point = points[gl_VertexIndex];
    gl_Position = vec4(point.xyz, 1.0);
    gl_PointSize = point.w;
}
