// Marks the splats that may be seen: not those that face away where such are not drawn, nor those outside of the view, told by
// a sphere around them. One invocation a word of bits, so that nothing has to be handed on.
//
// Whoever sets a kept splat up decides anew, and exactly: what is left out here must be what all of them leave out. Facing is the
// same expression as theirs (mapping.glsl), which nothing may contract. Outside: all points of a splat are within r = sqrt(2) R
// of its center (R the larger radius; the root for skew axes). Where 2 R <= p_z / 4, its image reaches at most
// r (1 + |c|) / (p_z - r) < 2 R (1 + |c|) / p_z from its center's image c, an affine image less, and a filter adds up to
// 1.2 of its radius; but that of adjust_paper.glsl may add any depth. Any other splat is kept. So is NaN, which no comparison
// leaves out.
#version 460
#include "inc/setup.glsl"
#include "inc/groups.glsl"
#include "inc/kept.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) writeonly buffer KeptBits { uint kept_bits[]; };

bool is_outside(vec3 p, float radius)
{
    float reach = 2.0 * radius;
    if (p.z + reach < frame.near) {
        return true;
    }
    if (FILTER == FILTER_ADJUST_PAPER || !(reach <= 0.25 * p.z)) {
        return false;
    }
    vec2 c = abs(p.xy) / p.z;
    vec2 edge = 0.5 * frame.size_px / frame.focal_px;
    return any(greaterThan(c - edge, reach / p.z * (1.0 + c) + 2.0 * frame.filter_radius));
}

bool may_be_seen(uint index)
{
    Splat splat = load_splat(index);
    bool left_out = CULL_BACKFACES && dot(splat.normal, splat.p) > 0.0;
    return !left_out && !is_outside(splat.p, splat.radius);
}

void main()
{
    uint word = GROUP_NUMBER * 64 + gl_LocalInvocationID.x;
    if (word >= words_of_chunk()) {
        return;
    }
    uint bits = 0;
    for (uint i = 0; i < WORD; i++) {
        uint index = word * WORD + i;
        bool kept = may_be_seen(min(index, frame.splat_count - 1)) && index < frame.splat_count;
        bits |= kept ? 1u << i : 0u;
    }
    kept_bits[first_word_of_chunk() + word] = bits;
}
