// What a quad's vertex stage hands to its fragments, the same for all of a splat. VARYING is `out` or `in`.

layout(location = 0) flat VARYING vec4 x0_w_extra;  // x0_px, constants.z, extra.x
layout(location = 1) flat VARYING vec4 per_x_extra; // per_px_x, extra.y
layout(location = 2) flat VARYING vec4 per_y_extra; // per_px_y, extra.z
layout(location = 3) flat VARYING vec2 uvw_xy;      // constants.xy
