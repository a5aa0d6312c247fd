// Visibility and accumulation of a tile's splats (Guennebaud et al. 2006, section 2, as in visibility.frag.glsl and
// accumulate.frag.glsl), with depths and sums in registers: the single-pass splatting that Pajarola et al. 2003 name as future
// work. One workgroup of 8 invocations a tile, each a column of its pixels.
//
// FUSED: both, of one tile after the other. VISIBLE, SUMMED: one of them, where the graphics pipeline draws in between; or of a
// part of a tile with more splats than one dispatch takes: then depths and sums go on from what the image holds.
// HALF, SINGLE: the precision of the sums in the images. In registers they are f32.
// UPON: the graphics pipeline has drawn visible splats before. WITH_DEPTH, BESIDE: as in accumulate.frag.glsl.
// DIRECT: each invocation loads every record. Without it each loads one of BATCH, and they hand them to each other.
//
// All rows are computed for every splat of the tile, without a branch: on a CPU driver, lanes of a vector are invocations,
// and it has no branch to gain by. Rows are computed from the splat's center, not stepped from the row above: three
// multiplications more, and no error adds up.
//
// Own depth is the same expression in both, which nothing may contract (src/shaders/build/exact.rs).
// Permutations: fused | half single | _ with_depth | _ upon | _ direct
// Permutations: visible | _ upon | _ direct
// Permutations: summed | half single | _ with_depth | _ beside | _ direct
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#if !defined(DIRECT)
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "inc/tiles.glsl"
#include "inc/tile_batch.glsl"

#define WHOLE 0xffffffffu // no part: the whole tile

layout(local_size_x = TILE) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 6, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 8, std430) readonly buffer SeenTiles { uint seen_tiles[]; };
layout(set = 0, binding = 10, std430) readonly buffer OverfullTiles { uint overfull_tiles[]; };

#if defined(HALF)
#define SUMS_FORMAT rgba16f
#else
#define SUMS_FORMAT rgba32f
#endif
#if !defined(VISIBLE)
layout(set = 0, binding = 11, SUMS_FORMAT) uniform image2D color_sums;
layout(set = 0, binding = 12, SUMS_FORMAT) uniform image2D normal_sums;
#endif
layout(set = 0, binding = 13, r32f) uniform image2D visible_depth;
#if defined(UPON)
layout(set = 0, binding = 14) uniform texture2D depth_before;
#endif
#if defined(BESIDE)
// The paper's transition shifts for all fragments, not only where there are polygons: the polygons' test is the only one.
layout(constant_id = 18) const bool SHIFTED_FOR_ALL = false;
layout(set = 0, binding = 15) uniform texture2D depth_with_polygons;
#endif

layout(constant_id = 19) const uint PART = 200000; // entries of a tile that one dispatch takes (inc/tiles.glsl)
layout(constant_id = 23) const bool KEEPS_DEPTH = true; // someone reads it

const float LEAST_WEIGHT = 5.9604645e-8; // 2^-24

struct Range {
    uint first;
    uint end;
};

#if !defined(SUMMED)
void see(Range range, vec2 at_px, inout float visible[TILE])
{
    for (uint base = range.first; base < range.end; base += BATCH) {
        Batch batch = load_batch(base, range.end);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            float inverse_shift = handed(batch.r0.w, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                bool inside = is_inside(uvw);
                float depth = column.w0 * uvw.z;
                float shifted = depth * inverse_shift;
                inside = inside && is_beyond_near(depth);
                visible[row] = inside ? max(visible[row], shifted) : visible[row];
            }
        }
    }
}
#endif

#if !defined(VISIBLE)
void sum(Range range, vec2 at_px, float visible[TILE], float polygon[TILE], inout vec4 colors[TILE], inout vec4 normals[TILE])
{
    for (uint base = range.first; base < range.end; base += BATCH) {
        Batch batch = load_batch(base, range.end);
        Look look = load_look(batch);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            vec3 color = handed(look.color, k);
            vec3 normal = handed(look.normal, k);
            float share = handed(look.share, k);
#if defined(BESIDE)
            float inverse_shift = handed(batch.r0.w, k);
#endif
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth);
#if defined(BESIDE)
                inside = inside && (SHIFTED_FOR_ALL || depth >= visible[row])
                    && depth >= FORMULA(FORMULA_TOWARD_VIEWER, polygon[row] * inverse_shift);
#else
                inside = inside && depth >= visible[row];
#endif
                float r2 = dot(uvw.xy, uvw.xy);
                r2 = AFFINE ? r2 : r2 / (uvw.z * uvw.z);
                float weight = kernel_weight(r2);
                weight = WEIGHTED ? max(weight * share, LEAST_WEIGHT) : weight;
                weight = inside ? weight : 0.0;
                colors[row] += weight * vec4(color, 1.0);
                normals[row].xyz += weight * normal;
#if defined(WITH_DEPTH)
                // Where the splat is not inside, depth may be 0.
                normals[row].w += inside ? weight * FORMULA(FORMULA_DEPTH_SUM, visible[row] / depth) : 0.0;
#endif
            }
        }
    }
}
#endif

