// 8 invocations of one subgroup, each a column of the tile's pixels; they hand splats on by shuffles.
//
// All rows are computed for every splat of the tile, without a branch: on a CPU driver, lanes of a vector are invocations,
// and it has no branch to gain by. Records and lists are texel buffers, which CPU drivers read without a loop over lanes
// (src/passes/plan/invocations.rs).

layout(constant_id = SPEC_TILE_HEIGHT) const uint TILE_HEIGHT = MOST_TILE_HEIGHT;

#define ROWS MOST_TILE_HEIGHT
#define OWN_ROWS int(TILE_HEIGHT)
#define OWN_ROW 0
#define LANES TILE_WIDTH
#define OWN_LANE gl_SubgroupInvocationID
#define LOADED TILE_BATCH
#define CLIPPED_BATCH 2 // few of a tile are, and what is missing in a batch costs as much
#define AT_ONCE TILE_BATCH // row by row, for a CPU has no registers for the sums of all rows

layout(local_size_x = TILE_WIDTH) in;

layout(set = 0, binding = BIND_RECORD_TEXELS) uniform textureBuffer records0;
layout(set = 0, binding = BIND_RECORD_TEXELS + 1) uniform textureBuffer records1;
layout(set = 0, binding = BIND_RECORD_TEXELS + 2) uniform textureBuffer records2;
layout(set = 0, binding = BIND_RECORD_TEXELS + 3) uniform utextureBuffer records3;

vec4 record0(uint record) { return texelFetch(records0, int(record)); }
vec4 record1(uint record) { return texelFetch(records1, int(record)); }
vec4 record2(uint record) { return texelFetch(records2, int(record)); }
uvec4 record3(uint record) { return texelFetch(records3, int(record)); }

layout(set = 0, binding = BIND_CLIP_TEXELS) uniform textureBuffer clip_records;

void stage_shared(Splat own) {}
void stage_shared(SplatAttributes own) {}

Splat broadcast(Splat own, uint place)
{
    return Splat(0, subgroupShuffle(own.x0_px, place), subgroupShuffle(own.w0, place),
        subgroupShuffle(own.shift, place), subgroupShuffle(own.uv, place), subgroupShuffle(own.w, place));
}

SplatAttributes broadcast(SplatAttributes own, uint place)
{
    return SplatAttributes(subgroupShuffle(own.color, place), subgroupShuffle(own.alpha, place),
        subgroupShuffle(own.normal, place), subgroupShuffle(own.share, place),
        COVERAGE_EDGES ? subgroupShuffle(own.own_part, place) : vec2(0.0),
        COVERAGE_EDGES && CURVED ? subgroupShuffle(own.outline, place) : vec4(0.0),
        REACHES ? subgroupShuffle(own.reach, place) : vec4(0.0));
}

// Of the invocation's own splat.
struct OwnCurves {
    uint count;
    Curve curves[2];
};

OwnCurves load_curves(Splat own, bool clipped)
{
    OwnCurves of;
    of.count = 0;
    if (CLIPS && clipped) {
        int first = int(CLIP_RECORD_VECTORS * own.record);
        [[unroll]] for (int number = 0; number < 2; number++) {
            of.curves[number] = Curve(texelFetch(clip_records, first + 3 * number), texelFetch(clip_records, first + 3 * number + 1), texelFetch(clip_records, first + 3 * number + 2));
            of.curves[number].c.w = is_clipped(own) ? of.curves[number].c.w : 0.0;
        }
        of.count = !is_clipped(own) ? 0 : of.curves[1].c.w > 0.0 ? 2 : 1;
    }
    return of;
}

Curve curve_of(OwnCurves own, Splat splats[AT_ONCE], uint number, uint place)
{
    bool first = number == 0;
    vec4 c = first ? own.curves[0].c : own.curves[1].c;
    vec4 a = first ? own.curves[0].a : own.curves[1].a;
    vec3 b = first ? own.curves[0].b.xyz : own.curves[1].b.xyz;
    return Curve(subgroupShuffle(c, place), subgroupShuffle(a, place), vec4(subgroupShuffle(b, place), 0.0));
}

uint most_curves(OwnCurves own, Splat splats[AT_ONCE], uint at_once, uint place)
{
    uint most = 0;
    [[unroll]] for (uint k = 0; k < at_once; k++) {
        most = max(most, subgroupShuffle(own.count, place + k));
    }
    return most;
}

float least_of_tile(float own)
{
    float least = own;
    [[unroll]] for (uint lane = 0; lane < LANES; lane++) {
        least = min(least, subgroupShuffle(own, lane));
    }
    return least;
}

// How many invocations vote for: those before this one, and all.
uvec2 votes_of_tile(bool own)
{
    uint ballot = subgroupBallot(own).x;
    return uvec2(bitCount(ballot & ((1u << OWN_LANE) - 1)), bitCount(ballot));
}

void see_entries()
{
    subgroupMemoryBarrierBuffer();
    subgroupBarrier();
}
