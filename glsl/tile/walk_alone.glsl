// One invocation a segment. One loop, whose steps are a record or a further tile, so that invocations with large splats don't hold up the
// others.

layout(local_size_x = BIN_GROUP_SIZE) in;

void visit(uint segment, uint record, uint bin)
{
    bool halves = PARTED && counts_halves();
    bool of_tile = bin < FIRST_CHUNK_BIN;
    uint place = place_of_count(segment, !halves ? bin : of_tile ? bin / TILE_BINS : bin - push.tile_count);
    uint shift = halves && of_tile ? bin % TILE_BINS * HALF_COUNT_BITS : 0;
    uint count = counts[place];
    counts[place] = count + (1u << shift);
    uint before = halves ? count >> shift & HALF_COUNT : count;
#if defined(LISTS)
    list(record, bin, before);
#endif
}

void walk()
{
    uint segment = gl_GlobalInvocationID.x;
    if (segment >= push.segments) {
        return;
    }
    uint next = push.round_first;
    uint record_count = LISTED ? visible_starts[visible_starts.length() - 1] : push.record_count;
    uint end = min(next + push.round_length, own_records(segment, record_count));
    uint record = 0;
    // Of the record, what is not visited yet: tiles of a row, and rows behind it.
    uint in_row = 0;
    uint rows = 0;
    uint width = 1;
    uint tile = 0;
    uint row_tile = 0; // the first of the row
    uint outside = 0;
    uvec2 size = uvec2(0);
    while (next < end || in_row > 0) {
        if (in_row == 0) {
            record = record_at(segment, next);
            next++;
            uint rect = record < record_count ? rect_of(record) : RECT_NONE;
            if (rect >= RECT_CHUNK) {
                if (rect != RECT_NONE) {
                    visit(segment, record, FIRST_CHUNK_BIN + chunk_of(rect));
                }
            } else {
                uvec2 first = first_of(rect);
                uvec2 more = more_of(rect);
                outside = outside_of(rect);
                size = more;
                width = more.x + 1;
                rows = more.y;
                row_tile = first.x + first.y * push.tiles_x - push.first_tile;
                tile = row_tile + (outside & 1);
                in_row = width - bitCount(outside & 3);
            }
        }
        if (in_row > 0) {
            uint bin = tile;
            if (PARTED) {
                uint shift = cell_shift(size);
                bin = bin_of(tile, cells_of(record, size.y - rows >> shift), tile - row_tile >> shift);
            }
            if (!PARTED || bin != NO_BIN) {
                visit(segment, record, bin);
            }
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
