// The splats of a tile, BATCH at a time, and how the tile's invocations come by them. Invocation i of a column loads record i of
// a batch and hands it to the others by shuffles. With PIXELS it loads record i of eight batches, and hands it on in memory that
// they share. Without it, records and lists are texel buffers (but a list that is to be
// shortened), which CPU drivers read without a loop over lanes (src/passes/tiles/invocations.rs).

#if defined(PIXELS)
#define BATCH 8
#define OWN_ENTRY gl_LocalInvocationIndex
#else
#define BATCH 8
#define OWN_ENTRY gl_SubgroupInvocationID
#endif

#if defined(PIXELS)
layout(set = 0, binding = 0, std430) readonly buffer Records0 { vec4 records0[]; };
layout(set = 0, binding = 1, std430) readonly buffer Records1 { vec4 records1[]; };
layout(set = 0, binding = 2, std430) readonly buffer Records2 { vec4 records2[]; };
layout(set = 0, binding = 3, std430) readonly buffer Records3 { uvec4 records3[]; };
#define RECORD0(record) records0[record]
#define RECORD1(record) records1[record]
#define RECORD2(record) records2[record]
#define RECORD3(record) records3[record]
#else
layout(set = 0, binding = 23) uniform textureBuffer records0;
layout(set = 0, binding = 24) uniform textureBuffer records1;
layout(set = 0, binding = 25) uniform textureBuffer records2;
layout(set = 0, binding = 26) uniform utextureBuffer records3;
#define RECORD0(record) texelFetch(records0, int(record))
#define RECORD1(record) texelFetch(records1, int(record))
#define RECORD2(record) texelFetch(records2, int(record))
#define RECORD3(record) texelFetch(records3, int(record))
#endif
#if defined(HIDDEN)
layout(set = 0, binding = 7, std430) coherent buffer Entries { uint entries[]; }; // written by inc/tile_hidden.glsl
#define ENTRY(number) entries[number]
#elif defined(PIXELS)
layout(set = 0, binding = 7, std430) readonly buffer Entries { uint entries[]; };
#define ENTRY(number) entries[number]
#else
layout(set = 0, binding = 27) uniform utextureBuffer entries;
#define ENTRY(number) texelFetch(entries, int(number)).x
#endif

#include "inc/tile_record.glsl"

#if defined(PIXELS)
#define LOADED (TILE_WIDTH * TILE_HEIGHT)
shared Splat shared_splats[LOADED];
shared Look shared_looks[LOADED];
#endif

// Of all that are loaded at once, the place where a batch begins; at 0 they have to be loaded.
uint place_of(uint base, Range range)
{
#if defined(PIXELS)
    return (base - range.first) % LOADED;
#else
    return 0;
#endif
}

Splat load_splat(uint base, uint end)
{
    uint entry = base + OWN_ENTRY;
    uint record = ENTRY(min(entry, end - 1));
    vec4 r0 = RECORD0(record);
    Splat splat = Splat(record, r0.xy, r0.z, r0.w, RECORD1(record), RECORD2(record).xy);
    if (entry >= end) {
        // Behind the list's end: far off, with a map that covers nothing there.
        splat = Splat(record, vec2(1e9), 1.0, 1.0, vec4(1.0, 0.0, 0.0, 1.0), vec2(0.0));
    }
    return splat;
}

Look load_look(Splat splat)
{
    vec4 r2 = RECORD2(splat.record);
    uvec4 r3 = RECORD3(splat.record);
    vec2 red_green = unpackUnorm2x16(r3.z);
    vec2 blue_alpha = unpackUnorm2x16(r3.w);
    Look look;
    look.color = FORMULA(FORMULA_COLOR, vec3(red_green, blue_alpha.x));
    look.alpha = FORMULA(FORMULA_ALPHA, blue_alpha.y);
    look.normal = vec3(r2.w, uintBitsToFloat(r3.xy));
    look.share = r2.z;
    return look;
}

#if defined(PIXELS)

// All of the workgroup are here, or none: what loops and branches go by is the same for all.
void hand_on(Splat own)
{
    barrier(); // those before were read
    shared_splats[gl_LocalInvocationIndex] = own;
    barrier();
}

void hand_on(Look own)
{
    barrier();
    shared_looks[gl_LocalInvocationIndex] = own;
    barrier();
}

Splat handed(Splat own, uint place)
{
    return shared_splats[place];
}

Look handed(Look own, uint place)
{
    return shared_looks[place];
}

#else

void hand_on(Splat own) {}
void hand_on(Look own) {}

// What invocation k holds.
float handed(float value, uint k)
{
    return subgroupShuffle(value, k);
}

vec2 handed(vec2 value, uint k)
{
    return vec2(handed(value.x, k), handed(value.y, k));
}

vec3 handed(vec3 value, uint k)
{
    return vec3(handed(value.xy, k), handed(value.z, k));
}

vec4 handed(vec4 value, uint k)
{
    return vec4(handed(value.xyz, k), handed(value.w, k));
}

Splat handed(Splat own, uint k)
{
    float inverse_shift = handed(own.inverse_shift, k);
    return Splat(0, handed(own.x0_px, k), handed(own.w0, k), inverse_shift, handed(own.uv, k), handed(own.w, k));
}

Look handed(Look own, uint k)
{
    return Look(handed(own.color, k), handed(own.alpha, k), handed(own.normal, k), handed(own.share, k));
}

#endif

// Loads the splats from `base` on to be handed on, where that is not done yet; returns the place of the first.
uint load(uint base, Range range, inout Splat own)
{
    uint place = place_of(base, range);
    if (place == 0) {
        own = load_splat(base, range.end);
        hand_on(own);
    }
    return place;
}

// And what they look like.
uint load(uint base, Range range, inout Splat own, inout Look own_look)
{
    uint place = load(base, range, own);
    if (place == 0) {
        own_look = load_look(own);
        hand_on(own_look);
    }
    return place;
}
