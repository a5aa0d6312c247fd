// A projected splat, all in pixels, so that nothing of its chunk is needed any more, as its record has it:
// records0: where its map is expanded (x0), from the middle of the image; w0, the depth there, negative where clip curves cut
// parts off it, or planes may; the shift, negative (or -0) where it is
// TWO_SIDED and faces away.
// records1: u along x and along y, v along x and along y, per pixel. records2: w along x and along y; the share of its weight
// that a filter leaves, negative (or -0) where it reaches further than its rim (inc/reach.glsl); the normal's x. records3: its y and z; red, green, blue and alpha, 16 bits each;
// OUTLINED: 1 less how surely its surface goes on in the place of alpha.
//
// (uw, vw, w) are over w0: w is about 1 in all pixels of a regular splat, so that squares neither under- nor overflow and
// coverage needs no division: u^2 + v^2 <= R^2 is (uw)^2 + (vw)^2 <= R^2 w^2. Where the map is affine, u and v are as they are.

#include "inc/clip.glsl"
#define PLANES_SET 0
#define PLANES_BINDING BIND_PLANES
#include "inc/planes.glsl"

const bool CUT_BY_PLANES = CUTS && PLANES > 0;

// What tells whether it covers a pixel, and how deep.
struct Splat {
    uint record;
    vec2 x0_px;
    float w0;
    float shift;
    vec4 uv;
    vec2 w;
};

bool is_clipped(Splat splat)
{
    return CLIPS && splat.w0 < 0.0;
}

float depth_of(Splat splat)
{
    return CUTS ? abs(splat.w0) : splat.w0;
}

// What is summed of it.
struct SplatAttributes {
    vec3 color;  // linear
    float alpha;
    vec3 normal;
    float share;
    vec2 own_part; // COVERAGE_EDGES: what it covers by itself is x - y r^2
    vec4 outline;  // OUTLINED: where it ends, as no filter has widened it (inc/outlined.glsl)
    vec4 reach;    // REACHES: r^2 is x u^2 + y v^2; z u^2 + w v^2 stands in place of y r^2
};
