// Writes the list of large splats in input order: the place of each is the number of large ones before it.
#version 460
#include "inc/frame.glsl"
#include "inc/large.glsl"

layout(local_size_x = BLOCK) in;
layout(set = 1, binding = 1, std430) readonly buffer BlockStarts { uint block_starts[]; };
layout(set = 1, binding = 2, std430) writeonly buffer LargeList { uint large_list[]; };

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= frame.splat_count || !is_large(index)) {
        return;
    }
    uint word = index / 32;
    uint place = block_starts[gl_WorkGroupID.x];
    for (uint i = gl_WorkGroupID.x * (BLOCK / 32); i < word; i++) {
        place += bitCount(large_bits[i]);
    }
    place += bitCount(large_bits[word] & ((1u << (index % 32)) - 1));
    large_list[place] = frame.first_record + index;
}
