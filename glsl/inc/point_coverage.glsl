// Where a point's fragment lies in its splat, and whether it is covered: the "three instructions" of Guennebaud et al.
// 2006, section 3.2. The depth w = near / z must come out bit-equal in every pass, so it is computed here only and is
// `precise`. A regular splat lies wholly between near plane and infinity: inside the disk 0 < w <= 1 by itself.

#define VARYING in
#include "inc/point_varyings.glsl"

// (u, v, w) at this fragment; discards it if u^2 + v^2 is above the limit.
vec3 covered_uvw(float limit_r2)
{
    vec2 d = gl_FragCoord.xy - x0_w0_extra.xy;
    precise vec3 uvw = per_x_extra.xyz * d.x + per_y_extra.xyz * d.y;
    precise float w = uvw.z + x0_w0_extra.z;
    // Divided first: the square of a small w would underflow. So written that a NaN fails too.
    vec2 uv = uvw.xy / w;
    if (!(dot(uv, uv) <= FORMULA(FORMULA_COVERAGE, limit_r2))) {
        discard;
    }
    // At the near plane w is 1 but for rounding; a depth above 1 is undefined.
    return vec3(uv, min(w, 1.0));
}

vec3 extra()
{
    return vec3(x0_w0_extra.w, per_x_extra.w, per_y_extra.w);
}
