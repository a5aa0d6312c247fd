// Transparent layers of a tile's splats, all in one dispatch: peeling (inc/peel.glsl proves that no surface is lost or taken
// twice), accumulation, shading, and composition from front to back, with the depths, the sums and the light so far in
// registers. The graphics pipeline needs three passes a layer for that (src/passes/layers.rs).
//
// BEHIND: opaque things hide what is behind them. SEVERAL: one of several dispatches, whose light, depth and weight go on in
// images: loops have an end on llvmpipe (inc/tiles.glsl). PARTS: of the tiles with more splats than that leaves room for, a
// step of one layer and a part of their splats in each dispatch, with all that is found kept in a buffer. LIT: the scene has lights of its own. HALF, SINGLE: of the light in
// its image. DIRECT: as in tile_splat.comp.glsl.
// Permutations: half single | _ lit | _ behind | _ several parts | _ direct
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#if !defined(DIRECT)
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#endif
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "inc/tiles.glsl"
#include "inc/tile_batch.glsl"
#define LIGHTS_SET 0
#define LIGHTS_BINDING 16
#include "inc/shading.glsl"

layout(local_size_x = TILE) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 6, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 8, std430) readonly buffer SeenTiles { uint seen_tiles[]; };

#if defined(HALF)
layout(set = 0, binding = 11, rgba16f) uniform image2D layers; // alpha * linear color, alpha
#else
layout(set = 0, binding = 11, rgba32f) uniform image2D layers;
#endif
#if defined(PARTS)
layout(set = 0, binding = 10, std430) readonly buffer OverfullTiles { uint overfull_tiles[]; };
layout(set = 0, binding = 18, std430) buffer PeeledState { vec4 state[]; };
layout(constant_id = 21) const uint PART_LENGTH = 200000;
#define STATE_VECTORS 4
#else
layout(constant_id = 19) const uint PART = 200000; // entries of a tile that one dispatch takes (inc/tiles.glsl)
#endif
#if defined(SEVERAL)
layout(set = 0, binding = 13, r32f) uniform image2D peeled_depth;
layout(set = 0, binding = 17, r32f) uniform image2D peeled_weight;
#endif
#if defined(BEHIND)
layout(set = 0, binding = 14) uniform texture2D opaque_depth;
#endif

layout(constant_id = 20) const bool STACKED = false; // the last layer counts as several surfaces (layer.frag.glsl)

const float LEAST_WEIGHT = 5.9604645e-8; // 2^-24
const float INFINITELY_NEAR = 2.0;       // nearer than any depth, which is 1 at most
const float NOTHING_LEFT = 0.0;          // no depth is below
const float MOST_SURFACES = 8.0;         // as in layer.frag.glsl

// Steps of a layer in PARTS; src/passes/tiles/layers.rs names the same.
#define STEP_SEE 0
#define STEP_SUM 1
#define STEP_REST 2

// A column of pixels: what is found of it so far.
struct Peeled {
    vec4 light[TILE];    // alpha * linear color, alpha
    float depth[TILE];   // of the layer before
    float weight[TILE];  // of the layer before
    float opaque[TILE];  // the depth of opaque things
};

float weight_of(vec3 uvw, float share, bool inside)
{
    float r2 = dot(uvw.xy, uvw.xy);
    r2 = AFFINE ? r2 : r2 / (uvw.z * uvw.z);
    float weight = kernel_weight(r2);
    weight = WEIGHTED ? max(weight * share, LEAST_WEIGHT) : weight;
    return inside ? weight : 0.0;
}

vec4 under(vec4 light, vec4 layer)
{
    return light + (1.0 - light.a) * layer;
}

vec3 to_eye(vec2 at_px)
{
    return -normalize(vec3(FORMULA(FORMULA_EYE_DIRECTION, at_px / push.focal_px), 1.0));
}

vec3 turned(vec3 normal, vec3 v)
{
    return dot(normal, v) < 0.0 ? -normal : normal;
}

// The nearest surface behind the layer before: its depth, shifted by epsilon.
void see(uint first, uint end, vec2 at_px, Peeled peeled, inout float visible[TILE])
{
    for (uint base = first; base < end; base += BATCH) {
        Batch batch = load_batch(base, end);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            float inverse_shift = handed(batch.r0.w, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth)
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                visible[row] = inside ? max(visible[row], depth * inverse_shift) : visible[row];
            }
        }
    }
}

