// Writes a splat's varyings; and a position that is safely outside of the clip volume for what is not drawn.

#define VARYING out
#include "inc/varyings.glsl"

const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
// The fragment stage writes the depth; this one only has to be inside the clip volume.
const float SAFE_DEPTH = 0.5;

void emit_varyings(uint index, Setup o)
{
    x0_and_constants_uv = vec4(o.x0_px, o.constants.xy);
    per_px_x_and_w = vec4(o.per_px_x, o.constants.z);
    per_px_y_and_shift = vec4(o.per_px_y, o.inverse_shift);
    splat_normal = o.normal;
    splat_color = load_color(index);
}

void emit_nothing()
{
    x0_and_constants_uv = vec4(0.0);
    per_px_x_and_w = vec4(0.0);
    per_px_y_and_shift = vec4(0.0);
    splat_normal = vec3(0.0);
    splat_color = vec3(0.0);
    gl_Position = NOWHERE;
}
