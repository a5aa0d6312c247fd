// Splats by tiles of the image, in compute: what the passes share. The host's mirror is `TileConstants` in
// src/passes/pipeline/constants.rs; the build compares the offsets.
//
// Each splat is projected once (tile_project.comp.glsl), to a record (tile/splat.glsl) and the rect of tiles that its box touches
// (tile/rect.glsl). Records are dealt out to segments, SEGMENT_BLOCK at a time, so that all segments have as much to do wherever in
// space the records are; a walk goes over a segment, or a piece of it, in order (tile/walk.glsl), first to count what falls into each bin,
// then to list it. So lists are the same in every run: by segment, and in each in the order of the records.
//
// Bins: one a tile; behind them one a chunk, of splats that are drawn by the graphics pipeline (large, or not regular). PARTED: two a tile,
// the second one of splats that clip curves (inc/clip.glsl) or planes (inc/planes.glsl) cut, so that others need not look for either.

#include "inc/config.glsl"
#include "inc/groups.glsl"

struct TileConstants {
    vec2 half_size_px;
    vec2 middle_px;      // where the view's axis meets the image
    uint tiles_x;        // tiles in a row
    uint first_tile;     // of the band of rows that lists are of: all of the image, or as much as memory is meant for
    uint tile_count;     // of the band; all tiles are numbered from its first one
    uint bin_count;      // of tiles, then of chunks
    uint record_count;   // at most; of listed splats, as many as are visible
    uint segments;
    uint segment_length; // records, a multiple of SEGMENT_BLOCK
    uint pieces;         // of a segment, each of which one walk goes over
    uint round_first;    // where in its piece a walk begins
    uint round_length;   // records of one walk
    uint part;           // of an overflow tile, or WHOLE_TILES; of layers
    float focal_px;
    uint surfaces;       // layers of one surface each, in this dispatch; in parts: before it
    uint blends_rest;    // 1: and all that is left
    uint step;           // of a layer in parts
    uint ends;           // 1: the last part
    uint count_bins;     // bins that walks count in: as bin_count, or where a word holds the counts of both lists of a tile, one a tile
    float polygon_reach; // by how much splats are shifted toward polygons at most, for each pixel of their image's size
};
layout(push_constant, std430) uniform Push { TileConstants push; };

layout(constant_id = SPEC_PARTED) const uint PARTED_BY = 0;
const bool PARTED = PARTED_BY != 0;
layout(constant_id = SPEC_CUTS) const bool CUTS = false; // these tiles have some of the second list
const bool CURVED = (PARTED_BY & PARTED_CURVES) != 0;
const uint TILE_BINS = PARTED ? 2 : 1;
#define FIRST_CHUNK_BIN (TILE_BINS * push.tile_count)

// Words behind the starts of bins: how many entries there are in all, how many tiles have some, how many overflow; PARTED: how many have
// clipped ones, which are not among those with some.
#define STARTS_TILES (push.bin_count + 1)
#define STARTS_OVERFLOW (push.bin_count + 2)
#define STARTS_CLIPPED (push.bin_count + 3)

// Where the tile is listed: those with clipped splats from the end on.
uint place_of_tile(bool clipped, uint number)
{
    return clipped ? push.tile_count - 1 - number : number;
}

// PARTED: no list is longer than HALF_COUNT, and a word counts both lists of a tile, the second one in its upper half: to add up counts that are 0 is most of what lists of few splats take.
bool counts_halves()
{
    return push.count_bins < push.bin_count;
}

const uint HALF_COUNT = (1u << HALF_COUNT_BITS) - 1;

// Counts of BIN_GROUP_SIZE walks lie beside each other: they go over the same region at a time, and bins of theirs
// in columns apart would fall on the same lines of a cache.
uint place_of_count(uint walk, uint bin)
{
    return (walk / BIN_GROUP_SIZE * push.count_bins + bin) * BIN_GROUP_SIZE + walk % BIN_GROUP_SIZE;
}