// What belongs to that surface: weighted color and weight, weighted normal and alpha.
void sum(uint first, uint end, vec2 at_px, Peeled peeled, float visible[TILE], inout vec4 colors[TILE], inout vec4 normals[TILE])
{
    for (uint base = first; base < end; base += BATCH) {
        Batch batch = load_batch(base, end);
        Look look = load_look(batch);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            vec4 color = vec4(handed(look.color, k), 1.0);
            vec4 normal = vec4(handed(look.normal, k), handed(look.alpha, k));
            float share = handed(look.share, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= visible[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, share, inside);
                colors[row] += weight * color;
                normals[row] += weight * normal;
            }
        }
    }
}

// Shades that surface and puts it under the light so far. Answers whether any pixel of the column has it.
bool compose(vec2 at_px, float visible[TILE], vec4 colors[TILE], vec4 normals[TILE], inout Peeled peeled)
{
    bool some = false;
    [[unroll]] for (int row = 0; row < TILE; row++) {
        float weight = colors[row].w;
        bool covered = weight > 0.0;
        vec3 v = to_eye(at_px + vec2(0.0, float(row)));
        float length2 = dot(normals[row].xyz, normals[row].xyz);
        vec3 normal = length2 > 0.0 ? normals[row].xyz * inversesqrt(length2) : vec3(0.0, 0.0, -1.0);
        vec3 albedo = FORMULA(FORMULA_NORMALIZED_COLOR, colors[row].rgb / weight);
        float alpha = normals[row].w / weight;
        vec3 light = shaded(albedo, turned(normal, v), v);
        peeled.light[row] = covered ? under(peeled.light[row], vec4(alpha * light, alpha)) : peeled.light[row];
        peeled.depth[row] = covered ? visible[row] : NOTHING_LEFT;
        peeled.weight[row] = weight;
        some = some || covered;
    }
    return some;
}

// All that is left, for one layer: each splat lit by itself, at its center; weight * alpha * light, weight * alpha; weight.
void sum_rest(uint first, uint end, vec2 at_px, Peeled peeled, inout vec4 colors[TILE], inout float weights[TILE])
{
    for (uint base = first; base < end; base += BATCH) {
        Batch batch = load_batch(base, end);
        Look look = load_look(batch);
        vec3 v = to_eye(batch.r0.xy);
        vec3 lit = look.alpha * shaded(look.color, turned(look.normal, v), v);
        [[unroll]] for (uint k = 0; k < BATCH; k++) {
            Column column = column_of(batch, k, at_px);
            vec4 color = vec4(handed(lit, k), handed(look.alpha, k));
            float share = handed(look.share, k);
            [[unroll]] for (int row = 0; row < TILE; row++) {
                vec3 uvw = uvw_of(column, row);
                float depth = column.w0 * uvw.z;
                bool inside = is_inside(uvw) && is_beyond_near(depth) && depth >= peeled.opaque[row]
                    && depth < FORMULA_LESS(FORMULA_PEELED, peeled.depth[row]);
                float weight = weight_of(uvw, share, inside);
                colors[row] += weight * color;
                weights[row] += weight;
            }
        }
    }
}

void compose_rest(vec4 colors[TILE], float weights[TILE], inout Peeled peeled)
{
    [[unroll]] for (int row = 0; row < TILE; row++) {
        bool covered = colors[row].a > 0.0 && weights[row] > 0.0;
        float alpha = min(colors[row].a / weights[row], 1.0);
        if (STACKED) {
            float surfaces = clamp(weights[row] / max(peeled.weight[row], 1.0), 1.0, MOST_SURFACES);
            alpha = 1.0 - pow(1.0 - alpha, FORMULA(FORMULA_STACKED, surfaces));
        }
        vec4 layer = vec4(alpha * (colors[row].rgb / colors[row].a), alpha);
        peeled.light[row] = covered ? under(peeled.light[row], layer) : peeled.light[row];
    }
}

// Whether anything may be behind what was peeled off the tile. All of its invocations load records for each other.
bool is_left(Peeled peeled)
{
    bool left = false;
    [[unroll]] for (int row = 0; row < TILE; row++) {
        left = left || peeled.depth[row] > NOTHING_LEFT;
    }
#if defined(DIRECT)
    return left;
#else
    return subgroupAny(left);
#endif
}

