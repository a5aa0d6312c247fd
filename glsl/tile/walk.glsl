// A walk over the records of a segment, in order, which counts for each bin how many fall into it; LISTS: and hands those to `list`, each with how many
// come before it. COLUMN, for CPUs: an invocation walks alone over a segment. Else, for GPUs, a workgroup together over a piece of one.

#include "tile/rect.glsl"

#if defined(LISTS)
void list(uint record, uint bin, uint before);
#endif

// Coherent: those of a workgroup count together.
layout(set = 0, binding = BIND_COUNTS, std430) coherent buffer Counts { uint counts[]; };

layout(constant_id = SPEC_TEXELS) const bool TEXELS = false; // CPU drivers read these without a loop over lanes
layout(set = 0, binding = BIND_RECTS, std430) readonly buffer Rects { uint rects[]; };
layout(set = 0, binding = BIND_RECT_TEXELS) uniform utextureBuffer rect_texels;

// PARTED: the first quarter of records tells which are cut (tile/splat.glsl), and CURVED: their curves, in which cells (tile/cut.glsl).
layout(set = 0, binding = BIND_RECORDS, std430) readonly buffer Records0 { vec4 records0[]; };
layout(set = 0, binding = BIND_RECORD_TEXELS) uniform textureBuffer record_texels0;
layout(set = 0, binding = BIND_CLIPS, std430) readonly buffer ClipWords { uint clip_words[]; };
layout(set = 0, binding = BIND_CLIP_TEXELS) uniform textureBuffer clip_texels;

layout(constant_id = SPEC_LISTED) const bool LISTED = false; // records are those of a list, whose length only the device knows
layout(set = 0, binding = BIND_VISIBLE_STARTS, std430) readonly buffer VisibleStarts { uint visible_starts[]; };

const uint NO_BIN = 0xffffffffu;

uint rect_of(uint record)
{
    return TEXELS ? texelFetch(rect_texels, int(record)).x : rects[record];
}

// Where a record's curves and planes cut, by a row of the cells of its rect: in the first CELLS_ALONG bits those where something is left of it, then those that they cut.
uint cells_of(uint record, uint row)
{
    const uint WHOLE = (1u << CELLS_ALONG) - 1;
    bool clipped = PARTED && (TEXELS ? texelFetch(record_texels0, int(record)).z : records0[record].z) < 0.0;
    uint vector = CLIP_RECORD_VECTORS * record + CLIP_VECTORS + row / 4;
    uint word = !CURVED ? ~0u : TEXELS ? floatBitsToUint(texelFetch(clip_texels, int(vector))[row % 4]) : clip_words[4 * vector + row % 4];
    return clipped ? word : WHOLE;
}

// The bin of a tile; NO_BIN where nothing is left.
uint bin_of(uint tile, uint cells, uint column)
{
    uint bits = cells >> column;
    return (bits & 1) == 0 ? NO_BIN : TILE_BINS * tile + (bits >> CELLS_ALONG & 1);
}

// Records of the segment.
uint own_records(uint segment, uint record_count)
{
    uint blocks = (record_count + SEGMENT_BLOCK - 1) / SEGMENT_BLOCK;
    return segment < blocks ? ((blocks - segment - 1) / push.segments + 1) * SEGMENT_BLOCK : 0;
}

// The record at a place of a segment.
uint record_at(uint segment, uint place)
{
    return (place / SEGMENT_BLOCK * push.segments + segment) * SEGMENT_BLOCK + place % SEGMENT_BLOCK;
}

#if defined(COLUMN)
#include "tile/walk_alone.glsl"
#else
#include "tile/walk_together.glsl"
#endif
