// A walk over the records of a segment, in order: `visit(record, bin)` for each bin that a record falls into. One loop, whose
// steps are a record or a further tile, so that invocations with large splats don't hold up the others.

#include "tile/rect.glsl"

void visit(uint record, uint bin);

layout(local_size_x = BIN_GROUP_SIZE) in;
layout(set = 0, binding = BIND_COUNTS, std430) buffer Counts { uint counts[]; };

layout(constant_id = SPEC_TEXELS) const bool TEXELS = false; // CPU drivers read these without a loop over lanes
layout(set = 0, binding = BIND_RECTS, std430) readonly buffer Rects { uint rects[]; };
layout(set = 0, binding = BIND_RECT_TEXELS) uniform utextureBuffer rect_texels;

// PARTED: the first quarter of records tells which are clipped (tile/splat.glsl), and their curves, in which cells they are cut (tile/cut.glsl).
layout(set = 0, binding = BIND_RECORDS, std430) readonly buffer Records0 { vec4 records0[]; };
layout(set = 0, binding = BIND_RECORD_TEXELS) uniform textureBuffer record_texels0;
layout(set = 0, binding = BIND_CLIPS, std430) readonly buffer ClipRecords { vec4 clip_records[]; };
layout(set = 0, binding = BIND_CLIP_TEXELS) uniform textureBuffer clip_texels;

layout(constant_id = SPEC_LISTED) const bool LISTED = false; // records are those of a list, whose length only the device knows
layout(set = 0, binding = BIND_VISIBLE_STARTS, std430) readonly buffer VisibleStarts { uint visible_starts[]; };

uint rect_of(uint record)
{
    return TEXELS ? texelFetch(rect_texels, int(record)).x : rects[record];
}

uint cells_of_curve(uint record, uint number)
{
    uint place = CLIP_VECTORS * record + 3 * number + 2;
    return uint(TEXELS ? texelFetch(clip_texels, int(place)).w : clip_records[place].w);
}

// The cells of a record's rect where something is left of it, and those where curves cut it.
uvec2 cells_of(uint record)
{
    bool clipped = PARTED && (TEXELS ? texelFetch(record_texels0, int(record)).z : records0[record].z) < 0.0;
    return clipped ? uvec2(cells_of_curve(record, 0), cells_of_curve(record, 1)) : uvec2(~0u, 0);
}

// Records of the segment.
uint own_records(uint segment, uint record_count)
{
    uint blocks = (record_count + SEGMENT_BLOCK - 1) / SEGMENT_BLOCK;
    return segment < blocks ? ((blocks - segment - 1) / push.segments + 1) * SEGMENT_BLOCK : 0;
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
    uvec2 cells = uvec2(0);
    while (next < end || in_row > 0) {
        if (in_row == 0) {
            record = (next / SEGMENT_BLOCK * push.segments + segment) * SEGMENT_BLOCK + next % SEGMENT_BLOCK;
            next++;
            uint rect = record < record_count ? rect_of(record) : RECT_NONE;
            if (rect >= RECT_CHUNK) {
                if (rect != RECT_NONE) {
                    visit(record, FIRST_CHUNK_BIN + chunk_of(rect));
                }
            } else {
                uvec2 first = first_of(rect);
                uvec2 more = more_of(rect);
                outside = outside_of(rect);
                size = more;
                cells = cells_of(record);
                width = more.x + 1;
                rows = more.y;
                row_tile = first.x + first.y * push.tiles_x - push.first_tile;
                tile = row_tile + (outside & 1);
                in_row = width - bitCount(outside & 3);
            }
        }
        if (in_row > 0) {
            uint cell = PARTED ? cell_of(uvec2(tile - row_tile, size.y - rows), cell_shift(size)) : 0;
            if (!PARTED || (cells.x >> cell & 1) != 0) {
                visit(record, TILE_BINS * tile + (PARTED ? cells.y >> cell & 1 : 0));
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
