// How many splats are marked before each word of bits, and behind the last one, in all. One workgroup, each invocation a range of
// words.
#version 460
#include "inc/config.glsl"

#define LANES 256

layout(local_size_x = LANES) in;
layout(set = 1, binding = BIND_LIST_BITS, std430) readonly buffer Bits { uint marked_bits[]; };
layout(set = 1, binding = BIND_LIST_STARTS, std430) writeonly buffer Starts { uint starts[]; };

shared uint sums[LANES];

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint words = marked_bits.length();
    uint each = (words + LANES - 1) / LANES;
    uint first = lane * each;
    uint end = min(first + each, words);
    uint own = 0;
    for (uint word = first; word < end; word++) {
        own += bitCount(marked_bits[word]);
    }
    sums[lane] = own;
    barrier();
    uint before = 0;
    for (uint i = 0; i < lane; i++) {
        before += sums[i];
    }
    for (uint word = first; word < end; word++) {
        starts[word] = before;
        before += bitCount(marked_bits[word]);
    }
    if (lane == LANES - 1) {
        starts[words] = before;
    }
}
