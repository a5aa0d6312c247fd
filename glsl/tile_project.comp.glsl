// Projects each splat once: culls it, or makes a record and a tile rect of it (tile/splat.glsl, tile/rect.glsl); or leaves it to the
// graphics pipeline: what is not regular, and what touches more tiles than lists have room for.
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "inc/config.glsl"
// A chunk's number is that of a rect; in the bits above it is how many tiles a splat touches at most, which no pipeline is told: a camera that moves would want others without end.
#define CHUNK (frame.chunk_color >> 1 & (1u << MOST_TILES_SHIFT - 1) - 1)
#define MOST_TILES (frame.chunk_color >> MOST_TILES_SHIFT)
#include "inc/setup.glsl"
#define LIST_BLOCKS BIND_VISIBLE_BLOCKS
#include "inc/list.glsl"
#include "inc/levels.glsl"
#include "inc/minor_axis.glsl"
#include "inc/smooth_step.glsl"
#include "tile/rect.glsl"
#include "tile/corners.glsl"

// Curves, and behind them words of cells, in one buffer.
layout(set = 1, binding = BIND_CLIPS, std430) writeonly buffer ClipRecords { vec4 clip_records[]; };
layout(set = 1, binding = BIND_CLIPS, std430) writeonly buffer ClipWords { uint clip_words[]; };
#include "tile/cut.glsl"
#define PLANES_SET 1
#define PLANES_BINDING BIND_PLANES
#include "inc/planes.glsl"
#define TINTS_SET 1
#define TINTS_BINDING BIND_TINTS
#include "inc/tints.glsl"

layout(constant_id = SPEC_TILE_HEIGHT) const uint TILE_HEIGHT = MOST_TILE_HEIGHT;
layout(constant_id = SPEC_MAY_BE_LARGE) const bool MAY_BE_LARGE = false;
layout(constant_id = SPEC_PARTED) const uint PARTED_BY = 0;
const bool BESIDE_CURVES = PARTED_BY == PARTED_CURVES + PARTED_PLANES; // where others have clip curves, it has to be told that there is none
layout(constant_id = SPEC_LISTED) const bool LISTED = false; // of inc/list.glsl, records of which lie one behind the other

layout(local_size_x = PROJECT_GROUP_SIZE) in;
layout(set = 1, binding = BIND_RECORDS, std430) writeonly buffer Records0 { vec4 records0[]; };
layout(set = 1, binding = BIND_RECORDS + 1, std430) writeonly buffer Records1 { vec4 records1[]; };
layout(set = 1, binding = BIND_RECORDS + 2, std430) writeonly buffer Records2 { vec4 records2[]; };
layout(set = 1, binding = BIND_RECORDS + 3, std430) writeonly buffer Records3 { uvec4 records3[]; };
layout(set = 1, binding = BIND_RECTS, std430) writeonly buffer Rects { uint rects[]; };
layout(set = 1, binding = BIND_VISIBLE_STARTS, std430) readonly buffer VisibleStarts { uint visible_starts[]; };
layout(set = 1, binding = BIND_VISIBLE_LIST, std430) readonly buffer VisibleList { uint visible_list[]; };

// The splat's number in its chunk, and its place among all that are projected; false where there is none.
bool find_splat(out uint index, out uint place)
{
    index = GROUP_NUMBER * PROJECT_GROUP_SIZE + gl_LocalInvocationID.x;
    place = frame.first_record + index;
    if (LISTED) {
        uint first = first_word_of_chunk();
        place = visible_starts[first] + index;
        if (place >= visible_starts[first + words_of_chunk()]) {
            return false;
        }
        index = visible_list[place];
    }
    return index < frame.splat_count;
}

const uint BEND_OF_DISK = 0x3f80ff08u; // all are 1: disks have no room to tell it

// Over the filter's radius, the minor half axis of the image of the surface around a splat: its ellipse, so many times as wide.
float surface_minor(Splat splat, float width)
{
    vec3 ray = ray_through(splat.p);
    vec2 c = ray.xy / ray.z;
    vec3 s = dot(splat.s, splat.s) >= dot(splat.t, splat.t) ? splat.s : splat.t;
    float wide = width * splat.area * length(splat.n); // times s
    vec3 t = wide / dot(s, s) * cross(splat.normal, s);
    float per_h = 1.0 / (ray.z * frame.filter_radius);
    vec2 a = per_h * (s.xy - c * s.z);
    vec2 b = per_h * (t.xy - c * t.z);
    float sum = dot(a, a) + dot(b, b);
    float det = wide * per_h * per_h * normal_dot_ray(splat) / (length(splat.n) * ray.z);
    return abs(det) * inversesqrt(max(0.5 * (sum + sqrt(max(sum * sum - 4.0 * det * det, 0.0))), 1e-30));
}

