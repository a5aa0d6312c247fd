// The hierarchy of the visible depth: of each cell of 8 x 8 pixels, and of each block of 8 x 8 cells, the farthest (reversed depth:
// the smallest; 0 where some pixel sees nothing). One workgroup a block, one invocation a cell. Cells outside of the image hide
// all; nobody asks them. The depth's own image may be larger than the picture.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/depth_cells.glsl"

layout(local_size_x = DEPTH_CELLS_SIDE, local_size_y = DEPTH_CELLS_SIDE) in;
layout(push_constant) uniform Picture { ivec2 size; }; // in pixels
layout(set = 0, binding = BIND_CELLS_DEPTH) uniform texture2D visible_depth;
layout(set = 0, binding = BIND_CELLS, std430) writeonly buffer DepthCells { float depth_cells[]; };

shared float farthest[DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE];

void main()
{
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 first = DEPTH_CELLS_SIDE * cell;
    ivec2 end = min(first + DEPTH_CELLS_SIDE, size);
    float least = 1e30;
    for (int y = first.y; y < end.y; y++) {
        for (int x = first.x; x < end.x; x++) {
            least = min(least, texelFetch(visible_depth, ivec2(x, y), 0).r);
        }
    }
    depth_cells[place_of_cell(size, cell)] = least;
    farthest[gl_LocalInvocationIndex] = least;
    barrier();
    if (gl_LocalInvocationIndex == 0) {
        for (uint i = 1; i < DEPTH_CELLS_SIDE * DEPTH_CELLS_SIDE; i++) {
            least = min(least, farthest[i]);
        }
        depth_cells[place_of_block(size, ivec2(gl_WorkGroupID.xy))] = least;
    }
}
