// Splats by tiles of the image, in compute: what the passes share. The host's mirror is `TileConstants` in
// src/passes/constants.rs; the build compares the offsets.
//
// A tile is TILE x TILE pixels. Each splat is set up once, to a record (tile_batch.glsl) and a *span*, the tiles that its box
// touches. Records are cut into segments; one invocation walks over one segment, in order (tile_walk.glsl), first to count
// what falls into each bin, then to list it. So lists are in input order without atomics, and the same in every run.
//
// Bins: one a tile; behind them one a chunk, of splats that are drawn by the graphics pipeline (large, or not regular).

#define TILE 8

// Words of TileArguments; src/passes/tiles/mod.rs names the same.
#define ARGUMENTS_SEEN 0      // VkDispatchIndirectCommand: tiles with splats, but the overfull
#define ARGUMENTS_OVERFULL 4  // VkDispatchIndirectCommand: tiles with more splats than one dispatch takes
#define ARGUMENTS_QUADS 8     // VkDrawIndirectCommand: a quad for each tile with splats
#define ARGUMENTS_CHUNKS 12   // VkDrawIndirectCommand a chunk: a quad for each splat that is drawn by the graphics pipeline

struct TileConstants {
    vec2 half_size_px;
    uint tiles_x;        // tiles in a row
    uint tile_count;
    uint bin_count;      // tiles, then chunks
    uint record_count;
    uint segment_length; // records
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

// A span: tile of the first corner, x and y in 13 bits each, then how many tiles more, 3 bits each. Spans that would
// reach beyond 2^13 tiles mean other things: from SPAN_CHUNK on, drawn by the graphics pipeline, of the chunk in the last
// 13 bits; all ones, not seen.
const uint SPAN_CHUNK = 0xffffe000u;
const uint SPAN_NONE = 0xffffffffu;
const uint SPAN_LOW = 0x1fffu;
