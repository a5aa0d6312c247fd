#include "inc/finalize.glsl"

// The direction from the surface to the eye, view space.
vec3 to_eye()
{
    return direction_to_eye(vec3(FORMULA(FORMULA_EYE_DIRECTION, (gl_FragCoord.xy - push.middle_px) / push.focal_px), 1.0));
}
