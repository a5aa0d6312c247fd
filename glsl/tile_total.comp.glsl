// The counts of each bin, summed over the pieces of segments: each count becomes the number of records in pieces before its own.
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "tile/constants.glsl"

layout(local_size_x = TOTAL_GROUP_SIZE) in;
layout(set = 0, binding = BIND_COUNTS, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = BIND_STARTS, std430) writeonly buffer Starts { uint starts[]; };

void main()
{
    uint bin = GROUP_NUMBER * TOTAL_GROUP_SIZE + gl_LocalInvocationID.x;
    if (bin >= push.count_bins) {
        return;
    }
    uint before = 0;
    // Those of a group lie beside each other, and are on their way together.
    for (uint piece = 0; piece < push.segments * push.pieces; piece += BIN_GROUP_SIZE) {
        uint first = place_of_count(piece, bin);
        uint own[BIN_GROUP_SIZE];
        [[unroll]] for (uint i = 0; i < BIN_GROUP_SIZE; i++) {
            own[i] = counts[first + i];
        }
        [[unroll]] for (uint i = 0; i < BIN_GROUP_SIZE; i++) {
            counts[first + i] = before;
            before += own[i];
        }
    }
    if (!counts_halves()) {
        starts[bin] = before;
    } else if (bin < push.tile_count) {
        starts[2 * bin] = before & HALF_COUNT;
        starts[2 * bin + 1] = before >> HALF_COUNT_BITS;
    } else {
        starts[bin + push.tile_count] = before;
    }
}
