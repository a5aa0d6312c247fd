// A regular splat (mapping.glsl) as a point sprite: the square of pixels around its box.
//
// Vulkan clips a point by its center, so the square may stick out of the viewport but its center may not: along its
// shorter side the box stays centered, up to half a pixel. A regular splat's center projects safely, also when it lies
// outside of the viewport: the disk reaches the viewport, so the offsets stay within the disk's own size.

const float INSIDE = 1.0 - 2.4e-7;

struct Point {
    vec2 clip_center;
    float size_px;
};

// False where it covers no pixel's center.
bool point_of(Mapping m, out Point point)
{
    PixelBox px;
    if (!pixel_box(splat_box(m), px)) {
        return false;
    }
    float side = square_side_px(px);
    vec2 size = vec2(px.last - px.first + 1);
    // An odd difference of the sides puts the center half a pixel off, so that the square still ends on pixel borders.
    vec2 center_px = vec2(px.first) + 0.5 * (size + mod(side - size, 2.0));
    center_px = FORMULA(FORMULA_POINT_CENTER, center_px);
    // A center on the very edge must not be rounded out of the clip volume: 2^-22 is 0.002 pixels of 16384.
    point.clip_center = clamp(2.0 * center_px / frame.size_px - 1.0, -INSIDE, INSIDE);
    point.size_px = FORMULA_LESS(FORMULA_POINT_SIZE, ceil(side / frame.point_step_px) * frame.point_step_px);
    return true;
}
