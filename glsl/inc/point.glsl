// A splat as a point sprite: the square around its box. Vulkan clips a point by its center, so the square may stick
// out of the viewport but its center may not: along its shorter side the box stays centered, up to half a pixel.

void emit_point(uint index, Setup o)
{
    float side = point_size_px(o);
    vec2 size = vec2(o.hi_px - o.lo_px + 1);
    // An odd difference of the sides puts the center half a pixel off, so that the square still ends on pixel borders.
    vec2 center_px = vec2(o.lo_px) + 0.5 * (size + mod(side - size, 2.0));
    center_px = FORMULA(FORMULA_POINT_CENTER, center_px);
    gl_Position = vec4(2.0 * center_px / frame.size_px - 1.0, SAFE_DEPTH, 1.0);
    gl_PointSize = FORMULA_LESS(FORMULA_POINT_SIZE, ceil(side / frame.point_step_px) * frame.point_step_px);
    emit_varyings(index, o);
}
