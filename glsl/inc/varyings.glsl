// What the vertex stage hands to the fragment stage, the same for all fragments of a splat. VARYING is `out` or `in`.

layout(location = 0) flat VARYING vec4 x0_and_constants_uv; // x0_px, constants.xy
layout(location = 1) flat VARYING vec4 per_px_x_and_w;      // per_px_x, constants.z
layout(location = 2) flat VARYING vec4 per_px_y_and_shift;  // per_px_y, inverse_shift
layout(location = 3) flat VARYING vec3 splat_normal;        // view space, unit, toward the eye
layout(location = 4) flat VARYING vec3 splat_color;         // linear albedo
