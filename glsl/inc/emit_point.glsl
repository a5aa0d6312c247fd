// Emits a point with the pass's extra varyings; nothing where it covers no pixel's center.

// The same expressions must give the same bits in both passes, which are different pipelines (Vulkan 1.3, "Invariance").
#define VARYING invariant out
#include "inc/point_varyings.glsl"
#include "inc/point.glsl"

void emit_nothing()
{
    gl_Position = NOWHERE;
    gl_PointSize = 1.0;
    x0_w0_extra = vec4(0.0);
    per_x_extra = vec4(0.0);
    per_y_extra = vec4(0.0);
}

void emit_point(Mapping m, vec3 extra)
{
    Point point;
    if (!point_of(m, point)) {
        emit_nothing();
        return;
    }
    gl_Position = vec4(point.clip_center, SAFE_DEPTH, 1.0);
    gl_PointSize = point.size_px;
    x0_w0_extra = vec4(point.x0_px, point.w0, extra.x);
    per_x_extra = vec4(point.per_px_x, extra.y);
    per_y_extra = vec4(point.per_px_y, extra.z);
}
