// The counts of each bin, summed over the segments: each count becomes the number of records in segments before its own.
#version 460
#include "inc/tiles.glsl"

layout(local_size_x = WALKERS) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 5, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 6, std430) writeonly buffer Starts { uint starts[]; };

void main()
{
    uint bin = GROUP_NUMBER * WALKERS + gl_LocalInvocationID.x;
    if (bin >= push.bin_count) {
        return;
    }
    uint before = 0;
    for (uint segment = 0; segment < push.segments; segment++) {
        uint place = PLACE_OF_COUNT(segment, bin);
        uint own = counts[place];
        counts[place] = before;
        before += own;
    }
    starts[bin] = before;
}
