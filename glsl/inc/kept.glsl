// The splats that may be seen, of all chunks ("kept"). They are looked for block by block, in the blocks of BLOCK_SPLATS splats that the
// host lists (kept_blocks.glsl). A bit each, from `frame.first_record` of each chunk on, which begins a block; how many are kept before
// each word of bits; and their list, chunk by chunk, in the order of each.

#define WORD 32
#define BLOCK_SPLATS 256
#define BLOCK_WORDS (BLOCK_SPLATS / WORD)

uint words_of_chunk()
{
    return frame.listed_blocks * BLOCK_WORDS;
}

uint first_word_of_chunk()
{
    return frame.first_record / WORD;
}
