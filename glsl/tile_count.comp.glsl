// How many records of each segment fall into each bin: the invocation's own counts.
// Permutations: _ kept | _ texels
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/tiles.glsl"

layout(local_size_x = WALKERS) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 5, std430) buffer Counts { uint counts[]; };

void visit(uint record, uint bin)
{
    counts[PLACE_OF_COUNT(gl_GlobalInvocationID.x, bin)] += 1;
}

#include "inc/tile_walk.glsl"

void main()
{
    walk();
}
