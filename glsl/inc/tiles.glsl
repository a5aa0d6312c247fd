// Splats by tiles of the image, in compute: what the passes share. The host's mirror is `TileConstants` in
// src/passes/constants.rs; the build compares the offsets.
//
// A tile is TILE_WIDTH pixels wide and as many high; or half as many, where splats are small (TILE_HEIGHT). Each splat is set up
// once, to a record (tile_record.glsl) and a *span*, the tiles that its box touches. Records are dealt out to segments, BLOCK at a
// time, so that all segments have as much to do wherever in space the records are; one invocation walks over one segment, in order
// (tile_walk.glsl), first to count what falls into each bin, then to list it. So lists need no atomics and are the same in every
// run: by segment, and in each in the order of the records.
//
// Bins: one a tile; behind them one a chunk, of splats that are drawn by the graphics pipeline (large, or not regular).

#include "inc/groups.glsl"

#define TILE_WIDTH 8

// Pixels of the rows that a band has, each a row of tiles or two.
#define BAND_ROW 8

#define BLOCK 32

// Tiles in a row of an image that holds overfull ones alone.
#define SLOTS_IN_ROW 256

// Words behind the starts of bins: how many entries there are in all, how many tiles have some, how many are overfull.
#define STARTS_SEEN (push.bin_count + 1)
#define STARTS_OVERFULL (push.bin_count + 2)

// Words of TileArguments; src/passes/tiles/mod.rs names the same.
#define ARGUMENTS_SEEN 0      // VkDispatchIndirectCommand: tiles with splats; the overfull end at once
#define ARGUMENTS_OVERFULL 4  // VkDispatchIndirectCommand: tiles with more splats than one dispatch takes
#define ARGUMENTS_QUADS 8     // VkDrawIndirectCommand: a quad for each run of tiles with splats
#define ARGUMENTS_CHUNKS 12   // VkDrawIndirectCommand a chunk: a quad for each splat that is drawn by the graphics pipeline

struct TileConstants {
    vec2 half_size_px;
    uint tiles_x;        // tiles in a row
    uint first_tile;     // of the band of rows that lists are of: all of the image, or as much as memory is meant for
    uint tile_count;     // of the band; all tiles are numbered from its first one
    uint bin_count;      // tiles, then chunks
    uint record_count;   // at most; of culled splats, as many as are kept
    uint segments;
    uint segment_length; // records, a multiple of BLOCK
    uint round_first;    // where in its segment a walk begins
    uint round_length;   // records of one walk
    uint part;           // of an overfull tile; of layers
    float focal_px;
    uint surfaces;       // layers of one surface each, in this dispatch; in parts: before it
    uint blends_rest;    // 1: and all that is left
    uint step;           // of a layer in parts
    uint ends;           // 1: the last part
};

// Entries of a tile that one dispatch takes are PART: llvmpipe ends a shader's loops after 65535 iterations, silently.

// Counts of the segments of one workgroup lie beside each other: they walk over the same region at a time, and bins of theirs
// in columns apart would fall on the same lines of a cache.
#define WALKERS 8
#define PLACE_OF_COUNT(segment, bin) (((segment) / WALKERS * push.bin_count + (bin)) * WALKERS + (segment) % WALKERS)

// A span: tile of the first corner, x and y in PLACE_BITS each, then how many tiles more, in half of the bits that are left for each;
// those along x are below three quarters of what these hold. The last quarter is of small spans, whose tiles have 3 bits less each, and
// 4 bits for those in the corners that it does not touch (tile_corners.glsl).
// Spans that would reach beyond all places mean other things: from SPAN_CHUNK on, drawn by the graphics pipeline, of the chunk in
// the last bits; all ones, not seen.
layout(constant_id = 24) const uint PLACE_BITS = 11;
const uint MORE_BITS = 16 - PLACE_BITS;
const uint LAST_PLACE = (1u << PLACE_BITS) - 1;
const uint MOST_MORE = 3 * (1u << (MORE_BITS - 2)) - 1;
const uint SMALL_BITS = MORE_BITS - 3;
const uint MOST_MORE_OF_SMALL = (1u << SMALL_BITS) - 1;
const uint SMALL = 3u << (2 * MORE_BITS - 2);
const uint SPAN_CHUNK = 0xffffe000u;
const uint SPAN_NONE = 0xffffffffu;

// `outside`: bits of the corners that it does not touch: the first tile, the last of the first row, and both of the last row.
uint span_from(uvec2 first, uvec2 more, uint outside)
{
    bool small = max(more.x, more.y) <= MOST_MORE_OF_SMALL;
    uint size = small ? SMALL | outside << (2 * SMALL_BITS) | more.x << SMALL_BITS | more.y : more.x << MORE_BITS | more.y;
    return first.x | first.y << PLACE_BITS | size << (2 * PLACE_BITS);
}

uvec2 first_of(uint span)
{
    return uvec2(span, span >> PLACE_BITS) & LAST_PLACE;
}

uvec2 more_of(uint span)
{
    uint size = span >> (2 * PLACE_BITS);
    return size >= SMALL ? uvec2(size >> SMALL_BITS, size) & MOST_MORE_OF_SMALL
                         : uvec2(size >> MORE_BITS, size & ((1u << MORE_BITS) - 1));
}

uint outside_of(uint span)
{
    uint size = span >> (2 * PLACE_BITS);
    return size >= SMALL ? (size >> (2 * SMALL_BITS)) & 15 : 0;
}

uint chunk_of(uint span)
{
    return span - SPAN_CHUNK;
}
