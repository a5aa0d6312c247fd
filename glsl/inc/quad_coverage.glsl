// Where a quad's fragment lies in its splat, and whether it is covered; as point_coverage.glsl, for any expansion
// point, and for splats that reach the near plane.

#define VARYING in
#include "inc/quad_varyings.glsl"

// (uw, vw, w) at this fragment; discards it if it is not covered or lies in front of the near plane.
vec3 covered_uvw()
{
    vec2 d = gl_FragCoord.xy - x0_w_extra.xy;
    precise vec3 uvw = vec3(uv, x0_w_extra.z) + (per_x_extra.xyz * d.x + per_y_extra.xyz * d.y);
    bool inside = dot(uvw.xy, uvw.xy) <= FORMULA(FORMULA_COVERAGE, frame.coverage_r2) * uvw.z * uvw.z;
    // w = near / z: above 1 in front of the near plane, not above 0 behind the eye. A NaN fails too.
    if (!(inside && uvw.z > 0.0 && uvw.z <= FORMULA(FORMULA_NEAR_CUT, 1.0))) {
        discard;
    }
    return uvw;
}

vec3 extra()
{
    return vec3(x0_w_extra.w, per_x_extra.w, per_y_extra.w);
}
