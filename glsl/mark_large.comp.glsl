// Marks the splats that are drawn as quads: larger than the device's largest point, not regular, or too near or too thin for a
// triangle. The decision is made here once; the vertex stages only read it, so that no splat is drawn twice or not at all.
#version 460
#include "inc/setup.glsl"
#include "inc/triangle.glsl"
#include "inc/list.glsl"

layout(constant_id = SPEC_POINT_CAP) const float POINT_CAP_PX = 64.0; // the largest point of the device

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) writeonly buffer Bits { uint large_bits[]; };

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
    return square_side_px(px) > POINT_CAP_PX - 1.0;
}

void main()
{
    uint word = LIST_INVOCATION;
    if (word >= words_of_chunk()) {
        return;
    }
    uint first = first_splat_of(block_of(word), word);
    uint end = min(first + WORD, frame.splat_count);
    uint bits = 0;
    for (uint index = first; index < end; index++) {
        bits |= is_drawn_as_quad(index) ? 1u << (index - first) : 0u;
    }
    large_bits[word] = bits;
}
