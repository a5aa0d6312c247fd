// 64 invocations, each a pixel of the tile; they hand splats on in memory that they share. All of the workgroup are here, or none:
// what loops and branches go by is the same for all.

#define TILE_HEIGHT MOST_TILE_HEIGHT
#define ROWS 1
#define OWN_ROWS 1
#define OWN_ROW int(gl_LocalInvocationID.y)
#define LANES (TILE_WIDTH * MOST_TILE_HEIGHT)
#define OWN_LANE gl_LocalInvocationIndex
#define LOADED LANES
#define CLIPPED_BATCH TILE_BATCH
#define AT_ONCE 1 // with eight, a GPU would need 144 registers in place of 40

layout(local_size_x = TILE_WIDTH, local_size_y = MOST_TILE_HEIGHT) in;

layout(set = 0, binding = BIND_RECORDS, std430) readonly buffer Records0 { vec4 records0[]; };
layout(set = 0, binding = BIND_RECORDS + 1, std430) readonly buffer Records1 { vec4 records1[]; };
layout(set = 0, binding = BIND_RECORDS + 2, std430) readonly buffer Records2 { vec4 records2[]; };
layout(set = 0, binding = BIND_RECORDS + 3, std430) readonly buffer Records3 { uvec4 records3[]; };

vec4 record0(uint record) { return records0[record]; }
vec4 record1(uint record) { return records1[record]; }
vec4 record2(uint record) { return records2[record]; }
uvec4 record3(uint record) { return records3[record]; }

layout(set = 0, binding = BIND_CLIPS, std430) readonly buffer ClipRecords { vec4 clip_records[]; };

shared Splat shared_splats[LOADED];
shared SplatAttributes shared_attributes[LOADED];
shared uint least_bits;
shared uint vote_words[LANES / 32];

void stage_shared(Splat own)
{
    barrier(); // those before were read
    shared_splats[OWN_LANE] = own;
    barrier();
}

void stage_shared(SplatAttributes own)
{
    barrier();
    shared_attributes[OWN_LANE] = own;
    barrier();
}

Splat broadcast(Splat own, uint place)
{
    return shared_splats[place];
}

SplatAttributes broadcast(SplatAttributes own, uint place)
{
    return shared_attributes[place];
}

// Of the splat, from the same place in all invocations.
struct OwnCurves {
    bool nothing;
};

OwnCurves load_curves(Splat own, bool clipped)
{
    return OwnCurves(false);
}

Curve curve_of(OwnCurves own, Splat splats[AT_ONCE], uint number, uint place)
{
    uint first = CLIP_RECORD_VECTORS * splats[0].record + 3 * number;
    return Curve(clip_records[first], clip_records[first + 1], clip_records[first + 2]);
}

uint most_curves(OwnCurves own, Splat splats[AT_ONCE], uint at_once, uint place)
{
    return is_clipped(splats[0]) ? 2 : 0;
}

// Of values that are never negative, so that bits compare as they do.
float least_of_tile(float own)
{
    if (OWN_LANE == 0) {
        least_bits = floatBitsToUint(own);
    }
    barrier();
    atomicMin(least_bits, floatBitsToUint(own));
    barrier();
    return uintBitsToFloat(least_bits);
}

// How many invocations vote for: those before this one, and all.
uvec2 votes_of_tile(bool own)
{
    uint word = OWN_LANE / 32;
    uint bit = 1u << (OWN_LANE % 32);
    barrier(); // those before were read
    vote_words[word] = 0;
    barrier();
    atomicOr(vote_words[word], own ? bit : 0);
    barrier();
    uint first = bitCount(vote_words[0]);
    uint before = bitCount(vote_words[word] & (bit - 1));
    return uvec2(word > 0 ? first + before : before, first + bitCount(vote_words[1]));
}

void see_entries()
{
    memoryBarrierBuffer();
    barrier();
}
