// What a pixel shows of its layers, from front to back: each is put *under* the light so far.
//
// COVERAGE_EDGES: light T that comes through layers is the mean of a pixel, but what ends in it has a place there.
//
// Both sides of a ball end at the same outline: where the near one covers a part p, the far one is seen through it all over p, by 1 - alpha and not by 1 - p alpha. So of the part p that
// ended it is known how much light T_in comes through there; beside it comes (T - p T_in) / (1 - p). Of a layer that covers c, and ends where the other side of it has, min(c, p) lies
// behind p, and what is left beside it; any other layer has c T of all. What ended and what ends now are kept by how much of the pixel's light each changes.
//
// CURVED: of surfaces with sharp edges an epsilon is by how planes meet, a small part of a radius. Where such a surface bends it takes some of it alone, and leaves the rest to the next
// layer, which shows the same side and begins where this one ends, within SEAM of its own epsilon. Such a layer *goes on*: all layers of a surface cover the pixel once, beside each other. A surface behind another one begins farther off, unless both are within 1 + SEAM epsilons.

#include "tile/ended.glsl"

// Of the invocation's pixels.
vec4 light[ROWS];          // alpha * linear color, alpha

// COVERAGE_EDGES: of what ended.
vec2 ended[ROWS];          // how it falls (tile/ended.glsl)
float ended_part[ROWS];    // p
bool ended_away[ROWS];     // whether it faces away
float light_through[ROWS]; // T_in
bool ended_last[ROWS];     // whether it is the surface of the layer before

float surface_part[ROWS];  // CURVED: what all layers of that surface cover

void begin_stack(int row)
{
    light[row] = vec4(0.0);
    ended[row] = vec2(0.0);
    ended_part[row] = 1.0;
    ended_away[row] = false;
    light_through[row] = 1.0;
    ended_last[row] = false;
    surface_part[row] = 0.0;
}

// Between dispatches.
vec4 stored_ended(int row)
{
    return vec4(ended[row], ended_away[row] ? -ended_part[row] : ended_part[row], ended_last[row] ? -1.0 - light_through[row] : light_through[row]);
}

void load_ended(vec4 stored, int row)
{
    ended[row] = stored.xy;
    ended_part[row] = abs(stored.z);
    ended_away[row] = stored.z < 0.0;
    ended_last[row] = stored.w < 0.0;
    light_through[row] = ended_last[row] ? -1.0 - stored.w : stored.w;
}

vec4 under(vec4 light, vec4 layer)
{
    return light + (1.0 - light.a) * layer;
}

// Whether the layer goes on with the surface of the one before. That is the one whose depth is less, of those that face the eye and those that face away.
bool goes_on(int row)
{
    bool last_away = before_away[row] < before[row];
    return visible_away[row] == last_away && min(before[row], before_away[row]) <= goes_on_from[row];
}

// Puts a layer that would cover so much of the pixel by itself under the light so far. `shown`: its own light and alpha, where it is.
void put_part_under(vec4 shown, float alone, int row)
{
    bool on = CURVED && goes_on(row);
    float part = on ? max(min(alone, 1.0 - surface_part[row]), 0.0) : alone;
    surface_part[row] = on ? surface_part[row] + part : part;
    float left = 1.0 - light[row].a; // T
    float through = light_through[row];
    float p = ended_part[row];
    float beside = max(left - p * through, 0.0) / max(1.0 - p, 1e-3);
    float behind = visible_away[row] != ended_away[row] ? part_behind(fall[row], ended[row]) : 0.0;
    float seen = min(part, p) * through + max(part - p, 0.0) * beside;
    bool grows = on && ended_last[row];
    float share = grows ? FORMULA(FORMULA_LAYER_BESIDE, part * beside) : mix(part * left, FORMULA(FORMULA_LAYER_BEHIND, seen), behind);
    light[row] += share * shown;
    float own_through = (1.0 - shown.a) * share / max(part, 1e-6);
    if (grows) {
        ended[row] += fall[row];
        ended_part[row] = min(p + part, 1.0);
        light_through[row] = mix(through, own_through, part / max(p + part, 1e-6));
        return;
    }
    float changed = max(p * (1.0 - p) * (left - through), 0.0);
    float changes = part * (1.0 - part) * shown.a * left;
    float keeps = changed / max(changed + changes, 1e-9);
    float kept_through = through * (1.0 - shown.a * mix(part, min(part / max(p, 1e-6), 1.0), behind));
    light_through[row] = mix(own_through, kept_through, keeps);
    ended_part[row] = mix(part, p, keeps);
    ended_last[row] = keeps < 0.5;
    ended_away[row] = ended_last[row] ? visible_away[row] : ended_away[row];
    ended[row] = mix(fall[row], ended[row], keeps);
}