// How surely a sharp surface goes on around a splat, from 0 to 1: there its sums are made whole (inc/edges.glsl), and it covers what unfiltered ellipses do (inc/outlined.glsl).
//
// Not where it ends by turning away: its outline is within c of the splat's reach and of the filter's where it faces the eye by the cosine f with f^2 / (2 tau) = c f + c h, with tau
// by how much it turns over what the splat reaches toward there (src/prepare/near_surfaces/sharp.rs) and h the filter's radius, in minor axes; what is flat or hollow has no such outline. And not where it is narrower than the
// filter, as a side is that is seen edge-on: there its sum says how wide it is. What faces the eye has neither, whatever it does.
float how_surely_goes_on(uint index, Mapping m)
{
    Splat splat = load_splat(index);
    uint bend = ELLIPSES ? floatBitsToUint(shapes[SHAPE_VECTORS * index + 2].w) : BEND_OF_DISK;
    float turn = uintBitsToFloat(bend & ~0xffffu);
    vec3 ray = ray_through(m.p);
    float facing = abs(dot(m.normal, ray)) / length(ray);
    float filter_radii = float(bend >> 8 & 0xff) / 255.0 * frame.filter_radius * ray.z * splat.radius / (splat.area * length(splat.n));
    float part = SHARP_REACH * turn;
    float outline = part + sqrt(part * (part + 2.0 * filter_radii));
    float minor = surface_minor(splat, 0.125 * float(bend & 0xff));
    float goes_on = smooth_step(facing / max(outline, 1e-6) - 1.0) * smooth_step((minor - SHARP_MINOR) / (1.0 - SHARP_MINOR));
    return max(smooth_step(facing / SHARP_FACING - 1.0), goes_on);
}

// What planes do to it, as cut_in_box tells.
bvec2 cut_by_planes(ImageMap map, PixelBox px)
{
    vec2 middle_px = 0.5 * (vec2(px.first) + vec2(px.last)) + 0.5 - frame.middle_px;
    vec2 w_per_px = vec2(map.along_x.z, map.along_y.z);
    vec2 from_x0 = middle_px - map.x0_px;
    float w = map.at_x0.z + (w_per_px.x * from_x0.x + w_per_px.y * from_x0.y);
    return cut_in_box(middle_px, 0.5 * vec2(px.last - px.first), w, w_per_px);
}