void main()
{
#if defined(FUSED)
    if (GROUP_NUMBER >= starts[STARTS_SEEN]) {
        return;
    }
    uint tile = seen_tiles[GROUP_NUMBER];
    uint first = starts[tile];
    uint end = starts[tile + 1];
    if (end - first > PART) {
        return;
    }
    const bool goes_on = false;
#else
    if (GROUP_NUMBER >= starts[push.part == WHOLE ? STARTS_SEEN : STARTS_OVERFULL]) {
        return;
    }
    uint tile = push.part == WHOLE ? seen_tiles[GROUP_NUMBER] : overfull_tiles[GROUP_NUMBER];
    uint begin = starts[tile];
    uint finish = starts[tile + 1];
    if (push.part == WHOLE && finish - begin > PART) {
        return;
    }
    uint first = push.part == WHOLE ? begin : min(begin + push.part * PART, finish);
    uint end = push.part == WHOLE ? finish : min(first + PART, finish);
    bool goes_on = push.part != WHOLE && push.part > 0;
#endif
    Range range = Range(first, end);
    ivec2 pixel = TILE * ivec2(tile % push.tiles_x, tile / push.tiles_x) + ivec2(gl_LocalInvocationID.x, 0);
    ivec2 last_pixel = ivec2(2.0 * push.half_size_px) - 1;
    vec2 at_px = vec2(pixel) + 0.5 - push.half_size_px;

    float visible[TILE];
    [[unroll]] for (int row = 0; row < TILE; row++) {
        ivec2 place = pixel + ivec2(0, row);
        visible[row] = 0.0;
#if defined(UPON)
        visible[row] = texelFetch(depth_before, min(place, last_pixel), 0).r;
#endif
#if defined(SUMMED)
        visible[row] = imageLoad(visible_depth, place).r;
#elif defined(VISIBLE)
        visible[row] = goes_on ? imageLoad(visible_depth, place).r : visible[row];
#endif
    }
#if !defined(SUMMED)
    see(range, at_px, visible);
    if (KEEPS_DEPTH) {
        [[unroll]] for (int row = 0; row < TILE; row++) {
            imageStore(visible_depth, pixel + ivec2(0, row), vec4(visible[row]));
        }
    }
#endif
#if !defined(VISIBLE)
    vec4 colors[TILE];
    vec4 normals[TILE];
    float polygon[TILE];
    [[unroll]] for (int row = 0; row < TILE; row++) {
        ivec2 place = pixel + ivec2(0, row);
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
#if defined(SUMMED)
        colors[row] = goes_on ? imageLoad(color_sums, place) : vec4(0.0);
        normals[row] = goes_on ? imageLoad(normal_sums, place) : vec4(0.0);
#endif
        polygon[row] = 0.0;
#if defined(BESIDE)
        polygon[row] = texelFetch(depth_with_polygons, min(place, last_pixel), 0).r;
#endif
    }
    sum(range, at_px, visible, polygon, colors, normals);
    [[unroll]] for (int row = 0; row < TILE; row++) {
#if defined(HALF)
        // Half floats end at 65504. Of sums only ratios count.
        vec4 largest = max(abs(colors[row]), abs(normals[row]));
        float most = max(max(largest.x, largest.y), max(largest.z, largest.w));
        float factor = most > 60000.0 ? 60000.0 / most : 1.0;
        colors[row] *= factor;
        normals[row] *= factor;
#endif
        imageStore(color_sums, pixel + ivec2(0, row), colors[row]);
        imageStore(normal_sums, pixel + ivec2(0, row), normals[row]);
    }
#endif
}
