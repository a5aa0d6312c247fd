// The splats of a tile, BATCH at a time, as its columns of pixels see them. Invocation i loads record i of the batch, and hands
// what it holds to the others; with DIRECT, each loads the same one.
//
// A record is a splat, ready to be drawn: all in pixels, so that nothing of its chunk is needed any more.
// records0: where its map is expanded (x0), from the middle of the image; w0, the depth there; 1 / f.
// records1: u along x and along y, v along x and along y, per pixel. records2: w along x and along y; the share of its weight
// that a filter leaves; the normal's x. records3: its y and z; red, green, blue and alpha, 16 bits each.
//
// (uw, vw, w) are over w0: w is about 1 in all pixels of a regular splat, so that squares neither under- nor overflow and
// coverage needs no division: u^2 + v^2 <= R^2 is (uw)^2 + (vw)^2 <= R^2 w^2. Where the map is affine, u and v are as they are.

#if defined(DIRECT)
#define BATCH 1
#else
#define BATCH 8
#endif

layout(set = 0, binding = 0, std430) readonly buffer Records0 { vec4 records0[]; };
layout(set = 0, binding = 1, std430) readonly buffer Records1 { vec4 records1[]; };
layout(set = 0, binding = 2, std430) readonly buffer Records2 { vec4 records2[]; };
layout(set = 0, binding = 3, std430) readonly buffer Records3 { uvec4 records3[]; };
layout(set = 0, binding = 7, std430) readonly buffer Entries { uint entries[]; };

// What is needed of the invocation's own record to know whether it covers a pixel, and how deep.
struct Batch {
    uint record;
    vec4 r0;     // x0_px, w0, inverse_shift
    vec4 uv;
    vec2 w;
};

Batch load_batch(uint base, uint end)
{
#if defined(DIRECT)
    uint entry = base;
#else
    uint entry = base + gl_SubgroupInvocationID;
#endif
    Batch batch;
    batch.record = entries[min(entry, end - 1)];
    batch.r0 = records0[batch.record];
    batch.uv = records1[batch.record];
    batch.w = records2[batch.record].xy;
#if !defined(DIRECT)
    if (entry >= end) {
        // Behind the list's end: far off, with a map that covers nothing there.
        batch.r0 = vec4(1e9, 1e9, 1.0, 1.0);
        batch.uv = vec4(1.0, 0.0, 0.0, 1.0);
        batch.w = vec2(0.0);
    }
#endif
    return batch;
}

// What it looks like.
struct Look {
    vec3 color;  // linear
    float alpha;
    vec3 normal;
    float share;
};

Look load_look(Batch batch)
{
    vec4 r2 = records2[batch.record];
    uvec4 r3 = records3[batch.record];
    vec2 red_green = unpackUnorm2x16(r3.z);
    vec2 blue_alpha = unpackUnorm2x16(r3.w);
    Look look;
    look.color = FORMULA(FORMULA_COLOR, vec3(red_green, blue_alpha.x));
    look.alpha = FORMULA(FORMULA_ALPHA, blue_alpha.y);
    look.normal = vec3(r2.w, uintBitsToFloat(r3.xy));
    look.share = r2.z;
    return look;
}

// What invocation k holds.
float handed(float value, uint k)
{
#if defined(DIRECT)
    return value;
#else
    return subgroupShuffle(value, k);
#endif
}

vec3 handed(vec3 value, uint k)
{
    return vec3(handed(value.x, k), handed(value.y, k), handed(value.z, k));
}

// Splat k along the invocation's column of pixels: over w0, (uw, vw, w) = at_center_row + along_y * dy.
struct Column {
    float w0;
    vec3 at_center_row;
    vec3 along_y;
    float dy; // of the first row, from the splat's center
};

Column column_of(Batch batch, uint k, vec2 at_px)
{
    float dx = at_px.x - handed(batch.r0.x, k);
    Column column;
    column.w0 = handed(batch.r0.z, k);
    column.at_center_row.x = handed(batch.uv.x, k) * dx;
    column.at_center_row.y = handed(batch.uv.z, k) * dx;
    column.at_center_row.z = 1.0 + handed(batch.w.x, k) * dx;
    column.along_y = vec3(handed(batch.uv.y, k), handed(batch.uv.w, k), handed(batch.w.y, k));
    column.dy = at_px.y - handed(batch.r0.y, k);
    return column;
}

vec3 uvw_of(Column column, int row)
{
    vec3 uvw = column.at_center_row + column.along_y * (column.dy + float(row));
    return uvw;
}

bool is_inside(vec3 uvw)
{
    float limit = FORMULA(FORMULA_COVERAGE, COVERAGE_R2);
    return dot(uvw.xy, uvw.xy) <= (AFFINE ? limit : limit * (uvw.z * uvw.z));
}

// A regular splat lies wholly beyond the near plane, but an affine map reaches further than the splat.
bool is_beyond_near(float depth)
{
    return !AFFINE || depth > 0.0 && depth <= FORMULA(FORMULA_NEAR_CUT, 1.0);
}

const float LEAST_WEIGHT = 5.9604645e-8; // 2^-24

// What it weighs there, and 0 outside.
float weight_of(vec3 uvw, float share, bool inside)
{
    float r2 = dot(uvw.xy, uvw.xy);
    r2 = AFFINE ? r2 : r2 / (uvw.z * uvw.z);
    float weight = kernel_weight(r2);
    weight = WEIGHTED ? max(weight * share, LEAST_WEIGHT) : weight;
    return inside ? weight : 0.0;
}
