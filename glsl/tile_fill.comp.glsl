// Lists the records of each bin: each goes behind those of its bin in the segments before, and those before it in its own.
#version 460
#include "inc/tiles.glsl"

layout(local_size_x = WALKERS) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 5, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 6, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = 7, std430) writeonly buffer Entries { uint entries[]; };

void visit(uint record, uint bin)
{
    uint place = PLACE_OF_COUNT(gl_GlobalInvocationID.x, bin);
    uint before = counts[place];
    counts[place] = before + 1;
    entries[starts[bin] + before] = record;
}

#include "inc/tile_walk.glsl"

void main()
{
    walk();
}
