// The counts of each bin, summed over the segments: each count becomes the number of records in segments before its own.
#version 460
#include "tile/constants.glsl"

layout(local_size_x = BIN_GROUP_SIZE) in;
layout(set = 0, binding = BIND_COUNTS, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = BIND_STARTS, std430) writeonly buffer Starts { uint starts[]; };

void main()
{
    uint bin = GROUP_NUMBER * BIN_GROUP_SIZE + gl_LocalInvocationID.x;
    if (bin >= push.bin_count) {
        return;
    }
    uint before = 0;
    for (uint segment = 0; segment < push.segments; segment++) {
        uint place = place_of_count(segment, bin);
        uint own = counts[place];
        counts[place] = before;
        before += own;
    }
    starts[bin] = before;
}
