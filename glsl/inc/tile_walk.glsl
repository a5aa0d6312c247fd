// A walk over the records of a segment, in order: `visit(record, bin)` for each bin that a record falls into. One loop, whose
// steps are a record or a further tile, so that invocations with large splats don't hold up the others.

//
// TEXELS: what is only read is texel buffers, as in tile_batch.glsl.

#if defined(TEXELS)
layout(set = 0, binding = 28) uniform utextureBuffer spans;
#define SPAN(record) texelFetch(spans, int(record)).x
#else
layout(set = 0, binding = 4, std430) readonly buffer Spans { uint spans[]; };
#define SPAN(record) spans[record]
#endif

// KEPT: records are those of a list, whose length only the device knows.
#if defined(KEPT)
layout(set = 0, binding = 20, std430) readonly buffer KeptStarts { uint kept_starts[]; };

uint count_of_records()
{
    return kept_starts[kept_starts.length() - 1];
}
#else
uint count_of_records()
{
    return push.record_count;
}
#endif

// Records of the segment.
uint own_records(uint segment, uint record_count)
{
    uint blocks = (record_count + BLOCK - 1) / BLOCK;
    return segment < blocks ? ((blocks - segment - 1) / push.segments + 1) * BLOCK : 0;
}

void walk()
{
    uint segment = gl_GlobalInvocationID.x;
    if (segment >= push.segments) {
        return;
    }
    uint next = push.round_first;
    uint record_count = count_of_records();
    uint end = min(next + push.round_length, own_records(segment, record_count));
    uint record = 0;
    uint left = 0; // tiles of the record that are not visited yet
    uint width = 1;
    uint in_row = 0;
    uint tile = 0;
    while (next < end || left > 0) {
        if (left == 0) {
            record = (next / BLOCK * push.segments + segment) * BLOCK + next % BLOCK;
            next++;
            uint span = record < record_count ? SPAN(record) : SPAN_NONE;
            if (span >= SPAN_CHUNK) {
                if (span != SPAN_NONE) {
                    visit(record, push.tile_count + chunk_of(span));
                }
            } else {
                uvec2 first = first_of(span);
                uvec2 more = more_of(span);
                width = more.x + 1;
                left = width * (more.y + 1);
                in_row = width;
                tile = first.x + first.y * push.tiles_x - push.first_tile;
            }
        }
        if (left > 0) {
            visit(record, tile);
            left--;
            in_row--;
            tile++;
            if (in_row == 0) {
                in_row = width;
                tile += push.tiles_x - width;
            }
        }
    }
}
