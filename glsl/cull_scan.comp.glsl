// How many splats are kept before each word of bits, and behind the last one, in all. One workgroup, each invocation a range of
// words.
#version 460

#define LANES 256

layout(local_size_x = LANES) in;
layout(set = 1, binding = 0, std430) readonly buffer KeptBits { uint kept_bits[]; };
layout(set = 1, binding = 1, std430) writeonly buffer KeptStarts { uint kept_starts[]; };

shared uint sums[LANES];

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint words = kept_bits.length();
    uint each = (words + LANES - 1) / LANES;
    uint first = lane * each;
    uint end = min(first + each, words);
    uint own = 0;
    for (uint word = first; word < end; word++) {
        own += bitCount(kept_bits[word]);
    }
    sums[lane] = own;
    barrier();
    uint before = 0;
    for (uint i = 0; i < lane; i++) {
        before += sums[i];
    }
    for (uint word = first; word < end; word++) {
        kept_starts[word] = before;
        before += bitCount(kept_bits[word]);
    }
    if (lane == LANES - 1) {
        kept_starts[words] = before;
    }
}
