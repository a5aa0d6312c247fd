// Lists the marked splats of all chunks (inc/list.glsl), each at the place that is the number of marked ones before it; and how those of each chunk are
// drawn as points, or projected. It is told the number of chunks in the place of a chunk's own, for one dispatch is for all. Or, LARGE_LIST, those of one chunk, drawn as quads.
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

// Of the splats of a chunk, whose bits are those from one word on, up to another.
void write_arguments(uint chunk, uint first, uint end)
{
    uint start = starts[first];
    uint count = starts[end] - start;
    uvec2 groups = rows_of_groups((count + PROJECT_GROUP_SIZE - 1) / PROJECT_GROUP_SIZE);
    list_arguments[2 * chunk] = LARGE_LIST ? uvec4(4, count, 0, 0) : uvec4(count, 1, start, 0);
    list_arguments[2 * chunk + 1] = LARGE_LIST ? uvec4(0) : uvec4(0, groups, 1);
}

void main()
{
    uint word = LIST_INVOCATION;
    uint words = LARGE_LIST ? words_of_chunk() : marked_bits.length();
    if (word >= words) {
        return;
    }
    uint first_splat = first_splat_of(block_of(word), word);
    uint place = starts[word];
    for (uint bits = marked_bits[word]; bits != 0; bits &= bits - 1) {
        items[place] = first_splat + findLSB(bits);
        place++;
    }
    if (LARGE_LIST) {
        if (word == 0) {
            write_arguments(0, 0, words);
        }
    } else if (word < CHUNK) {
        // There are no more chunks than blocks.
        write_arguments(word, first_word_of(word), first_word_of(word + 1));
    }
}
