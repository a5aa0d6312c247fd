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
    // Of the record, what is not visited yet: tiles of a row, and rows behind it.
    uint in_row = 0;
    uint rows = 0;
    uint width = 1;
    uint tile = 0;
    uint row_tile = 0; // the first of the row
    uint outside = 0;
    while (next < end || in_row > 0) {
        if (in_row == 0) {
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
                outside = outside_of(span);
                width = more.x + 1;
                rows = more.y;
                row_tile = first.x + first.y * push.tiles_x - push.first_tile;
                tile = row_tile + (outside & 1);
                in_row = width - bitCount(outside & 3);
            }
        }
        if (in_row > 0) {
            visit(record, tile);
            tile++;
            in_row--;
            if (in_row == 0 && rows > 0) {
                rows--;
                row_tile += push.tiles_x;
                uint out_of_row = rows == 0 ? outside >> 2 : 0;
                tile = row_tile + (out_of_row & 1);
                in_row = width - bitCount(out_of_row);
            }
        }
    }
}
