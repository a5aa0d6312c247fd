// The invocations of a workgroup, which draw a tile, and how they come by its splats: COLUMN, for CPUs, or a pixel each, for GPUs,
// whose vectors are longer than 8. Both have:
//
// TILE_HEIGHT: pixels of the tile's columns; ROWS: pixels of an invocation at most; OWN_ROWS: in this pipeline; OWN_ROW: the row of
// its first one.
// LANES: invocations of a tile; OWN_LANE: the invocation's number.
// LOADED: splats that are loaded at once, splat i by invocation i of them; AT_ONCE: splats that are held at a time; CLIPPED_BATCH: splats
// of one step of loops over those that curves cut.
// record0 to record3: the quarters of a record. CLIPS: load_curves: loads the clip curves of what an invocation has loaded; curve_of: one of
// them, of the splat at a place; most_curves: how many splats from a place on have at most.
// stage_shared: hands what invocations have loaded to all; broadcast: what the one at a place has loaded.
// least_of_tile, votes_of_tile: of all invocations; see_entries: what they have written to lists, all read from there on.

#include "tile/splat.glsl"
#include "tile/entries.glsl"
#if defined(COLUMN)
#include "tile/lanes_column.glsl"
#else
#include "tile/lanes_pixel.glsl"
#endif
