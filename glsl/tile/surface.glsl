// Visibility and accumulation of a tile's splats (Guennebaud et al. 2006, section 2, as in visibility.frag.glsl and
// accumulate.frag.glsl), with depths and sums in registers: the single-pass splatting that Pajarola et al. 2003 name as future
// work. One workgroup a tile, splats batch by batch. The condition is behind a batch, since llvmpipe runs a loop's body
// once more than one before it says, with nothing to write; of an empty part the batch covers nothing.

#define LIT
#define LIGHTS_SET 0
#define LIGHTS_BINDING BIND_LIGHTS
#include "inc/shading.glsl"
#define POLYGON_REACH push.polygon_reach
#include "tile/pixel.glsl"
#include "tile/clip.glsl"

Splat load_splat(uint base, uint end)
{
    uint number = base + OWN_LANE;
    uint record = entry(min(number, end - 1));
    vec4 r0 = record0(record);
    float shift = TWO_SIDED && !BY_SIDES ? abs(r0.w) : r0.w;
    float w0 = PARTED && !CUTS ? abs(r0.z) : r0.z; // of a clipped one that is whole in the tile
    Splat splat = Splat(record, r0.xy, w0, shift, record1(record), record2(record).xy);
    if (number >= end) {
        // Behind the list's end: far off, with a map that covers nothing there.
        splat = Splat(record, vec2(1e9), 1.0, 1.0, vec4(1.0, 0.0, 0.0, 1.0), vec2(0.0));
    }
    return splat;
}

SplatAttributes load_attributes(Splat splat)
{
    vec4 r2 = record2(splat.record);
    uvec4 r3 = record3(splat.record);
    vec2 red_green = unpackUnorm2x16(r3.z);
    vec2 blue_alpha = unpackUnorm2x16(r3.w);
    SplatAttributes attributes;
    attributes.color = FORMULA(FORMULA_COLOR, vec3(red_green, blue_alpha.x));
    attributes.alpha = FORMULA(FORMULA_ALPHA, blue_alpha.y);
    attributes.normal = vec3(r2.w, uintBitsToFloat(r3.xy));
    attributes.share = REACHES ? abs(r2.z) : r2.z;
    attributes.own_part = COVERAGE_EDGES ? own_coverage(splat.uv) : vec2(0.0);
    attributes.outline = OUTLINED ? outline_of(splat.uv, 1.0 - blue_alpha.y) : vec4(0.0);
    attributes.reach = vec4(vec2(1.0), vec2(attributes.own_part.y));
    if (REACHES && floatBitsToInt(r2.z) < 0) {
        attributes.own_part.x = border_distance(splat.uv, attributes.reach);
    }
    if (BLENDED) {
        attributes.own_part *= attributes.alpha; // of what is opaque (tile_project.comp.glsl)
    }
    return attributes;
}

vec3 turned(vec3 normal, vec3 v)
{
    return dot(normal, v) < 0.0 ? -normal : normal;
}

// Of all splats that are loaded at once, the place where a batch begins; at 0 they have to be loaded.
uint place_of(uint base, uint first)
{
    return LOADED == TILE_BATCH ? 0 : (base - first) % LOADED;
}

// Whether what is loaded at once is taken in several steps before more is loaded.
bool in_steps(bool clipped)
{
    return CLIPS && clipped && CLIPPED_BATCH < TILE_BATCH;
}

void see_batch(Splat own, OwnCurves own_curves, uint batch, uint place, bool clipped)
{
    [[unroll]] for (uint first = 0; first < batch; first += AT_ONCE) {
        Splat splats[AT_ONCE];
        [[unroll]] for (uint k = 0; k < min(AT_ONCE, batch); k++) {
            splats[k] = broadcast(own, place + first + k);
        }
        Kept kept[AT_ONCE][ROWS];
        find_kept(clipped, min(AT_ONCE, batch), own_curves, splats, place + first, true, kept);
        [[unroll]] for (uint k = 0; k < min(AT_ONCE, batch); k++) {
            Column column = column_of(splats[k]);
            [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
                see(splats[k], column, kept[k][row], row);
            }
        }
    }
}

void see(uint list_first, uint end, bool clipped)
{
    uint batch = CLIPS && clipped ? CLIPPED_BATCH : TILE_BATCH;
    Splat own;
    OwnCurves own_curves;
    uint base = list_first;
    do {
        uint place = place_of(base, list_first);
        if (place == 0) {
            own = load_splat(base, end);
            stage_shared(own);
            own_curves = load_curves(own, clipped);
        }
        do {
            see_batch(own, own_curves, batch, place, clipped);
            place += batch;
        } while (in_steps(clipped) && place < LOADED && base + place < end);
        base += in_steps(clipped) ? LOADED : TILE_BATCH;
    } while (base < end);
}

void sum_batch(Splat own, SplatAttributes own_attributes, OwnCurves own_curves, uint batch, uint place, bool clipped)
{
    [[unroll]] for (uint first = 0; first < batch; first += AT_ONCE) {
        Splat splats[AT_ONCE];
        SplatAttributes attributes[AT_ONCE];
        Column columns[AT_ONCE];
        [[unroll]] for (uint k = 0; k < min(AT_ONCE, batch); k++) {
            splats[k] = broadcast(own, place + first + k);
            attributes[k] = broadcast(own_attributes, place + first + k);
            columns[k] = column_of(splats[k]);
        }
        Kept kept[AT_ONCE][ROWS];
        find_kept(clipped, min(AT_ONCE, batch), own_curves, splats, place + first, false, kept);
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            [[unroll]] for (uint k = 0; k < min(AT_ONCE, batch); k++) {
                add(splats[k], attributes[k], columns[k], kept[k][row], row);
            }
        }
    }
}

void sum(uint list_first, uint end, bool clipped, bool lit)
{
    uint batch = CLIPS && clipped ? CLIPPED_BATCH : TILE_BATCH;
    Splat own;
    SplatAttributes own_attributes;
    OwnCurves own_curves;
    uint base = list_first;
    do {
        uint place = place_of(base, list_first);
        if (place == 0) {
            own = load_splat(base, end);
            stage_shared(own);
            own_attributes = load_attributes(own);
            if (lit) {
                vec3 v = to_eye(own.x0_px);
                vec3 normal = turned(own_attributes.normal, v);
                own_attributes.color = own_attributes.alpha * shaded(own_attributes.color, normal, v);
            }
            stage_shared(own_attributes);
            own_curves = load_curves(own, clipped);
        }
        do {
            sum_batch(own, own_attributes, own_curves, batch, place, clipped);
            place += batch;
        } while (in_steps(clipped) && place < LOADED && base + place < end);
        base += in_steps(clipped) ? LOADED : TILE_BATCH;
    } while (base < end);
}

// By planes alone, all splats of a tile are looked at as if they were cut: one body, of which a CPU driver's compiler takes half as long.
const bool CUTS_ALL = CUTS && !CLIPS;

void see(Range range)
{
    if (CUTS_ALL) {
        see(range.first, range.end, true);
        return;
    }
    if (!CUTS || range.first < range.clipped) {
        see(range.first, range.clipped, false);
    }
    if (CUTS && range.clipped < range.end) {
        see(range.clipped, range.end, true);
    }
}

// `lit`: each splat is lit by itself, at its center.
void sum(Range range, bool lit)
{
    if (CUTS_ALL) {
        sum(range.first, range.end, true, lit);
        return;
    }
    if (!CUTS || range.first < range.clipped) {
        sum(range.first, range.clipped, false, lit);
    }
    if (CUTS && range.clipped < range.end) {
        sum(range.clipped, range.end, true, lit);
    }
}
