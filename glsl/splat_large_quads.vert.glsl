// One quad (a strip of four vertices, one instance) for each large splat: exactly its box.
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

layout(set = 1, binding = 2, std430) readonly buffer LargeList { uint large_list[]; };

void main()
{
    uint index = large_list[gl_InstanceIndex];
    Setup o;
    if (set_up(index, o)) {
        ivec2 corner = ivec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
        vec2 corner_px = FORMULA(FORMULA_QUAD_CORNER, vec2(o.lo_px + corner * (o.hi_px - o.lo_px + 1)));
        gl_Position = vec4(2.0 * corner_px / frame.size_px - 1.0, SAFE_DEPTH, 1.0);
        emit_varyings(index, o);
    } else {
        emit_nothing();
    }
}
