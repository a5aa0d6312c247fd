// Visibility and accumulation of a tile's splats (Guennebaud et al. 2006, section 2, as in visibility.frag.glsl and
// accumulate.frag.glsl), with depths and sums in registers: the single-pass splatting that Pajarola et al. 2003 name as future
// work. One workgroup a tile, of 8 invocations, each a column of its pixels.
//
// FUSED: both, of one tile after the other. VISIBLE, SUMMED: one of them, where the graphics pipeline draws in between; or of a
// part of a tile with more splats than one dispatch takes: then depths and sums go on from what the image holds, which may be an image
// of such tiles alone (IN_SLOTS).
// SHADED: both, and then what a pixel shows instead of its sums (finalize.frag.glsl), which never leave the registers; where nobody
// else reads them. Tiles with more splats than one dispatch takes are left to tile_shade.comp.glsl. With BESIDE, polygons were drawn
// and shaded as if there were no splats. LIT: the scene has lights of its own.
// HALF, SINGLE: the precision of what is left in images. In registers it is f32.
// UPON: the graphics pipeline has drawn visible splats before. WITH_DEPTH, BESIDE: as in accumulate.frag.glsl.
// HIDDEN: what the tile's visible depth hides is not summed (inc/tile_hidden.glsl).
// PIXELS: of 64 invocations, each a pixel: a GPU's vectors are longer than 8. Of a column each
// loads one of BATCH, and they hand them to each other (inc/tile_batch.glsl). SHORT: columns have 4 pixels in place of 8.
//
// All rows are computed for every splat of the tile, without a branch: on a CPU driver, lanes of a vector are invocations,
// and it has no branch to gain by. Rows are computed from the splat's center, not stepped from the row above: three
// multiplications more, and no error adds up.
//
// Own depth is the same expression in both, which nothing may contract (src/shaders/build/exact.rs).
// Permutations: shaded | half single | _ beside | _ lit | _ pixels short
// Permutations: shaded | half single | _ beside | _ lit | hidden | _ pixels short
// Permutations: fused | half single | _ with_depth | _ upon | _ pixels short
// Permutations: fused | half single | _ with_depth | _ upon | hidden | _ pixels short
// Permutations: visible | _ upon | _ pixels short
// Permutations: summed | half single | _ with_depth | _ beside | _ pixels short
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#if !defined(PIXELS)
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#if defined(HIDDEN)
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#endif
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "inc/tiles.glsl"
layout(push_constant, std430) uniform Push { TileConstants push; };
#if defined(FUSED) || defined(SHADED)
#define IS_WHOLE true
#else
#define IS_WHOLE (push.part == 0xffffffffu) // WHOLE of src/passes/tiles/mod.rs
#endif
#include "inc/tile_work.glsl"
#include "inc/tile_batch.glsl"
#include "inc/tile_column.glsl"
#if defined(HIDDEN)
#include "inc/tile_hidden.glsl"
#endif
#if defined(SHADED)
#define LIGHTS_SET 0
#define LIGHTS_BINDING 16
#include "inc/shading.glsl"
#include "inc/normalized.glsl"
#endif

#if defined(HALF)
#define SUMS_FORMAT rgba16f
#else
#define SUMS_FORMAT rgba32f
#endif
#if defined(SHADED)
layout(set = 0, binding = 11, SUMS_FORMAT)
#if !defined(BESIDE)
writeonly
#endif
uniform image2D shown_colors; // linear light; 1: something is there. Before, of polygons
#else
#if !defined(VISIBLE)
layout(set = 0, binding = 11, SUMS_FORMAT) uniform image2D color_sums;
layout(set = 0, binding = 12, SUMS_FORMAT) uniform image2D normal_sums;
#endif
layout(set = 0, binding = 13, r32f) uniform image2D visible_depth;
#endif
#if defined(UPON)
layout(set = 0, binding = 14) uniform texture2D depth_before;
#endif
#if defined(BESIDE)
// The paper's transition shifts for all fragments, not only where there are polygons: the polygons' test is the only one.
layout(constant_id = 18) const bool SHIFTED_FOR_ALL = false;
layout(set = 0, binding = 15) uniform texture2D polygon_depth; // summed: of splats, where those are nearer
#endif

layout(constant_id = 23) const bool KEEPS_DEPTH = true; // someone reads it
#if defined(VISIBLE) || defined(SUMMED)
layout(constant_id = 26) const bool IN_SLOTS = false; // images hold overfull tiles alone; others are done elsewhere
#else
const bool IN_SLOTS = false;
#endif

// Where images have what a pixel of the tile has.
ivec2 stored_at(ivec2 top, int row)
{
    return IN_SLOTS ? pixel_in_slot(row) : pixel_of(top, row);
}

#include "inc/tile_pixel.glsl"

