// Lists of splats of a chunk, in input order: of those that may be seen ("visible"), or, LARGE_LIST, of those that are drawn as quads
// ("large"). A bit each; how many come before each word of bits; their numbers. One invocation a word of bits, so that nothing has to
// be handed on.
//
// Visible ones are looked for in blocks of BLOCK_SPLATS splats, those that the host lists: not those that face away, nor those elsewhere. It lists runs of blocks, of
// all chunks one behind the other, each by the place of its first block among all that are listed, and the number of that block in its chunk. Before the runs are the rows
// of tiles that splats are looked for in, the first, and that behind the last; and how many runs there are. Behind the runs is where each chunk's blocks begin among all, and where those of the last one end. Bits of all chunks lie one behind the other, those of each from
// `frame.first_record` on, which begins a block. Beside a block's number are what the host knows of all its splats, and whether the device has bounds by which it may know more (HAS_BOUNDS). Large ones are looked for in all blocks of a chunk, which has bits of its own.

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
    uint visible_runs;
    uint visible_words[]; // two a run; then one a chunk, and the end
};

uint words_of_chunk()
{
    return LISTED_BLOCKS * BLOCK_WORDS;
}

uint first_word_of_chunk()
{
    return frame.first_record / WORD;
}

// The first word of the chunk with this number; of the number behind the last one, the end.
uint first_word_of(uint chunk)
{
    return visible_words[2 * visible_runs + chunk] * BLOCK_WORDS;
}

// The block of one of the chunk's words, in its chunk, with what the host knows of all of its splats.
uint block_of(uint word)
{
    if (LARGE_LIST) {
        return word / BLOCK_WORDS;
    }
    uint place = frame.first_record / BLOCK_SPLATS + word / BLOCK_WORDS;
    // The last run that begins no later.
    uint run = 0;
    for (uint end = visible_runs; end - run > 1;) {
        uint middle = (run + end) / 2;
        if (visible_words[2 * middle] <= place) {
            run = middle;
        } else {
            end = middle;
        }
    }
    return visible_words[2 * run + 1] + (place - visible_words[2 * run]);
}

bool is_known(uint block, uint what)
{
    return (block & what) != 0;
}

// Of what is known of a block, its number alone.
uint number_of(uint block)
{
    return block & HAS_BOUNDS - 1;
}

// The splat of the first bit of one of the chunk's words, which is of this block.
uint first_splat_of(uint block, uint word)
{
    return number_of(block) * BLOCK_SPLATS + word % BLOCK_WORDS * WORD;
}
