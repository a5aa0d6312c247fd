// Where the list of each bin starts: the exclusive prefix sums of the totals, in place; the tiles that have splats, in
// order; and the arguments of all that is dispatched and drawn by them. One workgroup, each invocation a range of bins.
#version 460
#include "inc/tiles.glsl"

#define LANES 256

layout(constant_id = 19) const uint PART = 200000; // entries of a tile that one dispatch takes (inc/tiles.glsl)

layout(local_size_x = LANES) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 6, std430) buffer Starts { uint starts[]; };
layout(set = 0, binding = 8, std430) writeonly buffer SeenTiles { uint seen_tiles[]; };
layout(set = 0, binding = 9, std430) writeonly buffer TileArguments { uint arguments[]; };
layout(set = 0, binding = 10, std430) writeonly buffer OverfullTiles { uint overfull_tiles[]; };

shared uvec3 sums[LANES];

// Entries, tiles with some, tiles with too many.
uvec3 counted(uint bin, uint entries)
{
    bool tile = bin < push.tile_count;
    return uvec3(entries, tile && entries > 0 ? 1 : 0, tile && entries > PART ? 1 : 0);
}

void dispatch(uint first, uint groups)
{
    arguments[first] = groups;
    arguments[first + 1] = 1;
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
    uvec3 own = uvec3(0);
    for (uint bin = first; bin < end; bin++) {
        own += counted(bin, starts[bin]);
    }
    sums[lane] = own;
    barrier();
    uvec3 before = uvec3(0);
    for (uint i = 0; i < lane; i++) {
        before += sums[i];
    }
    for (uint bin = first; bin < end; bin++) {
        uint entries = starts[bin];
        uvec3 more = counted(bin, entries);
        starts[bin] = before.x;
        if (more.y > 0) {
            seen_tiles[before.y] = bin;
        }
        if (more.z > 0) {
            overfull_tiles[before.z] = bin;
        }
        if (bin >= push.tile_count) {
            draw_quads(ARGUMENTS_CHUNKS + 4 * (bin - push.tile_count), entries, before.x);
        }
        before += more;
    }
    if (lane == LANES - 1) {
        starts[push.bin_count] = before.x;
        dispatch(ARGUMENTS_SEEN, before.y);
        dispatch(ARGUMENTS_OVERFULL, before.z);
        draw_quads(ARGUMENTS_QUADS, before.y, 0);
    }
}
