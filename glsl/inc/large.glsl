// The splats that are drawn as quads ("large"): which they are (a bit each), and their list in input order. A block is
// BLOCK splats: one workgroup, BLOCK / 32 words of bits.

#define BLOCK 256

layout(set = 1, binding = 0, std430) readonly buffer LargeBits { uint large_bits[]; };

bool is_large(uint index)
{
    return (large_bits[index / 32] >> (index % 32) & 1) != 0;
}
