// Visibility splatting as Guennebaud, Barthe, Paulin 2006 publish it: see inc/paper.glsl. They do not say whether it is
// filtered; their table 1 has 12 instructions more for the attribute pass, about what the filter takes, so that it is not.
#version 460
#include "inc/paper.glsl"

layout(constant_id = 0) const bool FILTERED = false; // to see what of the error is the missing filter

void main()
{
    vec3 p;
    vec3 n;
    float radius;
    load_disk(p, n, radius);
    vec3 s;
    vec3 t;
    basis(p, n, radius, s, t);
    if (FILTERED) {
        adjust(p, s, t);
    }
    // Moved along the ray by epsilon: the same image, depth b / (z + epsilon).
    emit(p, s, t, p.z / (p.z + push.epsilon_radii * radius));
}
