// Lists the marked splats of a chunk (inc/list.glsl), each at the place that is the number of marked ones before it; and how they are
// drawn as points, or projected. Or, LARGE_LIST, drawn as quads.
#version 460
#include "inc/frame.glsl"
#include "inc/list.glsl"

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) readonly buffer Bits { uint marked_bits[]; };
layout(set = 1, binding = BIND_LIST_STARTS, std430) readonly buffer Starts { uint starts[]; };
layout(set = 1, binding = BIND_LIST_ITEMS, std430) writeonly buffer Items { uint items[]; };
// VkDrawIndexedIndirectCommand: the list is the index buffer. VkDispatchIndirectCommand of workgroups of PROJECT_GROUP_SIZE. Of large
// ones VkDrawIndirectCommand. Eight words a chunk.
layout(set = 1, binding = BIND_LIST_ARGUMENTS, std430) writeonly buffer Arguments { uvec4 list_arguments[]; };

void main()
{
    uint word = LIST_INVOCATION;
    uint words = words_of_chunk();
    if (word >= words) {
        return;
    }
    uint first = first_word_of_chunk();
    uint first_splat = first_splat_of(block_of(word), word);
    uint place = starts[first + word];
    for (uint bits = marked_bits[first + word]; bits != 0; bits &= bits - 1) {
        items[place] = first_splat + findLSB(bits);
        place++;
    }
    if (word == 0) {
        uint start = starts[first];
        uint count = starts[first + words] - start;
        uvec2 groups = rows_of_groups((count + PROJECT_GROUP_SIZE - 1) / PROJECT_GROUP_SIZE);
        list_arguments[2 * CHUNK] = LARGE_LIST ? uvec4(4, count, 0, 0) : uvec4(count, 1, start, 0);
        list_arguments[2 * CHUNK + 1] = LARGE_LIST ? uvec4(0) : uvec4(0, groups, 1);
    }
}
