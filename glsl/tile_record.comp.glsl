// Sets each splat up once: culls it, or makes a record and a span of it (inc/tiles.glsl, inc/tile_record.glsl); or leaves it to the
// graphics pipeline: what is not regular, and what touches more tiles than lists have room for.
//
// KEPT: only those of a list, whose records lie one behind the other (inc/kept.glsl).
// Permutations: _ kept
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "inc/setup.glsl"
#include "inc/tiles.glsl"
#include "inc/kept.glsl"
#include "inc/tile_corners.glsl"

layout(constant_id = 22) const uint MOST_TILES = 64; // that a splat of a record touches
layout(constant_id = 25) const uint TILE_HEIGHT = 8;
layout(constant_id = 16) const bool MAY_BE_LARGE = false; // some splats are left to the graphics pipeline; chunk: which bin
layout(constant_id = 17) const uint CHUNK = 0;

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) writeonly buffer Records0 { vec4 records0[]; };
layout(set = 1, binding = 1, std430) writeonly buffer Records1 { vec4 records1[]; };
layout(set = 1, binding = 2, std430) writeonly buffer Records2 { vec4 records2[]; };
layout(set = 1, binding = 3, std430) writeonly buffer Records3 { uvec4 records3[]; };
layout(set = 1, binding = 4, std430) writeonly buffer Spans { uint spans[]; };
#define KEPT_STARTS 20
#define KEPT_LIST 21
#include "inc/kept_list.glsl"
#if defined(KEPT)
#define KEPT_BLOCKS 22
#include "inc/kept_blocks.glsl"
#endif

// Where MAY_BE_LARGE is not set, the host has proved that there are none.
uint span_of(Mapping m, ImageMap map)
{
    const uint large = MAY_BE_LARGE ? SPAN_CHUNK + CHUNK : SPAN_NONE;
    if (!m.regular) {
        return large;
    }
    PixelBox px;
    if (!pixel_box(splat_box(m), px)) {
        return SPAN_NONE;
    }
    const uvec2 tile = uvec2(TILE_WIDTH, TILE_HEIGHT);
    uvec2 first = uvec2(px.first) / tile;
    uvec2 last = uvec2(px.last) / tile;
    uvec2 more = last - first;
    if (max(more.x, more.y) > MOST_MORE || (more.x + 1) * (more.y + 1) > MOST_TILES) {
        return large;
    }
    uint outside = max(more.x, more.y) <= MOST_MORE_OF_SMALL ? corners_outside(map, first, last, vec2(tile)) : 0;
#if defined(KEPT)
    // Of the band's rows. Behind the choice above, so that a splat is drawn the same way in every band.
    const uint each = BAND_ROW / TILE_HEIGHT;
    uvec2 rows = uvec2(max(first.y, kept_rows.x * each), min(last.y, kept_rows.y * each - 1));
    if (rows.x > rows.y) {
        return SPAN_NONE;
    }
    outside &= (rows.x > first.y ? 12 : 15) & (rows.y < last.y ? 3 : 15);
    // Where only the last row is left, it is the first one.
    outside >>= rows.x > first.y && rows.x == last.y ? 2 : 0;
    first.y = rows.x;
    more.y = rows.y - rows.x;
#endif
    return span_from(first, more, outside);
}

void main()
{
    uint index;
    uint place;
    if (!find_splat(index, place)) {
        return;
    }
    Mapping m;
    if (!map_splat(index, m)) {
        spans[place] = SPAN_NONE;
        return;
    }
    ImageMap map = regular_map(m);
    uint span = span_of(m, map);
    spans[place] = span;
    if (span >= SPAN_CHUNK) {
        return;
    }
    float w0 = map.at_x0.z;
    float uv_scale = map.affine ? 1.0 : 1.0 / w0;
    float share = share_of(m);
    vec3 normal = OUTWARD && m.faces_away ? -m.normal : m.normal;
    uvec2 color;
    if (PACKED && frame.uniform_color == 0) {
        vec4 rgba = load_packed_color(index);
        color = uvec2(packUnorm2x16(rgba.rg), packUnorm2x16(rgba.ba));
    } else {
        color = colors[frame.uniform_color != 0 ? 0 : index];
    }
    records0[place] = vec4(map.x0_px, w0, m.inverse_shift);
    records1[place] = uv_scale * vec4(map.along_x.x, map.along_y.x, map.along_x.y, map.along_y.y);
    records2[place] = vec4(map.along_x.z / w0, map.along_y.z / w0, share, normal.x);
    records3[place] = uvec4(floatBitsToUint(normal.yz), color);
}
