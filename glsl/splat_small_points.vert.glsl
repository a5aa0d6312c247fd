// One point sprite a splat, but for the large ones, which are drawn as quads.
#version 460
#define LARGE_BITS_ACCESS readonly
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/splat.glsl"
#include "inc/adjust.glsl"
#include "inc/box.glsl"
#include "inc/setup.glsl"
#include "inc/emit.glsl"
#include "inc/point.glsl"
#include "inc/large.glsl"

void main()
{
    uint index = uint(gl_VertexIndex);
    Setup o;
    gl_PointSize = 1.0;
    if (!is_large(index) && set_up(index, o)) {
        emit_point(index, o);
    } else {
        emit_nothing();
    }
}
