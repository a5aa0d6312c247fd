// Attribute accumulation as Guennebaud, Barthe, Paulin 2006 publish it: see inc/paper.glsl.
#version 460
#include "inc/paper.glsl"

layout(location = 3) flat out vec3 normal;
layout(location = 4) flat out vec3 color;

void main()
{
    vec3 p;
    float radius;
    load_disk(p, normal, radius);
    vec3 s;
    vec3 t;
    basis(p, normal, radius, s, t);
    adjust(p, s, t);
    emit(p, s, t, 1.0);
    uvec2 packed = colors[gl_VertexIndex];
    color = vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x);
}
