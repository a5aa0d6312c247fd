// Transparent layers of a tile's splats, all in one dispatch: peeling (inc/peel.glsl proves that no surface is lost or taken
// twice), accumulation, shading, and composition from front to back, with the depths, the sums and the light so far in
// registers. The graphics pipeline needs three passes a layer for that (src/passes/layers.rs).
//
// BEHIND: opaque things hide what is behind them. SEVERAL: one of several dispatches, whose light, depth and weight go on in
// images: loops have an end on llvmpipe (inc/tiles.glsl). PARTS: of the tiles with more splats than that leaves room for, a
// step of one layer and a part of their splats in each dispatch, with all that is found kept in a buffer. LIT: the scene has
// lights of its own. HALF, SINGLE: of the light in its image. PIXELS, SHORT: as in tile_splat.comp.glsl.
// Permutations: half single | _ lit | _ behind | _ several parts | _ pixels short
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#if !defined(PIXELS)
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#endif
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "inc/tiles.glsl"
layout(push_constant, std430) uniform Push { TileConstants push; };
#if defined(PARTS)
#define IS_WHOLE false
#else
#define IS_WHOLE true
#endif
#include "inc/tile_work.glsl"
#include "inc/tile_batch.glsl"
#include "inc/tile_column.glsl"
#define LIGHTS_SET 0
#define LIGHTS_BINDING 16
#include "inc/shading.glsl"
#include "inc/normalized.glsl"
#include "inc/tile_peel.glsl"
#include "inc/tile_rest.glsl"

#if defined(HALF)
layout(set = 0, binding = 11, rgba16f) uniform image2D layers; // alpha * linear color, alpha
#else
layout(set = 0, binding = 11, rgba32f) uniform image2D layers;
#endif
#if defined(PARTS)
layout(set = 0, binding = 18, std430) buffer PeeledState { vec4 state[]; };
#define STATE_VECTORS 4
#endif
#if defined(SEVERAL)
layout(set = 0, binding = 13, r32f) uniform image2D peeled_depth;
layout(set = 0, binding = 17, r32f) uniform image2D peeled_weight;
#endif
#if defined(BEHIND)
layout(set = 0, binding = 14) uniform texture2D opaque_depth;
#endif

// Steps of a layer in PARTS; src/passes/tiles/layer_work.rs names the same.
#define STEP_SEE 0
#define STEP_SUM 1
#define STEP_REST 2

void main()
{
    Work work;
    if (!find_work(work)) {
        return;
    }
    Range range = work.range;
    ivec2 top = top_pixel(work.tile);
    vec2 at_px = from_middle_px(top);

    Peeled peeled;
    vec4 colors[ROWS];
    vec4 normals[ROWS]; // of the rest, the first component is the weight
    float visible[ROWS];
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        ivec2 pixel = pixel_of(top, row);
        peeled.light[row] = vec4(0.0);
        peeled.depth[row] = INFINITELY_NEAR;
        peeled.weight[row] = 0.0;
        peeled.opaque[row] = 0.0;
#if defined(BEHIND)
        peeled.opaque[row] = texelFetch(opaque_depth, within_image(pixel), 0).r;
#endif
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
        visible[row] = peeled.opaque[row];
#if defined(SEVERAL)
        if (push.part > 0) {
            peeled.light[row] = imageLoad(layers, pixel);
            peeled.depth[row] = imageLoad(peeled_depth, pixel).r;
            peeled.weight[row] = imageLoad(peeled_weight, pixel).r;
        }
#endif
    }
#if defined(PARTS)
    // What is found of the tile so far.
    uint column = GROUP_NUMBER * TILE_WIDTH + gl_LocalInvocationID.x;
    uint states = (column * TILE_HEIGHT + OWN_ROW) * STATE_VECTORS;
    bool goes_on = push.part > 0;
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        uint at = states + uint(row) * STATE_VECTORS;
        if (push.surfaces > 0 || push.step == STEP_SUM || goes_on) {
            peeled.light[row] = state[at];
            peeled.depth[row] = state[at + 1].x;
            peeled.weight[row] = state[at + 1].y;
        }
        if (push.step == STEP_SUM || push.step == STEP_SEE && goes_on) {
            visible[row] = state[at + 1].z;
        }
        if (push.step != STEP_SEE && goes_on) {
            colors[row] = state[at + 2];
            normals[row] = state[at + 3];
        }
    }
    if (!is_left(peeled)) {
        range.first = range.end; // the tile's last layer was found
    }
    if (push.step == STEP_SEE) {
        see(range, at_px, peeled, visible);
    }
    if (push.step == STEP_SUM) {
        sum(range, at_px, peeled, visible, colors, normals);
        if (push.ends != 0) {
            compose(at_px, visible, colors, normals, peeled);
        }
    }
    if (push.step == STEP_REST) {
        float weights[ROWS];
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            weights[row] = normals[row].x;
        }
        sum_rest(range, at_px, peeled, colors, weights);
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            normals[row].x = weights[row];
        }
        if (push.ends != 0) {
            compose_rest(colors, weights, peeled);
        }
    }
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        uint at = states + uint(row) * STATE_VECTORS;
        state[at] = peeled.light[row];
        state[at + 1] = vec4(peeled.depth[row], peeled.weight[row], visible[row], 0.0);
        state[at + 2] = colors[row];
        state[at + 3] = normals[row];
    }
#else
    // Of several dispatches, those after the last layer have nothing to do.
    for (uint layer = 0; layer < push.surfaces && is_left(peeled); layer++) {
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            colors[row] = vec4(0.0);
            normals[row] = vec4(0.0);
            visible[row] = peeled.opaque[row];
        }
        see(range, at_px, peeled, visible);
        sum(range, at_px, peeled, visible, colors, normals);
        compose(at_px, visible, colors, normals, peeled);
    }
    if (push.blends_rest != 0) {
        float weights[ROWS];
        [[unroll]] for (int row = 0; row < ROWS; row++) {
            colors[row] = vec4(0.0);
            weights[row] = 0.0;
        }
        sum_rest(range, at_px, peeled, colors, weights);
        compose_rest(colors, weights, peeled);
    }
#endif
    [[unroll]] for (int row = 0; row < ROWS; row++) {
        ivec2 pixel = pixel_of(top, row);
        imageStore(layers, pixel, peeled.light[row]);
#if defined(SEVERAL)
        imageStore(peeled_depth, pixel, vec4(peeled.depth[row]));
        imageStore(peeled_weight, pixel, vec4(peeled.weight[row]));
#endif
    }
}
