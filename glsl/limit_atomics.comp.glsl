// For the limits beside the floor benchmark: an atomic each, as a splat would need for each pixel that it is seen in or summed to. No
// two invocations of a row of groups share a word; of splats that overlap some do, and on a CPU find it in its caches.
#version 460

layout(local_size_x = 256) in;
layout(set = 1, binding = 0, std430) buffer Words { uint words[]; };

void main()
{
    atomicAdd(words[gl_GlobalInvocationID.x], 1);
}
