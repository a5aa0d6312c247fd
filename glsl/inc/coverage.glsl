// Where a fragment lies in its splat, and whether it is covered: the "three instructions" of Guennebaud et al. 2006,
// section 3.2. The depth w = near / z must come out bit-equal in every pass, so it is computed here only and is
// `precise`.

#define VARYING in
#include "inc/varyings.glsl"

// (uw, vw, w) at this fragment; discards it if it is not covered or lies in front of the near plane.
vec3 covered_uvw()
{
    vec2 d = gl_FragCoord.xy - x0_and_constants_uv.xy;
    precise vec3 constants = vec3(x0_and_constants_uv.zw, per_px_x_and_w.w);
    precise vec3 uvw = constants + per_px_x_and_w.xyz * d.x + per_px_y_and_shift.xyz * d.y;
    bool inside = dot(uvw.xy, uvw.xy) <= FORMULA(FORMULA_COVERAGE, frame.coverage_r2) * uvw.z * uvw.z;
    // w = near / z: above 1 in front of the near plane, not above 0 behind the eye. A NaN fails too.
    if (!(inside && uvw.z > 0.0 && uvw.z <= FORMULA(FORMULA_NEAR_CUT, 1.0))) {
        discard;
    }
    return uvw;
}
