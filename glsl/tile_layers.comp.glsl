// Transparent layers of a tile's splats, all in one dispatch: peeling (inc/peel.glsl proves that no surface is lost or taken
// twice), accumulation, shading, and composition from front to back. The graphics pipeline needs three passes a layer for that
// (src/passes/layers/frame.rs). Overflow tiles are left to tile_layers_overflow.comp.glsl.
// Permutations: column pixel
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "tile/constants.glsl"
#include "tile/layers.glsl"

layout(set = 0, binding = BIND_COLORS) writeonly uniform image2D layers; // alpha * linear color, alpha

// One of several dispatches, for loops have an end on llvmpipe (tile/work.glsl): light, depth and weight go on in images.
layout(constant_id = SPEC_SEVERAL) const bool SEVERAL = false;
layout(set = 0, binding = BIND_NORMALS) writeonly uniform image2D peeled; // depth and weight of the layer before, depth of the last one that faces away, and what layers of one surface cover
layout(set = 0, binding = BIND_COLORS_BEFORE) uniform texture2D layers_before;
layout(set = 0, binding = BIND_NORMALS_BEFORE) uniform texture2D peeled_before;
// COVERAGE_EDGES: and what ended (tile/stack.glsl).
layout(set = 0, binding = BIND_VISIBLE_DEPTH) writeonly uniform image2D ends;
layout(set = 0, binding = BIND_VISIBLE_BEFORE) uniform texture2D ends_before;

void main()
{
    Range range;
    if (!find_work(true, range)) {
        return;
    }
    begin_layers();
    if (SEVERAL && push.part > 0) {
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            ivec2 pixel = pixel_within_image(row);
            light[row] = texelFetch(layers_before, pixel, 0);
            before[row] = texelFetch(peeled_before, pixel, 0).r;
            weight_before[row] = texelFetch(peeled_before, pixel, 0).g;
            before_away[row] = texelFetch(peeled_before, pixel, 0).b;
            if (COVERAGE_EDGES) {
                surface_part[row] = texelFetch(peeled_before, pixel, 0).a;
                load_ended(texelFetch(ends_before, pixel, 0), row);
            }
        }
    }
    // Of several dispatches, those after the last layer have nothing to do.
    uint layer = 0;
    if (layer < push.surfaces && is_left()) {
        do {
            begin_surface();
            see(range);
            end_seeing();
            sum(range, false);
            compose();
            layer++;
        } while (layer < push.surfaces && is_left());
    }
    if (push.blends_rest != 0) {
        begin_surface();
        takes_both_sides = true;
        end_seeing();
        sum(range, true);
        compose_rest();
    }
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        imageStore(layers, pixel_of(row), light[row]);
        if (SEVERAL) {
            imageStore(peeled, pixel_of(row), vec4(before[row], weight_before[row], before_away[row], surface_part[row]));
            if (COVERAGE_EDGES) {
                imageStore(ends, pixel_of(row), stored_ended(row));
            }
        }
    }
}
