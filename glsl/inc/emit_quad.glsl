// Emits one corner of a quad with the pass's extra varyings; nothing where it covers no pixel's center.

// The same expressions must give the same bits in both passes, which are different pipelines (Vulkan 1.3, "Invariance").
#define VARYING invariant out
#include "inc/quad_varyings.glsl"
#include "inc/quad.glsl"

layout(set = 1, binding = 2, std430) readonly buffer LargeList { uint large_list[]; };

void emit_nothing()
{
    gl_Position = NOWHERE;
    x0_w_extra = vec4(0.0);
    per_x_extra = vec4(0.0);
    per_y_extra = vec4(0.0);
    uvw_xy = vec2(0.0);
}

void emit_quad(Mapping m, vec3 extra)
{
    Quad quad;
    if (!quad_of(m, gl_VertexIndex, quad)) {
        emit_nothing();
        return;
    }
    gl_Position = vec4(quad.clip_corner, SAFE_DEPTH, 1.0);
    x0_w_extra = vec4(quad.x0_px, quad.constants.z, extra.x);
    per_x_extra = vec4(quad.per_px_x, extra.y);
    per_y_extra = vec4(quad.per_px_y, extra.z);
    uvw_xy = quad.constants.xy;
}
