// The splats that may be seen, of all chunks ("kept"): a bit each, from `frame.first_record` of each chunk on, which begins a
// word; how many are kept before each word; and their list, chunk by chunk, in the order of each.

#define WORD 32

uint words_of_chunk()
{
    return (frame.splat_count + (WORD - 1)) / WORD;
}

uint first_word_of_chunk()
{
    return frame.first_record / WORD;
}
