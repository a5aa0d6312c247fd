// Where the list of each bin starts: the exclusive prefix sums of the totals, in place; the tiles that have splats, in
// order, and runs of them along rows; and the arguments of all that is dispatched and drawn by them. One workgroup, each
// invocation a range of tiles and chunks.
#version 460
#include "tile/constants.glsl"

#define LANES 256

layout(constant_id = SPEC_PART_LENGTH) const uint PART_LENGTH = 200000;

layout(local_size_x = LANES) in;
layout(set = 0, binding = BIND_STARTS, std430) buffer Starts { uint starts[]; };
layout(set = 0, binding = BIND_NON_EMPTY_TILES, std430) writeonly buffer NonEmptyTiles { uint non_empty_tiles[]; };
layout(set = 0, binding = BIND_ARGUMENTS, std430) writeonly buffer TileArguments { uint arguments[]; };
layout(set = 0, binding = BIND_RUNS, std430) writeonly buffer TileRuns { uvec2 tile_runs[]; };
layout(set = 0, binding = BIND_OVERFLOW_TILES, std430) writeonly buffer OverflowTiles { uint overflow_tiles[]; };

// Entries of a tile or, behind tiles, of a chunk; PARTED: and of those the tile's clipped ones.
uvec2 entries_of(uint item)
{
    if (item >= push.tile_count) {
        return uvec2(starts[item - push.tile_count + FIRST_CHUNK_BIN], 0);
    }
    uint clipped = PARTED ? starts[TILE_BINS * item + 1] : 0;
    return uvec2(starts[TILE_BINS * item] + clipped, clipped);
}

struct Counted {
    uint entries;
    uint tiles; // with some; PARTED: but for those with clipped ones,
    uint clipped; // which are these
    uint overflow;
    uint runs; // that begin
};

shared Counted sums[LANES];

// `inside`: the tile before is of the same run.
void count(inout Counted counted, uint item, uvec2 entries, bool inside)
{
    bool tile = item < push.tile_count && entries.x > 0;
    counted.entries += entries.x;
    counted.tiles += tile && entries.y == 0 ? 1 : 0;
    counted.clipped += tile && entries.y > 0 ? 1 : 0;
    counted.overflow += tile && entries.x > PART_LENGTH ? 1 : 0;
    counted.runs += tile && !inside ? 1 : 0;
}

bool is_in_run(uint item, uvec2 entries)
{
    return item < push.tile_count && entries.x > 0;
}

void dispatch(uint first, uint groups)
{
    uvec2 rows = rows_of_groups(groups);
    arguments[first] = rows.x;
    arguments[first + 1] = rows.y;
    arguments[first + 2] = 1;
}

void draw_quads(uint first, uint count, uint first_instance)
{
    arguments[first] = 4;
    arguments[first + 1] = count;
    arguments[first + 2] = 0;
    arguments[first + 3] = first_instance;
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint items = push.bin_count - FIRST_CHUNK_BIN + push.tile_count;
    uint each = (items + LANES - 1) / LANES;
    uint first = lane * each;
    uint end = min(first + each, items);
    Counted own = Counted(0, 0, 0, 0, 0);
    bool inside = false; // each invocation's first run begins anew
    for (uint item = first; item < end; item++) {
        inside = inside && item % push.tiles_x != 0;
        uvec2 entries = entries_of(item);
        count(own, item, entries, inside);
        inside = is_in_run(item, entries);
    }
    sums[lane] = own;
    barrier();
    Counted at = Counted(0, 0, 0, 0, 0);
    for (uint i = 0; i < lane; i++) {
        at.entries += sums[i].entries;
        at.tiles += sums[i].tiles;
        at.clipped += sums[i].clipped;
        at.overflow += sums[i].overflow;
        at.runs += sums[i].runs;
    }
    inside = false;
    uint run_first = 0;
    for (uint item = first; item < end; item++) {
        inside = inside && item % push.tiles_x != 0;
        uvec2 entries = entries_of(item);
        Counted before = at;
        count(at, item, entries, inside);
        inside = is_in_run(item, entries);
        if (item >= push.tile_count) {
            uint chunk = item - push.tile_count;
            starts[FIRST_CHUNK_BIN + chunk] = before.entries;
            draw_quads(ARGUMENTS_CHUNKS + 4 * chunk, entries.x, before.entries);
            continue;
        }
        starts[TILE_BINS * item] = before.entries;
        if (PARTED) {
            starts[TILE_BINS * item + 1] = at.entries - entries.y;
        }
        if (at.overflow > before.overflow) {
            overflow_tiles[before.overflow] = item;
        }
        if (inside) {
            bool clipped = entries.y > 0;
            non_empty_tiles[place_of_tile(clipped, clipped ? before.clipped : before.tiles)] = item;
            run_first = at.runs > before.runs ? item : run_first;
            tile_runs[at.runs - 1] = uvec2(push.first_tile + run_first, item + 1 - run_first);
        }
    }
    if (lane == LANES - 1) {
        starts[push.bin_count] = at.entries;
        starts[STARTS_TILES] = at.tiles;
        starts[STARTS_OVERFLOW] = at.overflow;
        dispatch(ARGUMENTS_TILES, at.tiles);
        dispatch(ARGUMENTS_OVERFLOW, at.overflow);
        draw_quads(ARGUMENTS_QUADS, at.runs, 0);
        if (PARTED) {
            starts[STARTS_CLIPPED] = at.clipped;
            dispatch(ARGUMENTS_CLIPPED, at.clipped);
        }
    }
}
