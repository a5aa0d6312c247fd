// Lists of splats of a chunk, in input order: of those that may be seen ("visible"), or, LARGE_LIST, of those that are drawn as quads
// ("large"). A bit each; how many come before each word of bits; their numbers. One invocation a word of bits, so that nothing has to
// be handed on.
//
// Visible ones are looked for in the blocks of BLOCK_SPLATS splats that the host lists: not those that face away, nor those elsewhere.
// Before the blocks are the rows of tiles that splats are looked for in: the first, and that behind the last. Bits of all chunks lie
// one behind the other, those of each from `frame.first_record` on, which begins a block. Large ones are looked for in all blocks of a
// chunk, which has bits of its own.

#include "inc/groups.glsl"

layout(constant_id = SPEC_LARGE_LIST) const bool LARGE_LIST = false;

#define WORD 32
#define BLOCK_WORDS (BLOCK_SPLATS / WORD)
#define LIST_INVOCATION (GROUP_NUMBER * LIST_GROUP_SIZE + gl_LocalInvocationID.x)

#if !defined(LIST_BLOCKS)
#define LIST_BLOCKS BIND_LIST_BLOCKS
#endif
layout(set = 1, binding = LIST_BLOCKS, std430) readonly buffer Blocks {
    uvec2 visible_rows;
    uint visible_blocks[];
};

uint words_of_chunk()
{
    return LISTED_BLOCKS * BLOCK_WORDS;
}

uint first_word_of_chunk()
{
    return frame.first_record / WORD;
}

uint block_of(uint word)
{
    return visible_blocks[frame.first_record / BLOCK_SPLATS + word / BLOCK_WORDS];
}

// What the host knows of all splats of a block.
bool is_known(uint word, uint what)
{
    return (block_of(word) & what) != 0;
}

// The splat of the first bit of one of the chunk's words.
uint first_splat_of(uint word)
{
    uint block = LARGE_LIST ? word / BLOCK_WORDS : block_of(word) & ~(ALL_VISIBLE | ALL_OF_LEVEL);
    return block * BLOCK_SPLATS + word % BLOCK_WORDS * WORD;
}
