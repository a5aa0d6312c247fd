// Marks the splats that may be seen: of levels of detail those of the level that is drawn (inc/levels.glsl); not those that face away where such are not drawn, nor those outside of the view, told by
// a sphere around them (inc/list.glsl).
//
// Whoever projects a marked splat decides anew, and exactly (mapping.glsl): what is left out here must be what all of them leave out, and
// what is in doubt is marked. Facing is the sign of n . p, and in doubt where rounding could turn a sum of three products: 3 roundings
// of 6e-8 and what f32 left of the center, or a product below f32. A sum rounds in the order of what is added: p_z + 2 R < near here is
// p_z + depth radius < near there, whose unit is a power of two.
//
// Outside: all points of a splat are within its radius R of its center, however skew its vectors are (R is the larger singular value of
// the two). A point p + d is seen (d_x - c_x d_z) / (p_z + d_z) from the center's image c, which is R sqrt(1 + c_x^2) / (p_z - R) at
// most: where 2 R <= p_z / 4, less than 2 R (1 + |c_x|) / p_z by 7/16 of that. An affine image reaches R sqrt(1 + c_x^2) / p_z.
// A filter makes of half an axis l at most sqrt(l^2 + h^2) <= l + h, at the center's depth, p_z / (p_z - R) <= 8/7 of it where
// the splat is nearest; that of adjust_paper.glsl may make both h long in one direction, 8/7 sqrt(2) h: below 2 h, the more so as the
// image ends half a pixel beyond its last pixel's center, and that a box is larger by its margin. No filter makes a splat deeper.
// Parallel rays show a splat within R of its center, filters aside. Nor those that a plane cuts off wholly. Any other splat is marked. So is NaN, which no comparison leaves out.
#version 460
#include "inc/setup.glsl"
#include "inc/list.glsl"
#include "inc/levels.glsl"
#include "inc/outside.glsl"
#define PLANES_SET 1
#define PLANES_BINDING BIND_LIST_PLANES
#include "inc/planes.glsl"

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) writeonly buffer Bits { uint visible_bits[]; };

// Of one in front of the eye, by a ball around it.
bool is_beyond_planes(vec3 p, float radius)
{
    bool in_front = ORTHOGRAPHIC || 2.0 * radius <= 0.25 * p.z;
    float divisor = ORTHOGRAPHIC ? 1.0 : p.z;
    float w = ORTHOGRAPHIC ? 1.0 - p.z / frame.near : frame.near / p.z;
    return in_front && is_wholly_cut_off(p.xy / divisor * frame.focal_px, w, 2.0 * radius / divisor * frame.focal_px);
}

// `ray`: through the center, in the axes of local space.
bool faces_away(vec3 n, vec3 ray)
{
    vec3 parts = n * ray;
    float doubt = 1e-6 * (abs(parts.x) + abs(parts.y) + abs(parts.z)) + 1e-36;
    return parts.x + parts.y + parts.z > doubt;
}

bool may_be_seen(uint index)
{
    Stored stored = load_stored(index);
    if (SPARSE && stored.position_radius.w < 0.0) {
        return false;
    }
    FromEye d = from_eye(stored.position_radius.xyz, stored.position_low);
    vec3 p = center_of(stored.position_radius.xyz, d);
    float radius = frame.view_from_local_scale * stored.position_radius.w;
    vec3 ray = ORTHOGRAPHIC ? frame.view_from_local_z.xyz : d.high;
    if (PLANES > 0 && is_beyond_planes(p, radius)) {
        return false;
    }
    return !(CULL_BACKFACES && faces_away(normal_of(stored), ray)) && !is_outside(p, 2.0 * radius, visible_rows);
}

void main()
{
    uint word = LIST_INVOCATION;
    if (word >= words_of_chunk()) {
        return;
    }
    uint block = block_of(word);
    uint first = first_splat_of(block, word);
    uint end = min(first + WORD, frame.splat_count);
    uint all = first < end ? 0xffffffffu >> (WORD - (end - first)) : 0;
    uint bits = all;
    if (LEVELS != LEVELS_NONE && all != 0 && !is_known(block, ALL_OF_LEVEL)) {
        bits = bits_of_level(first / WORD);
    }
    // All invocations of a vector are in one block, so that it ends here where there is nothing to find.
    // Lists have room for those that are there, and no more.
    for (uint index = !SPARSE && is_known(block, ALL_VISIBLE) ? end : first; index < end; index++) {
        uint bit = 1u << (index - first);
        if ((bits & bit) != 0 && !may_be_seen(index)) {
            bits &= ~bit;
        }
    }
    visible_bits[first_word_of_chunk() + word] = bits;
}
