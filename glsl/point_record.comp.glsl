// Sets each splat up once, as a point: culls it, or makes a record of it (inc/point_record.glsl), which all passes' vertex stages
// read (inc/emit_record.glsl). The same expressions as theirs where each sets up by itself (inc/emit.glsl), so that the
// picture is the same, but for what a driver rounds otherwise in another stage.
//
// SMALL: what is drawn as a quad has a record without a side. KEPT: only those of a list are set up (inc/kept.glsl), and only they
// are drawn.
// Permutations: _ small | _ kept
#version 460
#define PLAIN
#include "inc/setup.glsl"
#include "inc/places.glsl"
#include "inc/expansion.glsl"
#include "inc/point.glsl"
#include "inc/groups.glsl"
#include "inc/kept.glsl"
#define RECORDS_ACCESS writeonly
#include "inc/point_record.glsl"

layout(local_size_x = 64) in;
#if defined(SMALL)
#define LARGE_BITS_ACCESS readonly
#include "inc/large.glsl"
#endif
#define KEPT_STARTS 1
#define KEPT_LIST 2
#include "inc/kept_list.glsl"

void store_record(uint index, PointRecord record)
{
    uvec2 middle = uvec2(2.0 * record.square.middle_px);
    uint side = min(uint(record.square.side_px), (1u << SIDE_BITS) - 1);
    records0[index] = vec4(record.x0_w, record.inverse_shift);
    records1[index] = vec4(record.along_x, record.share);
    records2[index] = vec4(record.along_y, record.normal.x);
    records3[index] = uvec4(floatBitsToUint(record.normal.yz), middle.x, middle.y | side << MIDDLE_BITS);
}

bool is_drawn_elsewhere(uint index)
{
#if defined(SMALL)
    return is_large(index);
#else
    return false;
#endif
}

void main()
{
    uint index;
    uint place;
    if (!find_splat(index, place)) {
        return;
    }
    Mapping m;
    PointRecord record;
    if (is_drawn_elsewhere(index) || !map_splat(index, m) || !square_of(m, record.square)) {
        records3[index] = uvec4(0); // no side
        return;
    }
    ImageMap map = regular_map(m);
    record.x0_w = expansion_of(map);
    record.inverse_shift = m.inverse_shift;
    record.along_x = map.along_x;
    record.along_y = map.along_y;
    record.share = WEIGHTED ? share_of(m) : 1.0;
    record.normal = OUTWARD && m.faces_away ? -m.normal : m.normal;
    store_record(index, record);
}
