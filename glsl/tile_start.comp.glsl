// Where the list of each bin starts: the exclusive prefix sums of the totals, in place; the tiles that have splats, in
// order, and runs of them along rows; and the arguments of all that is dispatched and drawn by them. One workgroup, each
// invocation a range of bins.
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

shared uvec4 sums[LANES];

// Entries; tiles with some, with too many; runs that begin. `inside`: the tile before is of the same run.
uvec4 counted(uint bin, uint entries, bool inside)
{
    bool tile = bin < push.tile_count && entries > 0;
    return uvec4(entries, tile ? 1 : 0, tile && entries > PART_LENGTH ? 1 : 0, tile && !inside ? 1 : 0);
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
    uint each = (push.bin_count + LANES - 1) / LANES;
    uint first = lane * each;
    uint end = min(first + each, push.bin_count);
    uvec4 own = uvec4(0);
    bool inside = false; // each invocation's first run begins anew
    for (uint bin = first; bin < end; bin++) {
        inside = inside && bin % push.tiles_x != 0;
        uvec4 more = counted(bin, starts[bin], inside);
        own += more;
        inside = more.y > 0;
    }
    sums[lane] = own;
    barrier();
    uvec4 before = uvec4(0);
    for (uint i = 0; i < lane; i++) {
        before += sums[i];
    }
    inside = false;
    uint run_first = 0;
    for (uint bin = first; bin < end; bin++) {
        inside = inside && bin % push.tiles_x != 0;
        uint entries = starts[bin];
        uvec4 more = counted(bin, entries, inside);
        starts[bin] = before.x;
        if (more.y > 0) {
            non_empty_tiles[before.y] = bin;
        }
        if (more.z > 0) {
            overflow_tiles[before.z] = bin;
        }
        before += more;
        inside = more.y > 0;
        if (more.y > 0) {
            run_first = more.w > 0 ? bin : run_first;
            tile_runs[before.w - 1] = uvec2(push.first_tile + run_first, bin + 1 - run_first);
        }
        if (bin >= push.tile_count) {
            draw_quads(ARGUMENTS_CHUNKS + 4 * (bin - push.tile_count), entries, before.x - entries);
        }
    }
    if (lane == LANES - 1) {
        starts[push.bin_count] = before.x;
        starts[STARTS_TILES] = before.y;
        starts[STARTS_OVERFLOW] = before.z;
        dispatch(ARGUMENTS_TILES, before.y);
        dispatch(ARGUMENTS_OVERFLOW, before.z);
        draw_quads(ARGUMENTS_QUADS, before.w, 0);
    }
}
