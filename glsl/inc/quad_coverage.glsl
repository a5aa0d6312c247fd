// Where a quad's fragment lies in its splat, and whether it is covered; as point_coverage.glsl, for any expansion
// point, and for splats that reach the near plane.

#define VARYING in
#include "inc/quad_varyings.glsl"

// (u, v, w) at this fragment; discards it if u^2 + v^2 is above the limit or it lies in front of the near plane.
vec3 covered_uvw(float limit_r2)
{
    vec2 d = gl_FragCoord.xy - x0_w_extra.xy;
    precise vec3 uvw = vec3(uvw_xy, x0_w_extra.z) + (per_x_extra.xyz * d.x + per_y_extra.xyz * d.y);
    // Divided first: the square of a small w would underflow.
    vec2 uv = uvw.xy / uvw.z;
    bool inside = dot(uv, uv) <= FORMULA(FORMULA_COVERAGE, limit_r2);
    // w = near / z: above 1 in front of the near plane, not above 0 behind the eye. A NaN fails too.
    if (!(inside && uvw.z > 0.0 && uvw.z <= FORMULA(FORMULA_NEAR_CUT, 1.0))) {
        discard;
    }
    return vec3(uv, uvw.z);
}

vec3 extra()
{
    return vec3(x0_w_extra.w, per_x_extra.w, per_y_extra.w);
}
