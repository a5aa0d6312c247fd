// How many records of each segment fall into each bin: a column of counts a segment, which is the invocation's own.
#version 460
#include "inc/tiles.glsl"

layout(local_size_x = 8) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 5, std430) buffer Counts { uint counts[]; };

void visit(uint record, uint bin)
{
    counts[gl_GlobalInvocationID.x * push.bin_count + bin] += 1;
}

#include "inc/tile_walk.glsl"

void main()
{
    walk();
}
