// One workgroup a piece of a segment: what comes before a record in a bin is as if one invocation walked over all of it, so that lists are the same.
//
// Records are taken WALK_LANES at a time. Prefix sums of how many tiles their rects have tell which invocation does which tile of which record, so that large
// splats are shared out, too. How many come before a record in a bin is what was counted before these records, and how many of these that are before it fall
// into the bin, by a test of each: few operations, but 32 times for each entry.

#define WALK_LANES 64

layout(local_size_x = WALK_LANES) in;

shared uint shared_rects[WALK_LANES];
shared uvec4 shared_spans[WALK_LANES]; // of the rect: its first tile, and how many more there are; of one that means something else, no tile
shared uint shared_cells[CELLS_ALONG * WALK_LANES]; // PARTED: rows of the rect, as cells_of has them
shared uint tile_ends[WALK_LANES];     // tiles of all rects up to this one

// Bins of a rect, with those in its corners and cells where nothing of the splat is.
uint bins_of(uint rect)
{
    uvec2 more = more_of(rect);
    return rect == RECT_NONE ? 0 : rect >= RECT_CHUNK ? 1 : (more.x + 1) * (more.y + 1);
}

// The bin of a tile of the rect, if the record falls into one there. `at`: the tile, from the first one.
uint bin_in(uint place, uvec2 at)
{
    uvec4 span = shared_spans[place];
    uint corner = (at.x == 0 ? 5u : 0u) | (at.x == span.z ? 10u : 0u);
    uint row = (at.y == 0 ? 3u : 0u) | (at.y == span.w ? 12u : 0u);
    if ((outside_of(shared_rects[place]) & corner & row) != 0) {
        return NO_BIN;
    }
    uvec2 tile = span.xy + at;
    uint number = tile.x + tile.y * push.tiles_x - push.first_tile;
    if (PARTED) {
        uvec2 cell = at >> cell_shift(span.zw);
        return bin_of(number, shared_cells[cell.y * WALK_LANES + place], cell.x);
    }
    return number;
}

// A record of those at hand in a tile.
struct Visited {
    uint place; // the record's
    uint bin;
    uvec2 tile; // of no chunk
};

Visited visited(uint number)
{
    uint place = 0;
    [[unroll]] for (uint reach = WALK_LANES / 2; reach > 0; reach /= 2) {
        place += tile_ends[place + reach - 1] <= number ? reach : 0;
    }
    uint rect = shared_rects[place];
    if (rect >= RECT_CHUNK) {
        return Visited(place, FIRST_CHUNK_BIN + chunk_of(rect), uvec2(0));
    }
    uint in_rect = number - (place > 0 ? tile_ends[place - 1] : 0);
    uint width = shared_spans[place].z + 1;
    uvec2 at = uvec2(in_rect % width, in_rect / width);
    return Visited(place, bin_in(place, at), shared_spans[place].xy + at);
}

// How many of the records at hand fall into its bin before it.
uint before_in_bin(Visited visited)
{
    uint before = 0;
    uint rect = shared_rects[visited.place];
    if (rect >= RECT_CHUNK) {
        for (uint place = 0; place < visited.place; place++) {
            before += shared_rects[place] == rect ? 1 : 0;
        }
        return before;
    }
    for (uint place = 0; place < visited.place; place++) {
        uvec4 span = shared_spans[place];
        uvec2 at = visited.tile - span.xy; // far beyond all where the tile is before the first one
        if (at.x <= span.z && at.y <= span.w) {
            before += bin_in(place, at) == visited.bin ? 1 : 0;
        }
    }
    return before;
}

// The tiles of rects up to each; those of all.
uint sum_tiles(uint own)
{
    uint lane = gl_LocalInvocationIndex;
    tile_ends[lane] = own;
    barrier();
    for (uint reach = 1; reach < WALK_LANES; reach *= 2) {
        uint before = lane >= reach ? tile_ends[lane - reach] : 0;
        barrier();
        tile_ends[lane] += before;
        barrier();
    }
    return tile_ends[WALK_LANES - 1];
}

void walk()
{
    uint piece = GROUP_NUMBER;
    uint segment = piece / push.pieces;
    if (segment >= push.segments) {
        return;
    }
    uint record_count = LISTED ? visible_starts[visible_starts.length() - 1] : push.record_count;
    uint of_segment = own_records(segment, record_count);
    uint length = (of_segment + push.pieces - 1) / push.pieces;
    uint first = piece % push.pieces * length;
    uint end = min(min(first + push.round_first + push.round_length, first + length), of_segment);
    for (uint base = first + push.round_first; base < end; base += WALK_LANES) {
        uint lane = gl_LocalInvocationIndex;
        uint record = record_at(segment, base + lane);
        uint rect = base + lane < end && record < record_count ? rect_of(record) : RECT_NONE;
        barrier(); // those before were read
        shared_rects[lane] = rect;
        shared_spans[lane] = rect < RECT_CHUNK ? uvec4(first_of(rect), more_of(rect)) : uvec4(uvec2(~0u), uvec2(0));
        if (PARTED) {
            [[unroll]] for (uint row = 0; row < CELLS_ALONG; row++) {
                shared_cells[row * WALK_LANES + lane] = rect < RECT_CHUNK ? cells_of(record, row) : 0;
            }
        }
        uint all = sum_tiles(bins_of(rect));
#if defined(LISTS)
        for (uint number = lane; number < all; number += WALK_LANES) {
            Visited visited = visited(number);
            if (visited.bin != NO_BIN) {
                uint before = counts[place_of_count(piece, visited.bin)] + before_in_bin(visited);
                list(record_at(segment, base + visited.place), visited.bin, before);
            }
        }
        memoryBarrierBuffer();
        barrier();
#endif
        for (uint number = lane; number < all; number += WALK_LANES) {
            uint bin = visited(number).bin;
            if (bin != NO_BIN) {
                atomicAdd(counts[place_of_count(piece, bin)], 1);
            }
        }
        memoryBarrierBuffer();
        barrier();
    }
}
