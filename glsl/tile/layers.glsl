// Transparent layers of a tile's splats, from front to back: each is seen, summed, shaded, and put under the light so far; all that is
// left behind them is the last one. Depths, sums and light stay in registers.

#include "tile/lanes.glsl"
#include "tile/work.glsl"
#define PEELS true
#define OF_LAYERS true
#include "tile/surface.glsl"
#include "tile/stack.glsl"
#include "inc/normalized.glsl"

layout(constant_id = SPEC_DEPTH_PRELOADED) const bool DEPTH_PRELOADED = false; // opaque things hide what is behind them
layout(set = 0, binding = BIND_DEPTH_BEFORE) uniform texture2D opaque_depth;
layout(constant_id = SPEC_STACKED) const bool STACKED = false; // as in layer.frag.glsl

float weight_before[ROWS]; // of the layer before of each of the pixels

void begin_layers()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        before[row] = INFINITELY_NEAR;
        before_away[row] = INFINITELY_NEAR;
        weight_before[row] = 0.0;
        begin_stack(row);
        opaque[row] = DEPTH_PRELOADED ? texelFetch(opaque_depth, pixel_within_image(row), 0).r : 0.0;
    }
}

void begin_surface()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        visible[row] = 0.0;
        visible_away[row] = false;
        goes_on_from[row] = NOTHING_LEFT;
        begin_covering(row);
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
    }
}

// What was seen is not behind opaque things.
void end_seeing()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        visible[row] = max(visible[row], opaque[row]);
    }
}

// Shades the surface that was summed, and puts it under the light so far.
void compose()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        float weight = colors[row].w;
        bool covered = weight > 0.0;
        vec3 v = to_eye(top_px + vec2(0.0, float(first_row + row)));
        vec3 normal = normal_of_sum(normals[row].xyz);
        vec3 albedo = FORMULA(FORMULA_NORMALIZED_COLOR, colors[row].rgb / weight);
        float alpha = normals[row].w / weight;
        vec3 shown = shaded(albedo, turned(normal, v), v);
        vec4 layer = covered ? vec4(alpha * shown, alpha) : vec4(0.0);
        if (COVERAGE_EDGES) {
            put_part_under(layer, covered ? opacity_of(row) : 1.0, row);
        } else {
            light[row] = under(light[row], layer);
        }
        bool away = BY_SIDES && visible_away[row];
        before_away[row] = !covered ? NOTHING_LEFT : away ? visible[row] : before_away[row];
        before[row] = !covered ? NOTHING_LEFT : away ? before[row] : visible[row];
        weight_before[row] = weight;
    }
}

// The same of all that is left, whose splats were lit by themselves, as one layer.
void compose_rest()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        float weight = colors[row].w;
        float weighted_alpha = normals[row].w;
        bool covered = weighted_alpha > 0.0 && weight > 0.0;
        float alpha = min(weighted_alpha / weight, 1.0);
        if (STACKED) {
            float surfaces = clamp(weight / max(weight_before[row], 1.0), 1.0, MOST_STACKED_SURFACES);
            alpha = 1.0 - pow(1.0 - alpha, FORMULA(FORMULA_STACKED, surfaces));
        }
        alpha *= COVERAGE_EDGES ? opacity_of(row) : 1.0;
        vec4 layer = vec4(alpha * (colors[row].rgb / weighted_alpha), alpha);
        light[row] = covered ? under(light[row], layer) : light[row];
    }
}

// Whether anything may be behind what was peeled off the tile. All of its invocations load records for each other.
bool is_left()
{
    bool left = false;
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        left = left || before[row] > NOTHING_LEFT || BY_SIDES && before_away[row] > NOTHING_LEFT;
    }
    return votes_of_tile(left).y > 0;
}
