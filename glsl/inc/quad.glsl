// Any splat as a quad: a strip of four vertices around its box, for splats that are too large for a point or not
// regular (see box.glsl).
//
// (uw, vw, w) is expanded about the projected center if that lies inside the box, clamped to the viewport, else about
// the box's middle: the center of a splat near the eye plane projects far away or not at all.

struct Quad {
    vec2 clip_corner;
    vec2 x0_px;
    vec3 constants; // (uw, vw, w) at x0
    vec3 per_px_x;
    vec3 per_px_y;
};

// False where it covers no pixel's center.
bool quad_of(Mapping m, int corner, out Quad quad)
{
    PixelBox px;
    bool regular = is_regular(m);
    Box box;
    if (regular) {
        box = regular_box(m);
    } else {
        box = near_box(m);
    }
    if (!pixel_box(box, px)) {
        return false;
    }
    ivec2 right_down = ivec2(corner & 1, corner >> 1);
    vec2 corner_px = FORMULA(FORMULA_QUAD_CORNER, vec2(px.first + right_down * (px.last - px.first + 1)));
    quad.clip_corner = 2.0 * corner_px / frame.size_px - 1.0;

    vec2 projected = projected_center_px(m);
    bool center_inside = m.p.z > frame.near && all(greaterThanEqual(projected, px.lo))
        && all(lessThanEqual(projected, px.hi));
    precise vec2 x0_px = center_inside ? FORMULA(FORMULA_EXPANSION_POINT, projected) : 0.5 * (px.lo + px.hi);
    precise vec3 constants;
    if (center_inside) {
        constants = FORMULA(FORMULA_CENTER_CONSTANTS, vec3(0.0, 0.0, frame.near / m.p.z));
    } else {
        precise vec3 x0 = vec3((x0_px - 0.5 * frame.size_px) / frame.focal_px, 1.0);
        constants = FORMULA(FORMULA_ELSEWHERE_CONSTANTS, m.scale * vec3(dot(m.n0, x0), dot(m.n1, x0), dot(m.n2, x0)));
    }
    quad.x0_px = x0_px;
    quad.constants = constants;
    per_pixel(m, quad.per_px_x, quad.per_px_y);
    return true;
}
