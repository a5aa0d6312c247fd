// Finds the splats that are drawn as quads: larger than the device's largest point, not regular, or too
// near or too thin for a triangle. A bit a splat, a count a block. The decision is made here once; the vertex stages only read
// it, so that no splat is drawn twice or not at all.
#version 460
#include "inc/setup.glsl"
#include "inc/triangle.glsl"

#define BLOCK 256
layout(local_size_x = BLOCK) in;
layout(set = 1, binding = 0, std430) writeonly buffer LargeBits { uint large_bits[]; };
layout(set = 1, binding = 1, std430) writeonly buffer BlockCounts { uint block_counts[]; };

shared uint words[BLOCK / 32];

bool is_drawn_as_quad(uint index)
{
    Mapping m;
    if (!map_splat(index, m)) {
        return false;
    }
    if (RASTERIZER == RASTERIZER_TRIANGLE) {
        return !fits_triangle(m);
    }
    if (!m.regular) {
        return true;
    }
    PixelBox px;
    // One pixel below the cap: the vertex stage may round a box differently than this stage, by one pixel at most. Also
    // for a box that holds no pixel's center here: a sliver may hold some there.
    pixel_box(splat_box(m), px);
    return square_side_px(px) > frame.point_cap_px - 1.0;
}

void main()
{
    uint local = gl_LocalInvocationIndex;
    uint index = gl_GlobalInvocationID.x;
    if (local < BLOCK / 32) {
        words[local] = 0;
    }
    barrier();
    if (index < frame.splat_count && is_drawn_as_quad(index)) {
        atomicOr(words[local / 32], 1u << (local % 32));
    }
    barrier();
    if (local < BLOCK / 32) {
        large_bits[gl_WorkGroupID.x * (BLOCK / 32) + local] = words[local];
    }
    if (local == 0) {
        uint count = 0;
        for (uint i = 0; i < BLOCK / 32; i++) {
            count += bitCount(words[i]);
        }
        block_counts[gl_WorkGroupID.x] = count;
    }
}
