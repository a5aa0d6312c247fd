// For the limits beside the floor benchmark: invocations that do next to nothing. One of each group stores, in one row of
// groups only, so that something comes of them and no two store to one place. Or, ATOMICS, an atomic each, as a splat would need for
// each pixel that it is seen in or summed to: no two of a row of groups share a word; of splats that overlap some do, and on a CPU
// find it in its caches.
#version 460
#include "inc/config.glsl"

layout(constant_id = SPEC_ATOMICS) const bool ATOMICS = false;

layout(local_size_x = LIMIT_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_POINTS, std430) buffer Words { uint words[]; };

void main()
{
    if (ATOMICS) {
        atomicAdd(words[gl_GlobalInvocationID.x], 1);
    } else if (gl_LocalInvocationIndex == 0 && gl_WorkGroupID.y == 0) {
        words[gl_WorkGroupID.x] = gl_WorkGroupID.x;
    }
}
