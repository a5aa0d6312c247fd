// Visibility splatting: one point a splat, where every splat is regular and fits a point.
#version 460
#include "inc/setup.glsl"
#include "inc/emit_point.glsl"

void main()
{
    uint index = uint(gl_VertexIndex);
    Mapping m;
    if (map_splat(index, m)) {
        emit_point(m, vec3(m.inverse_shift, 0.0, 0.0));
    } else {
        emit_nothing();
    }
}
