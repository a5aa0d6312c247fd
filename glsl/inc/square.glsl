// The square of pixels around a splat's box, as a point sprite. Vulkan clips a point by its center, so the square may
// stick out of the viewport but its center may not: along its shorter side the box stays centered, up to half a pixel.

struct Square {
    vec2 center;   // clip space
    float size_px;
};

Square point_square(Setup o)
{
    float side = point_size_px(o);
    vec2 size = vec2(o.hi_px - o.lo_px + 1);
    // An odd difference of the sides puts the center half a pixel off, so that the square still ends on pixel borders.
    vec2 center_px = vec2(o.lo_px) + 0.5 * (size + mod(side - size, 2.0));
    return Square(2.0 * center_px / frame.size_px - 1.0, ceil(side / frame.point_step_px) * frame.point_step_px);
}
