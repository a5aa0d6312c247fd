// Visibility splatting: one point a splat, but for those that are drawn as quads.
#version 460
#define LARGE_BITS_ACCESS readonly
#include "inc/setup.glsl"
#include "inc/emit_point.glsl"
#include "inc/large.glsl"

void main()
{
    uint index = uint(gl_VertexIndex);
    Mapping m;
    if (!is_large(index) && map_splat(index, m)) {
        emit_point(m, vec3(m.inverse_shift, 0.0, 0.0));
    } else {
        emit_nothing();
    }
}
