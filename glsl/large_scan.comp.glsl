// Exclusive prefix sums of the blocks' counts, in place, and the arguments of the indirect draw. One workgroup; each
// step scans BLOCK counts by doubling (Hillis and Steele, "Data parallel algorithms", CACM 29(12), 1986).
#version 460
#include "inc/frame.glsl"

#define BLOCK 256
layout(local_size_x = BLOCK) in;
layout(set = 1, binding = 1, std430) buffer BlockCounts { uint block_counts[]; };
layout(set = 1, binding = 3, std430) writeonly buffer DrawArguments { uvec4 draw_arguments; };

shared uint sums[BLOCK];

void main()
{
    uint local = gl_LocalInvocationIndex;
    uint blocks = (frame.splat_count + BLOCK - 1) / BLOCK;
    uint before = 0;
    for (uint first = 0; first < blocks; first += BLOCK) {
        uint block = first + local;
        uint own = block < blocks ? block_counts[block] : 0;
        sums[local] = own;
        barrier();
        for (uint reach = 1; reach < BLOCK; reach *= 2) {
            uint left = local >= reach ? sums[local - reach] : 0;
            barrier();
            sums[local] += left;
            barrier();
        }
        if (block < blocks) {
            block_counts[block] = before + sums[local] - own;
        }
        before += sums[BLOCK - 1];
        barrier();
    }
    if (local == 0) {
        draw_arguments = uvec4(4, before, 0, 0); // vertices, instances, first vertex, first instance
    }
}
