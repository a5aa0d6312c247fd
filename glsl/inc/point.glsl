// A regular splat (see box.glsl) as a point sprite.
//
// (uw, vw, w) is expanded about the projected center, where it is (0, 0, near / p_z) exactly: a varying less than the
// paper's N (x, y, 1), and half its error in f32. A regular splat's center projects safely, also when it lies outside
// of the viewport: the disk reaches the viewport, so the offsets stay within the disk's own size.
//
// The sprite is the square of pixels around the box. Vulkan clips a point by its center, so the square may stick out of
// the viewport but its center may not: along its shorter side the box stays centered, up to half a pixel.

const float INSIDE = 1.0 - 2.4e-7;

struct Point {
    vec2 clip_center;
    float size_px;
    vec2 x0_px;    // the projected center
    float w0;      // near / p_z
    vec3 per_px_x;
    vec3 per_px_y;
};

// False where it covers no pixel's center.
bool point_of(Mapping m, out Point point)
{
    PixelBox px;
    if (!pixel_box(regular_box(m), px)) {
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
    precise vec2 x0_px = FORMULA(FORMULA_EXPANSION_POINT, projected_center_px(m));
    precise float w0 = FORMULA(FORMULA_CENTER_CONSTANTS, frame.near / m.p.z);
    point.x0_px = x0_px;
    point.w0 = w0;
    per_pixel(m, point.per_px_x, point.per_px_y);
    return true;
}
