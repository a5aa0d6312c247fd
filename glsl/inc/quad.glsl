// Any splat as a quad: a strip of four vertices around its box, for splats that are too large for a point or not
// regular (mapping.glsl).

struct Quad {
    vec2 clip_corner;
    vec2 lo; // the box within the viewport, pixels
    vec2 hi;
};

// False where it covers no pixel's center.
bool quad_of(Mapping m, int corner, out Quad quad)
{
    PixelBox px;
    if (!pixel_box(splat_box(m), px)) {
        return false;
    }
    ivec2 right_down = ivec2(corner & 1, corner >> 1);
    vec2 corner_px = FORMULA(FORMULA_QUAD_CORNER, vec2(px.first + right_down * (px.last - px.first + 1)));
    quad.clip_corner = 2.0 * corner_px / frame.size_px - 1.0;
    quad.lo = px.lo;
    quad.hi = px.hi;
    return true;
}

// (uw, vw, w) is expanded about the projected center if the splat is regular, as a point's is, or if that lies inside the
// box; else about the box's middle: the center of a splat near the eye plane projects far away or not at all.
ImageMap quad_map(Mapping m, Quad quad)
{
    if (m.regular && AFFINE || m.edge_on) {
        return regular_map(m);
    }
    if (RASTERIZER == RASTERIZER_PERSPECTIVE_PAPER) {
        return projective_map_about(m, vec2(0.0));
    }
    vec2 center = projected_center_px(m);
    vec2 middle_px = 0.5 * frame.size_px;
    bool center_inside = m.p.z > m.near && all(greaterThanEqual(center, quad.lo - middle_px))
        && all(lessThanEqual(center, quad.hi - middle_px));
    if (m.regular || center_inside) {
        return projective_map_about_center(m);
    }
    return projective_map_about(m, 0.5 * (quad.lo + quad.hi) - middle_px);
}
