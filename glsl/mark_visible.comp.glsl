// Marks the splats that may be seen: not those that face away where such are not drawn, nor those outside of the view, told by
// a sphere around them (inc/list.glsl).
//
// Whoever projects a marked splat decides anew, and exactly: what is left out here must be what all of them leave out. Facing is the
// same expression as theirs (mapping.glsl), which nothing may contract. Outside: all points of a splat are within r = sqrt(2) R
// of its center (R the larger radius; the root for skew axes). Where 2 R <= p_z / 4, its image reaches at most
// r (1 + |c|) / (p_z - r) < 2 R (1 + |c|) / p_z from its center's image c, an affine image less, and a filter adds up to
// 1.2 of its radius; but that of adjust_paper.glsl may add any depth. Any other splat is marked. So is NaN, which no comparison
// leaves out.
#version 460
#include "inc/setup.glsl"
#include "inc/list.glsl"

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) writeonly buffer Bits { uint visible_bits[]; };

bool is_outside(vec3 p, float radius, float near)
{
    float reach = 2.0 * radius;
    if (p.z + reach < near) {
        return true;
    }
    if (FILTER == FILTER_ADJUST_PAPER || !(reach <= 0.25 * p.z)) {
        return false;
    }
    vec2 c = p.xy / p.z;
    vec2 away = reach / p.z * (1.0 + abs(c)) + 2.0 * frame.filter_radius;
    vec2 low_px = vec2(0.0, BAND_ROW * visible_rows.x);
    vec2 high_px = vec2(frame.size_px.x, min(frame.size_px.y, BAND_ROW * visible_rows.y));
    vec2 low = (low_px - 0.5 * frame.size_px) / frame.focal_px;
    vec2 high = (high_px - 0.5 * frame.size_px) / frame.focal_px;
    return any(lessThan(c, low - away)) || any(greaterThan(c, high + away));
}

bool may_be_seen(uint index)
{
    Splat splat = load_splat(index);
    bool left_out = CULL_BACKFACES && splat.det > 0.0;
    return !left_out && !is_outside(splat.p, splat.radius, frame.near * splat.unit);
}

void main()
{
    uint word = LIST_INVOCATION;
    if (word >= words_of_chunk()) {
        return;
    }
    uint first = first_splat_of(word);
    uint end = min(first + WORD, frame.splat_count);
    bool all_visible = is_all_visible(word);
    uint bits = all_visible && first < end ? 0xffffffffu >> (WORD - (end - first)) : 0;
    // All invocations of a vector are in one block, so that it ends here where there is nothing to find.
    for (uint index = all_visible ? end : first; index < end; index++) {
        bits |= may_be_seen(index) ? 1u << (index - first) : 0u;
    }
    visible_bits[first_word_of_chunk() + word] = bits;
}