void main()
{
#if defined(PARTS)
    uint slot = GROUP_NUMBER;
    if (slot >= starts[STARTS_OVERFULL]) {
        return;
    }
    uint tile = overfull_tiles[slot];
    uint begin = starts[tile];
    uint finish = starts[tile + 1];
    uint first = min(begin + push.part * PART_LENGTH, finish);
    uint end = min(first + PART_LENGTH, finish);
#else
    if (GROUP_NUMBER >= starts[STARTS_SEEN]) {
        return;
    }
    uint tile = seen_tiles[GROUP_NUMBER];
    uint first = starts[tile];
    uint end = starts[tile + 1];
    if (end - first > PART) {
        return;
    }
#endif
    uint lane = gl_LocalInvocationID.x;
    ivec2 pixel = TILE * ivec2(tile % push.tiles_x, tile / push.tiles_x) + ivec2(lane, 0);
    ivec2 last_pixel = ivec2(2.0 * push.half_size_px) - 1;
    vec2 at_px = vec2(pixel) + 0.5 - push.half_size_px;

    Peeled peeled;
    vec4 colors[TILE];
    vec4 normals[TILE]; // of the rest, the first component is the weight
    float visible[TILE];
    [[unroll]] for (int row = 0; row < TILE; row++) {
        ivec2 place = pixel + ivec2(0, row);
        peeled.light[row] = vec4(0.0);
        peeled.depth[row] = INFINITELY_NEAR;
        peeled.weight[row] = 0.0;
        peeled.opaque[row] = 0.0;
#if defined(BEHIND)
        peeled.opaque[row] = texelFetch(opaque_depth, min(place, last_pixel), 0).r;
#endif
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
        visible[row] = peeled.opaque[row];
#if defined(SEVERAL)
        if (push.part > 0) {
            peeled.light[row] = imageLoad(layers, place);
            peeled.depth[row] = imageLoad(peeled_depth, place).r;
            peeled.weight[row] = imageLoad(peeled_weight, place).r;
        }
#endif
    }
#if defined(PARTS)
    // What is found of the tile so far. Loops that have nothing to do in this step begin at their end.
    uint states = (slot * TILE + lane) * TILE * STATE_VECTORS;
    bool goes_on = push.part > 0;
    [[unroll]] for (int row = 0; row < TILE; row++) {
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
        first = end; // the tile's last layer was found
    }
    see(push.step == STEP_SEE ? first : end, end, at_px, peeled, visible);
    sum(push.step == STEP_SUM ? first : end, end, at_px, peeled, visible, colors, normals);
    if (push.step == STEP_SUM && push.ends != 0) {
        compose(at_px, visible, colors, normals, peeled);
    }
    if (push.step == STEP_REST) {
        float weights[TILE];
        [[unroll]] for (int row = 0; row < TILE; row++) {
            weights[row] = normals[row].x;
        }
        sum_rest(first, end, at_px, peeled, colors, weights);
        [[unroll]] for (int row = 0; row < TILE; row++) {
            normals[row].x = weights[row];
        }
        if (push.ends != 0) {
            compose_rest(colors, weights, peeled);
        }
    }
    [[unroll]] for (int row = 0; row < TILE; row++) {
        uint at = states + uint(row) * STATE_VECTORS;
        state[at] = peeled.light[row];
        state[at + 1] = vec4(peeled.depth[row], peeled.weight[row], visible[row], 0.0);
        state[at + 2] = colors[row];
        state[at + 3] = normals[row];
    }
#else
    // Of several dispatches, those after the last layer have nothing to do.
    bool some = is_left(peeled);
    for (uint layer = 0; layer < push.surfaces && some; layer++) {
        [[unroll]] for (int row = 0; row < TILE; row++) {
            colors[row] = vec4(0.0);
            normals[row] = vec4(0.0);
            visible[row] = peeled.opaque[row];
        }
        see(first, end, at_px, peeled, visible);
        sum(first, end, at_px, peeled, visible, colors, normals);
        some = compose(at_px, visible, colors, normals, peeled);
#if !defined(DIRECT)
        some = subgroupAny(some); // all of them load records for each other
#endif
    }
    if (push.blends_rest != 0) {
        float weights[TILE];
        [[unroll]] for (int row = 0; row < TILE; row++) {
            colors[row] = vec4(0.0);
            weights[row] = 0.0;
        }
        sum_rest(first, end, at_px, peeled, colors, weights);
        compose_rest(colors, weights, peeled);
    }
#endif
    [[unroll]] for (int row = 0; row < TILE; row++) {
        ivec2 place = pixel + ivec2(0, row);
        imageStore(layers, place, peeled.light[row]);
#if defined(SEVERAL)
        imageStore(peeled_depth, place, vec4(peeled.depth[row]));
        imageStore(peeled_weight, place, vec4(peeled.weight[row]));
#endif
    }
}
