// For the limits beside the floor benchmark: splats seen at pixels and then added to them, by what tiles do it with
// (tile/pixel.glsl), and nothing else: no list, no record, no image. Each splat is the one before, moved a little, so that only
// its place is new. An invocation has a column of 8 pixels, or, PIXELS, one, as in tile_accumulate.comp.glsl.
// Permutations: _ pixels
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"

#if defined(PIXELS)
#define ROWS 1
#else
#define ROWS MOST_TILE_HEIGHT
#endif
const int first_row = 0;
vec2 top_px;
#define PEELS false
#define OF_LAYERS false
const bool CUTS = false; // nothing does
#include "tile/splat.glsl"
const bool CURVED = false; // of what covers pixels in part, of which there is nothing here
#include "tile/pixel.glsl"

layout(constant_id = SPEC_LIMIT_SPLATS) const uint SPLATS = 64; // a multiple of TILE_BATCH

layout(local_size_x = KERNELS_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_POINTS, std430) writeonly buffer Words { uint words[]; };

Splat moved(Splat splat, uint by)
{
    splat.x0_px += 0.125 * float(by);
    return splat;
}

void main()
{
    top_px = vec2(gl_LocalInvocationIndex % 8, gl_LocalInvocationIndex / 8 * ROWS);
    // Not known before the dispatch, so that nothing is computed before it.
    float unknown = 1.0 + 0.001 * float(gl_WorkGroupID.x);
    Splat first = Splat(0, vec2(-unknown), unknown, 0.99 * unknown, unknown * vec4(0.1, 0.01, -0.01, 0.1), unknown * vec2(0.001, 0.002));
    vec3 color = vec3(unknown, 0.5 * unknown, 0.2 * unknown);
    SplatAttributes attributes = SplatAttributes(color, 1.0, unknown * vec3(0.6, 0.0, -0.8), 0.9 * unknown, vec2(0.0), vec4(0.0), vec4(0.0));

    [[unroll]] for (int row = 0; row < ROWS; row++) {
        visible[row] = 0.0;
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
    }
    for (uint base = 0; base < SPLATS; base += TILE_BATCH) {
        [[unroll]] for (uint k = 0; k < TILE_BATCH; k++) {
            Splat splat = moved(first, base + k);
            Column column = column_of(splat);
            [[unroll]] for (int row = 0; row < ROWS; row++) {
                see(splat, column, WHOLE, row);
            }
        }
    }
    for (uint base = 0; base < SPLATS; base += TILE_BATCH) {
        Splat splats[TILE_BATCH];
        Column columns[TILE_BATCH];
        [[unroll]] for (uint k = 0; k < TILE_BATCH; k++) {
            splats[k] = moved(first, base + k);
            columns[k] = column_of(splats[k]);
        }
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            [[unroll]] for (uint k = 0; k < TILE_BATCH; k++) {
                add(splats[k], attributes, columns[k], WHOLE, row);
            }
        }
    }

    vec4 sum = vec4(0.0);
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        sum += colors[row] + normals[row];
    }
    // Never: weights are positive. No compiler knows it.
    if (sum.a < 0.0) {
        words[gl_GlobalInvocationID.x] = floatBitsToUint(dot(sum, vec4(1.0)));
    }
}