// Where MAY_BE_LARGE is not set, the host has proved that there are none.
// `cut`: whether planes may cut it. `px`: the pixels that it may cover, where it has a rect.
uint rect_of(Mapping m, ImageMap map, out PixelBox px, out bool cut)
{
    cut = false;
    uint large = MAY_BE_LARGE ? RECT_CHUNK + CHUNK : RECT_NONE;
    if (!m.regular) {
        return large;
    }
    if (!pixel_box(splat_box(m), px)) {
        return RECT_NONE;
    }
    if (PLANES > 0) {
        bvec2 is = cut_by_planes(map, px);
        if (is.x) {
            return RECT_NONE;
        }
        cut = is.y;
    }
    const uvec2 tile = uvec2(TILE_WIDTH, TILE_HEIGHT);
    uvec2 first = uvec2(px.first) / tile;
    uvec2 last = uvec2(px.last) / tile;
    uvec2 more = last - first;
    if (max(more.x, more.y) > MOST_MORE || MAY_BE_LARGE && (more.x + 1) * (more.y + 1) > MOST_TILES) {
        return large;
    }
    uint outside = max(more.x, more.y) <= MOST_MORE_OF_SMALL ? corners_outside(map, first, last, vec2(tile)) : 0;
    if (LISTED) {
        // Of the band's rows. Behind the choice above, so that a splat is drawn the same way in every band.
        const uint each = BAND_ROW / TILE_HEIGHT;
        uvec2 rows = uvec2(max(first.y, visible_rows.x * each), min(last.y, visible_rows.y * each - 1));
        if (rows.x > rows.y) {
            return RECT_NONE;
        }
        outside &= (rows.x > first.y ? 12 : 15) & (rows.y < last.y ? 3 : 15);
        // Where only the last row is left, it is the first one.
        outside >>= rows.x > first.y && rows.x == last.y ? 2 : 0;
        first.y = rows.x;
        more.y = rows.y - rows.x;
    }
    return rect_from(first, more, outside);
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
        rects[place] = RECT_NONE;
        return;
    }
    ImageMap map = regular_map(m);
    bool cut_by_planes;
    PixelBox px;
    uint rect = rect_of(m, map, px, cut_by_planes);
    rects[place] = rect;
    if (rect >= RECT_CHUNK) {
        return;
    }
    float w0 = map.at_x0.z;
    float uv_scale = map.affine ? 1.0 : 1.0 / w0;
    float share = share_of(m) * own_weight(index);
    vec4 uv = uv_scale * vec4(map.along_x.x, map.along_y.x, map.along_x.y, map.along_y.y);
    float goes_on = SHARP ? how_surely_goes_on(index, m) : 0.0;
    share *= SHARP ? FORMULA(FORMULA_SHARP_SUM, mix(1.0, SHARP_SUM, goes_on)) : 1.0;
    float blended = BLENDED ? weight_of_level(index) : 1.0;
    share *= blended;
    if (REACHES && m.reaches) {
        share = -share;
    }
    if (BLENDED) {
        // What is to vanish has to leave no trace at the end. It hides ever less of what is behind it: its epsilon grows. Nor does it cover a
        // pixel by itself any more (inc/edges.glsl), by what stands in the place of alpha; the larger one of a node and its children still does.
        float more = max(0.5 / max(blended, 1e-20), 1.0);
        m.shift = ORTHOGRAPHIC ? more * m.shift : m.shift / (m.shift + more * (1.0 - m.shift));
    }
    vec3 normal = OUTWARD && m.faces_away ? -m.normal : m.normal;
    uvec2 color;
    if (PACKED && !UNIFORM_COLOR) {
        vec4 rgba = load_packed_color(index);
        color = uvec2(packUnorm2x16(rgba.rg), packUnorm2x16(rgba.ba));
    } else {
        color = colors[UNIFORM_COLOR ? 0 : index];
    }
    if (TINTED) {
        vec4 rgba = tinted(vec4(unpackUnorm2x16(color.x), unpackUnorm2x16(color.y)));
        color = uvec2(packUnorm2x16(rgba.rg), packUnorm2x16(rgba.ba));
    }
    if (BLENDED) {
        color.y = packUnorm2x16(vec2(unpackUnorm2x16(color.y).x, 2.0 * blended));
    }
    if (SHARP && !BLENDED && !IN_LAYERS) {
        // What is opaque has no alpha: how surely the surface ends stands in its place (inc/outlined.glsl).
        color.y = packUnorm2x16(vec2(unpackUnorm2x16(color.y).x, 1.0 - goes_on));
    }
    float signed_shift = TWO_SIDED && m.faces_away ? -m.shift : m.shift;
    records0[place] = vec4(map.x0_px, CLIPS || cut_by_planes ? -w0 : w0, signed_shift);
    records1[place] = uv;
    records2[place] = vec4(map.along_x.z / w0, map.along_y.z / w0, share, normal.x);
    records3[place] = uvec4(floatBitsToUint(normal.yz), color);
    uint first_vector = CLIP_RECORD_VECTORS * place;
    uint first_word = 4 * (first_vector + CLIP_VECTORS);
    if (CLIPS) {
        Curve curves[2];
        clip_in_image(index, m, curves);
        vec4 box_px = vec4(vec2(px.first), vec2(px.last)) + 0.5 - frame.middle_px.xyxy;
        write_cells(first_word, curves, map, rect, vec2(TILE_WIDTH, TILE_HEIGHT), box_px, cut_by_planes);
        [[unroll]] for (uint i = 0; i < 2; i++) {
            clip_records[first_vector + 3 * i] = curves[i].c;
            clip_records[first_vector + 3 * i + 1] = curves[i].a;
            clip_records[first_vector + 3 * i + 2] = curves[i].b;
        }
    } else if (BESIDE_CURVES && cut_by_planes) {
        [[unroll]] for (uint i = 0; i < CLIP_VECTORS; i++) {
            clip_records[first_vector + i] = vec4(0.0);
        }
        [[unroll]] for (uint row = 0; row < CELLS_ALONG; row++) {
            clip_words[first_word + row] = ~0u;
        }
    }
}
