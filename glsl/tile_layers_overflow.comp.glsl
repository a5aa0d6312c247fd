// Transparent layers of tiles with more splats than one dispatch takes: a step of one layer and a part of their splats in each
// dispatch, with all that is found kept in a buffer.
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
layout(set = 0, binding = BIND_LAYER_STATE, std430) buffer LayerState { vec4 state[]; };

const uint VECTORS = STATE_VECTORS + (COVERAGE_EDGES ? EDGE_STATE_VECTORS : 0);

uint place_of_state(int row)
{
    uint column = GROUP_NUMBER * TILE_WIDTH + gl_LocalInvocationID.x;
    return (column * TILE_HEIGHT + OWN_ROW + row) * VECTORS;
}

void main()
{
    Range range;
    if (!find_work(false, range)) {
        return;
    }
    bool goes_on = push.part > 0;
    begin_layers();
    begin_surface();
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        uint place = place_of_state(row);
        if (push.surfaces > 0 || push.step == STEP_SUM || goes_on) {
            light[row] = state[place];
            before[row] = state[place + 1].x;
            weight_before[row] = state[place + 1].y;
            before_away[row] = state[place + 1].w;
            if (COVERAGE_EDGES) {
                load_ended(state[place + 5], row);
                surface_part[row] = state[place + 6].x;
            }
        }
        if (push.step == STEP_SUM || push.step == STEP_SEE && goes_on) {
            visible_away[row] = state[place + 1].z < 0.0;
            visible[row] = abs(state[place + 1].z);
            if (COVERAGE_EDGES) {
                goes_on_from[row] = state[place + 6].y;
            }
        }
        if (push.step != STEP_SEE && goes_on) {
            colors[row] = state[place + 2];
            normals[row] = state[place + 3];
            if (COVERAGE_EDGES) {
                fall[row] = state[place + 4].xy;
                gap[row] = state[place + 4].z;
                summed[row] = state[place + 4].w;
            }
        }
    }
    if (!is_left()) {
        range = Range(range.end, range.end, range.end); // the tile's last layer was found
    }
    if (push.step == STEP_SEE) {
        see(range);
    } else {
        end_seeing();
        takes_both_sides = push.step == STEP_REST;
        sum(range, push.step == STEP_REST);
    }
    if (push.step == STEP_SUM && push.ends != 0) {
        compose();
    }
    if (push.step == STEP_REST && push.ends != 0) {
        compose_rest();
    }
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        uint place = place_of_state(row);
        state[place] = light[row];
        state[place + 1] = vec4(before[row], weight_before[row], visible_away[row] ? -visible[row] : visible[row], before_away[row]);
        state[place + 2] = colors[row];
        state[place + 3] = normals[row];
        if (COVERAGE_EDGES) {
            state[place + 4] = vec4(fall[row], gap[row], summed[row]);
            state[place + 5] = stored_ended(row);
            state[place + 6] = vec4(surface_part[row], goes_on_from[row], 0.0, 0.0);
        }
        imageStore(layers, pixel_of(row), light[row]);
    }
}