#if !defined(SUMMED)
void see(Range range, vec2 at_px, inout float visible[ROWS])
{
    Splat own;
    for (uint base = range.first; base < range.end; base += BATCH) {
        uint place = load(base, range, own);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Splat splat = handed(own, place + k);
            Column column = column_of(splat, at_px);
            [[unroll]] for (int row = 0; row < ROWS; row++) {
                see(splat, column, row, visible[row]);
            }
        }
    }
}
#endif

#if !defined(VISIBLE)
void sum(Range range, vec2 at_px, float visible[ROWS], float polygon[ROWS], inout vec4 colors[ROWS], inout vec4 normals[ROWS])
{
    Splat own;
    Look own_look;
    for (uint base = range.first; base < range.end; base += BATCH) {
        uint place = load(base, range, own, own_look);
#if defined(PIXELS)
        // One row, and no eight splats at once: a GPU would need 144 registers in place of 40.
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Splat splat = handed(own, place + k);
            Look look = handed(own_look, place + k);
            add(splat, look, column_of(splat, at_px), 0, visible[0], polygon[0], colors[0], normals[0]);
        }
#else
        // Row by row, for a CPU has no registers for the sums of all rows.
        Splat splats[BATCH];
        Look looks[BATCH];
        Column columns[BATCH];
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            splats[k] = handed(own, place + k);
            looks[k] = handed(own_look, place + k);
            columns[k] = column_of(splats[k], at_px);
        }
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            [[unroll]] for (uint k = 0; k < BATCH; k++) {
                add(splats[k], looks[k], columns[k], row, visible[row], polygon[row], colors[row], normals[row]);
            }
        }
#endif
    }
}
#endif

void main()
{
    Work work;
    if (!find_work(work)) {
        return;
    }
    bool goes_on = !IS_WHOLE && push.part > 0;
    ivec2 top = top_pixel(work.tile);
    vec2 at_px = from_middle_px(top);

    float visible[ROWS];
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        visible[row] = 0.0;
#if defined(UPON)
        visible[row] = texelFetch(depth_before, within_image(pixel_of(top, row)), 0).r;
#endif
#if defined(SUMMED)
        visible[row] = imageLoad(visible_depth, stored_at(top, row)).r;
#elif defined(VISIBLE)
        visible[row] = goes_on ? imageLoad(visible_depth, stored_at(top, row)).r : visible[row];
#endif
    }
#if !defined(SUMMED)
    see(work.range, at_px, visible);
#if !defined(SHADED)
    if (KEEPS_DEPTH) {
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            imageStore(visible_depth, stored_at(top, row), vec4(visible[row]));
        }
    }
#endif
#endif
#if !defined(VISIBLE)
    vec4 colors[ROWS];
    vec4 normals[ROWS];
    float polygon[ROWS];
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
#if defined(SUMMED)
        colors[row] = goes_on ? imageLoad(color_sums, stored_at(top, row)) : vec4(0.0);
        normals[row] = goes_on ? imageLoad(normal_sums, stored_at(top, row)) : vec4(0.0);
#endif
        polygon[row] = 0.0;
#if defined(BESIDE)
        polygon[row] = texelFetch(polygon_depth, within_image(pixel_of(top, row)), 0).r;
#if defined(SHADED)
        polygon[row] = max(polygon[row], visible[row]);
#endif
#endif
    }
#if defined(HIDDEN)
    work.range = unhidden(work.range, at_px, visible);
#endif
    sum(work.range, at_px, visible, polygon, colors, normals);
#if defined(SHADED)
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        Surface surface = normalized(colors[row], normals[row].xyz);
        vec3 v = to_eye(at_px + vec2(0.0, float(FIRST_ROW + row)));
        vec3 light = shaded(surface.albedo, surface.normal, v);
        bool covered = surface.weight > 0.0;
#if defined(BESIDE)
        // Of polygons, the nearest is shown already. Where splats do not hide it, both blend (inc/shown.glsl).
        vec3 of_polygon = imageLoad(shown_colors, pixel_of(top, row)).rgb;
        bool is_seen = polygon[row] > visible[row];
        float share = TRANSITION == TRANSITION_NONE ? 0.0 : min(FORMULA(FORMULA_TRANSITION, surface.weight), 1.0);
        light = is_seen ? mix(of_polygon, light, share) : light;
        covered = covered || is_seen;
#endif
#if defined(HALF)
        light = min(light, 65504.0); // where half floats end
#endif
        imageStore(shown_colors, pixel_of(top, row), covered ? vec4(light, 1.0) : vec4(0.0));
    }
#else
    [[unroll]] for (int row = 0; row < ROWS; row++) {
#if defined(HALF)
        // Half floats end at 65504. Of sums only ratios count.
        vec4 largest = max(abs(colors[row]), abs(normals[row]));
        float most = max(max(largest.x, largest.y), max(largest.z, largest.w));
        float factor = most > 60000.0 ? 60000.0 / most : 1.0;
        colors[row] *= factor;
        normals[row] *= factor;
#endif
        imageStore(color_sums, stored_at(top, row), colors[row]);
        imageStore(normal_sums, stored_at(top, row), normals[row]);
    }
#endif
#endif
}
