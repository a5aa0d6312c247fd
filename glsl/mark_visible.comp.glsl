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
// Parallel rays show a splat within R of its center, filters aside. Nor those that a plane cuts off wholly. A block that the host has not looked at, of which the device has bounds, is looked at as a whole first: an object that is
// wholly within the view takes the host one look (src/passes/plan/blocks/walk.rs). Any other splat is marked. So is NaN, which no comparison leaves out.
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

// Whether all splats of a block face away, and whether all face the eye, by a ball around their centers and a cone around their normals (src/prepare/block_bounds.rs), from where src/passes/plan/blocks/balls.rs
// derives it of the same bounds. They are behind the colors.
bvec2 faces_of_block(uint block)
{
    uint blocks = (frame.splat_count + BLOCK_SPLATS - 1) / BLOCK_SPLATS;
    uint first = colors.length() - 2 * (blocks - block);
    vec2 xy = unpackHalf2x16(colors[first].x);
    vec2 z_radius = unpackHalf2x16(colors[first].y);
    vec2 axis = unpackHalf2x16(colors[first + 1].x);
    vec2 axis_sine = unpackHalf2x16(colors[first + 1].y);
    vec3 center = vec3(xy, z_radius.x);
    vec3 middle = ORTHOGRAPHIC ? frame.view_from_local_z.xyz : from_eye(center, vec3(0.0)).high;
    vec3 origin = vec3(frame.origin_from_eye[0], frame.origin_from_eye[1], frame.origin_from_eye[2]);
    float distance = dot(abs(middle), vec3(1.0));
    float rounded = 1e-5 * distance + 2e-6 * dot(abs(origin), vec3(1.0));
    float radius = ORTHOGRAPHIC ? 0.0 : frame.view_from_local_scale * z_radius.y + rounded;
    float sine = axis_sine.y;
    float cosine = sqrt(max(1.0 - sine * sine, 0.0)) - 1e-6;
    float squared = dot(middle, middle);
    float tangent = sqrt(max(squared - radius * radius, 0.0));
    float reserve = 4e-6 * distance;
    float sine_of_sum = radius * cosine + tangent * sine + reserve;
    bool known = tangent * cosine - radius * sine > reserve;
    float along = dot(vec3(axis, axis_sine.x), middle);
    return bvec2(known && along > sine_of_sum, known && along < -sine_of_sum);
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
    // Once, where there are bounds. All invocations of a vector are in one block.
    bool all_seen = !SPARSE && is_known(block, ALL_VISIBLE);
    for (uint look = CULL_BACKFACES && is_known(block, HAS_BOUNDS) ? 0 : 1; look < 1; look++) {
        bvec2 faces = faces_of_block(number_of(block));
        bits = faces.x ? 0 : bits;
        all_seen = faces.x || faces.y && is_known(block, ALL_IN_VIEW);
    }
    // So a vector ends here where there is nothing to find.
    // Lists have room for those that are there, and no more.
    for (uint index = all_seen ? end : first; index < end; index++) {
        uint bit = 1u << (index - first);
        if ((bits & bit) != 0 && !may_be_seen(index)) {
            bits &= ~bit;
        }
    }
    visible_bits[first_word_of_chunk() + word] = bits;
}
