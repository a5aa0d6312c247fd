// What the vertex stages of a point sprite hand over, found once for all passes of a frame ("record"): 64 bytes, in four
// buffers of 16 each, so that they fit wherever the splats do. PLAIN interfaces alone (varyings.glsl).

struct PointRecord {
    vec3 x0_w;           // as handed over (expansion_of)
    float inverse_shift; // 1 / f (mapping.glsl)
    vec3 along_x;        // change of (uw, vw, w) per pixel
    float share;         // the splat's own weight
    vec3 along_y;
    vec3 normal;         // view space, unit, toward the eye or outward
    Square square;       // side 0: there is nothing to draw as a point
};

layout(set = 1, binding = 4, std430) RECORDS_ACCESS buffer PointRecords0 { vec4 records0[]; };
layout(set = 1, binding = 5, std430) RECORDS_ACCESS buffer PointRecords1 { vec4 records1[]; };
layout(set = 1, binding = 6, std430) RECORDS_ACCESS buffer PointRecords2 { vec4 records2[]; };
layout(set = 1, binding = 7, std430) RECORDS_ACCESS buffer PointRecords3 { uvec4 records3[]; };

// Middles are kept in half pixels. No device has points above this many pixels, and no image twice as many as the rest holds.
#define SIDE_BITS 14
#define MIDDLE_BITS (32 - SIDE_BITS)
