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
    quad.clip_corner = 2.0 * corner_px / SIZE_PX - 1.0;
    quad.lo = px.lo;
    quad.hi = px.hi;
    return true;
}

// Whether w loses less, in all of the box, if it is found from its value at the center than from the plane alone: a rounding of n2, e, makes
// e |d| p_z / det of it, d the way from the center's image, or e |x| / (n2 . x). Where the eye is near the plane of a large splat, det is
// small, and much of the splat is seen far from its center.
bool is_near_center(Mapping m, vec2 center_px, vec2 lo_px, vec2 hi_px)
{
    vec2 reach = max(abs(lo_px - center_px), abs(hi_px - center_px)) / frame.focal_px;
    vec3 x = vec3(0.5 * (lo_px + hi_px) / frame.focal_px, 1.0);
    float det = m.near / m.scale;
    return m.p.z > 0.0 && length(reach) * m.p.z * abs(dot(m.n2, x)) < length(x) * abs(det);
}

// (uw, vw, w) is expanded about the projected center if the splat is regular, as a point's is, or if what is seen of it is near there; else
// about the box's middle: the center of a splat near the eye plane projects far away or not at all.
ImageMap quad_map(Mapping m, Quad quad)
{
    if (m.regular && (ORTHOGRAPHIC ? FILTER == FILTER_EWA : AFFINE) || m.edge_on) {
        return regular_map(m);
    }
    vec2 lo_px = quad.lo - frame.middle_px;
    vec2 hi_px = quad.hi - frame.middle_px;
    vec2 center_px = projected_center_px(m);
    if (ORTHOGRAPHIC) {
        // Its own center, or where it would be far off the box's middle.
        bool holds_center = all(greaterThanEqual(center_px, lo_px)) && all(lessThanEqual(center_px, hi_px));
        return orthographic_map_about(m, holds_center ? center_px : 0.5 * (lo_px + hi_px));
    }
    bool near_center = m.regular || is_near_center(m, center_px, lo_px, hi_px);
    if (RASTERIZER == RASTERIZER_PERSPECTIVE_PAPER) {
        return projective_map_about(m, vec2(0.0), near_center);
    }
    // From a center far off, places in the box would lose their digits.
    bool inside = m.p.z > m.near && all(greaterThanEqual(center_px, lo_px)) && all(lessThanEqual(center_px, hi_px));
    if (m.regular || near_center && inside) {
        return projective_map_about_center(m);
    }
    return projective_map_about(m, 0.5 * (lo_px + hi_px), near_center);
}
