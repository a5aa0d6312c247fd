// A regular splat (mapping.glsl) as a point sprite: the square of pixels around its box.
//
// Vulkan clips a point by its center, so the square may stick out of the viewport but its center may not: along its
// shorter side the box stays centered, up to half a pixel. A regular splat's center projects safely, also when it lies
// outside of the viewport: the disk reaches the viewport, so the offsets stay within the disk's own size.

layout(constant_id = SPEC_POINT_STEP) const float POINT_STEP_PX = 0.0625; // of the device

const float INSIDE = 1.0 - 2.4e-7;

struct Square {
    vec2 middle_px; // multiples of a half
    float side_px;  // a whole number
};

// False where it covers no pixel's center.
bool square_of(Mapping m, out Square square)
{
    PixelBox px;
    if (!pixel_box(splat_box(m), px)) {
        return false;
    }
    square.side_px = square_side_px(px);
    vec2 size = vec2(px.last - px.first + 1);
    // An odd difference of the sides puts the center half a pixel off, so that the square still ends on pixel borders.
    square.middle_px = vec2(px.first) + 0.5 * (size + mod(square.side_px - size, 2.0));
    return true;
}

vec2 clip_middle(Square square)
{
    vec2 middle_px = FORMULA(FORMULA_POINT_CENTER, square.middle_px);
    // A center on the very edge must not be rounded out of the clip volume: 2^-22 is 0.002 pixels of 16384.
    return clamp(2.0 * middle_px / SIZE_PX - 1.0, -INSIDE, INSIDE);
}

float point_size_px(Square square)
{
    return FORMULA_LESS(FORMULA_POINT_SIZE, ceil(square.side_px / POINT_STEP_PX) * POINT_STEP_PX);
}
