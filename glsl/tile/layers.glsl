// Transparent layers of a tile's splats, from front to back: each is seen, summed, shaded, and put under the light so far; all that is
// left behind them is the last one. Depths, sums and light stay in registers.
//
// COVERAGE_EDGES: light T that comes through layers is the mean of a pixel, but both sides of a ball end at the same outline: where the near one covers a part p, the far one is seen through
// it all over p, by 1 - alpha and not by 1 - p alpha. So of the part p that ended it is known how much light T_in comes through there; beside it comes (T - p T_in) / (1 - p). Of a layer
// that covers c, and ends where the other side of it has, min(c, p) lies behind p, and what is left beside it; any other layer has c T of all. Of the same side it may be what an epsilon has
// left. What ended and what ends now are kept by how much of the pixel's light each changes.

#include "tile/lanes.glsl"
#include "tile/work.glsl"
#define PEELS true
#define OF_LAYERS true
#include "tile/surface.glsl"
#include "tile/ended.glsl"
#include "inc/normalized.glsl"

layout(constant_id = SPEC_DEPTH_PRELOADED) const bool DEPTH_PRELOADED = false; // opaque things hide what is behind them
layout(set = 0, binding = BIND_DEPTH_BEFORE) uniform texture2D opaque_depth;
layout(constant_id = SPEC_STACKED) const bool STACKED = false; // as in layer.frag.glsl

// Of the invocation's pixels.
vec4 light[ROWS];          // alpha * linear color, alpha
float weight_before[ROWS]; // of the layer before

// COVERAGE_EDGES: of what ended.
vec2 ended[ROWS];          // how it falls (tile/ended.glsl)
float ended_part[ROWS];    // p
bool ended_away[ROWS];     // whether it faces away
float light_through[ROWS]; // T_in

// Between dispatches.
vec4 stored_ended(int row)
{
    return vec4(ended[row], ended_away[row] ? -ended_part[row] : ended_part[row], light_through[row]);
}

void load_ended(vec4 stored, int row)
{
    ended[row] = stored.xy;
    ended_part[row] = abs(stored.z);
    ended_away[row] = stored.z < 0.0;
    light_through[row] = stored.w;
}

void begin_layers()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        light[row] = vec4(0.0);
        before[row] = INFINITELY_NEAR;
        before_away[row] = INFINITELY_NEAR;
        weight_before[row] = 0.0;
        ended[row] = vec2(0.0);
        ended_part[row] = 1.0;
        ended_away[row] = false;
        light_through[row] = 1.0;
        opaque[row] = DEPTH_PRELOADED ? texelFetch(opaque_depth, pixel_within_image(row), 0).r : 0.0;
    }
}

void begin_surface()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        visible[row] = 0.0;
        visible_away[row] = false;
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

vec4 under(vec4 light, vec4 layer)
{
    return light + (1.0 - light.a) * layer;
}

// Puts a layer that covers so much of the pixel under the light so far. `shown`: its own light and alpha, where it is.
void put_part_under(vec4 shown, float part, int row)
{
    float left = 1.0 - light[row].a; // T
    float through = light_through[row];
    float p = ended_part[row];
    float behind = visible_away[row] != ended_away[row] ? part_behind(fall[row], ended[row]) : 0.0;
    float beside = (left - p * through) / max(1.0 - p, 1e-3);
    float seen = min(part, p) * through + max(part - p, 0.0) * beside;
    float share = mix(part * left, FORMULA(FORMULA_LAYER_BEHIND, seen), behind);
    light[row] += share * shown;
    float changed = p * (1.0 - p) * (left - through);
    float changes = part * (1.0 - part) * shown.a * left;
    float keeps = changed / max(changed + changes, 1e-9);
    float own_through = (1.0 - shown.a) * share / max(part, 1e-6);
    float kept_through = through * (1.0 - shown.a * mix(part, min(part / max(p, 1e-6), 1.0), behind));
    light_through[row] = mix(own_through, kept_through, keeps);
    ended_part[row] = mix(part, p, keeps);
    ended_away[row] = keeps < 0.5 ? visible_away[row] : ended_away[row];
    ended[row] = mix(fall[row], ended[row], keeps);
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
