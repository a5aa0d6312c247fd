// Lists the kept splats of a chunk, each at the place that is the number of kept ones before it; and how they are drawn as points,
// or set up. One invocation a word of bits.
#version 460
#include "inc/frame.glsl"
#include "inc/groups.glsl"
#include "inc/kept.glsl"
#define KEPT_BLOCKS 4
#include "inc/kept_blocks.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) readonly buffer KeptBits { uint kept_bits[]; };
layout(set = 1, binding = 1, std430) readonly buffer KeptStarts { uint kept_starts[]; };
layout(set = 1, binding = 2, std430) writeonly buffer KeptList { uint kept_list[]; };
// VkDrawIndexedIndirectCommand: the list is the index buffer. VkDispatchIndirectCommand of workgroups of 64.
layout(set = 1, binding = 3, std430) writeonly buffer KeptArguments { uvec4 kept_arguments[2]; };

void main()
{
    uint word = GROUP_NUMBER * 64 + gl_LocalInvocationID.x;
    uint words = words_of_chunk();
    if (word >= words) {
        return;
    }
    uint first = first_word_of_chunk();
    uint first_splat = first_splat_of(word);
    uint place = kept_starts[first + word];
    for (uint bits = kept_bits[first + word]; bits != 0; bits &= bits - 1) {
        kept_list[place] = first_splat + findLSB(bits);
        place++;
    }
    if (word == 0) {
        uint start = kept_starts[first];
        uint count = kept_starts[first + words] - start;
        uvec2 groups = rows_of_groups((count + 63) / 64);
        kept_arguments[0] = uvec4(count, 1, start, 0);
        kept_arguments[1] = uvec4(0, groups, 1);
    }
}
