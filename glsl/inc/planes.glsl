// Planes that cut all that is seen (--clip-box, --clip-plane), in the image; PLANES: how many there are. PLANES_SET, PLANES_BINDING: where they are found.
//
// N is a plane's unit normal toward what is left, in view space, and D by how much the eye is on that side. What a ray (x, y, 1) meets at depth z is z (x, y, 1), and
// is left where N . (x, y, 1) + D / z >= 0. With the depth w = near / z that is linear in the pixel and in w, and so is it, orthographic, where w is linear in z:
//    x N_x + y N_y + focal N_z + focal D / near w,  x and y in pixels;  ORTHOGRAPHIC, end where w is 0:
//    x N_x + y N_y + focal (D + N_z end) - focal N_z end w
// So it needs of a fragment its place and its depth alone, whatever it is a fragment of: splats are cut where their depth is, on their own planes. Both are by how
// many pixels the place is off the plane, as a length at its depth is seen.
//
// Error: the terms are of up to |x| + |y| + focal + focal |D| / z pixels each, and each is rounded some three times: 2e-7 of their sum, 1e-3 pixels of a picture of
// 1000 and a plane that is about as far from the eye as what it cuts. That moves the cut by as much over the sine of the angle in which it meets the surface.

#extension GL_EXT_control_flow_attributes : require
#include "inc/perturb.glsl"

layout(constant_id = SPEC_PLANES) const uint PLANES = 0;
layout(set = PLANES_SET, binding = PLANES_BINDING, std140) uniform Planes { vec4 planes[MOST_PLANES]; };

// By how many pixels a place is inside.
float inside_px(uint plane, vec2 px, float w)
{
    precise float inside = planes[plane].x * px.x + planes[plane].y * px.y + FORMULA(FORMULA_PLANE, planes[plane].z) + planes[plane].w * w;
    return inside;
}

// Whether a place is beyond some plane, or by less than a part of its depth's term before it.
bool is_cut_off(vec2 px, float w, float hair)
{
    bool cut = false;
    for (uint plane = 0; plane < PLANES; plane++) {
        cut = cut || inside_px(plane, px, w) < hair * abs(planes[plane].w * w);
    }
    return cut;
}

bool is_cut_off(vec2 px, float w)
{
    return is_cut_off(px, w, 0.0);
}

// Whether all of a splat is beyond a plane: where its center is so by more than the splat is long, both as they are seen at the center's depth. A ramp (tile/clip.glsl)
// reaches less than a pixel farther in the image, which is less than as far again of what a filter has widened; the filter itself less than 2 pixels.
bool is_wholly_cut_off(vec2 center_px, float w, float length_px)
{
    bool cut = false;
    for (uint plane = 0; plane < PLANES; plane++) {
        cut = cut || inside_px(plane, center_px, w) < -2.0 * length_px - 16.0;
    }
    return cut;
}

// What planes do to a surface in a box of pixels, where its depth is w in the middle and changes by w_per_px: x, some cuts off all of it; y, some may cut it. Half a ramp
// (tile/clip.glsl) is less than a pixel. What is no number may be cut.
bvec2 cut_in_box(vec2 middle_px, vec2 half_px, float w, vec2 w_per_px)
{
    bvec2 cut = bvec2(false);
    for (uint plane = 0; plane < PLANES; plane++) {
        vec2 per_px = planes[plane].xy + planes[plane].w * w_per_px;
        float reach = dot(abs(per_px), half_px) + length(per_px) + 0.0625;
        float inside = inside_px(plane, middle_px, w);
        cut = bvec2(cut.x || inside < -reach, cut.y || !(inside > reach));
    }
    return cut;
}
