// What a point's vertex stage hands to its fragments, the same for all of a splat. VARYING is `out` or `in`; the pass
// uses `extra` and `attribute` as it likes.

layout(location = 0) flat VARYING vec4 x0_w0_extra; // x0_px, w0, extra.x
layout(location = 1) flat VARYING vec4 per_x_extra; // per_px_x, extra.y
layout(location = 2) flat VARYING vec4 per_y_extra; // per_px_y, extra.z
