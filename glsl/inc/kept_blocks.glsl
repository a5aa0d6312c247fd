// The blocks in which kept splats are looked for (kept.glsl): not those that face away, nor those elsewhere. Before them the rows of
// tiles that splats are looked for in: the first, and that behind the last. KEPT_BLOCKS is the binding in set 1.

#define ALL_KEPT 0x80000000u // beside a block's number: the host knows that none is to be left out

layout(set = 1, binding = KEPT_BLOCKS, std430) readonly buffer KeptBlocks {
    uvec2 kept_rows;
    uint kept_blocks[];
};

uint block_of(uint word)
{
    return kept_blocks[frame.first_record / BLOCK_SPLATS + word / BLOCK_WORDS];
}

bool is_all_kept(uint word)
{
    return (block_of(word) & ALL_KEPT) != 0;
}

// The splat of the first bit of one of the chunk's words.
uint first_splat_of(uint word)
{
    return (block_of(word) & ~ALL_KEPT) * BLOCK_SPLATS + word % BLOCK_WORDS * WORD;
}
