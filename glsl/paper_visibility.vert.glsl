// Visibility splatting as Guennebaud, Barthe, Paulin 2006 publish it: see inc/paper.glsl. Without their filter, which is the
// attribute pass's: table 1 has 12 instructions more there, which is what the filter takes.
#version 460
#include "inc/paper.glsl"

void main()
{
    vec3 p;
    vec3 n;
    float radius;
    load_disk(p, n, radius);
    vec3 s;
    vec3 t;
    basis(p, n, radius, s, t);
    // Moved along the ray by epsilon: the same image, depth b / (z + epsilon).
    emit(p, s, t, p.z / (p.z + push.epsilon_radii * radius));
}
