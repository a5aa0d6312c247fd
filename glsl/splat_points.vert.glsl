// One point sprite a splat, for chunks in which no splat can exceed the device's largest point.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/splat.glsl"
#include "inc/adjust.glsl"
#include "inc/box.glsl"
#include "inc/setup.glsl"
#include "inc/emit.glsl"
#include "inc/point.glsl"

void main()
{
    uint index = uint(gl_VertexIndex);
    Setup o;
    gl_PointSize = 1.0;
    if (set_up(index, o)) {
        emit_point(index, o);
    } else {
        emit_nothing();
    }
}
