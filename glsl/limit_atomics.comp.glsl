// For the limits beside the floor benchmark: an atomic each, as a splat's would be that sees or sums by atomics: the least of what is
// in a word and a value. No two invocations of a row of groups share a word: a splat's neighbors, which do, are slower at best.
#version 460

layout(local_size_x = 256) in;
layout(set = 1, binding = 0, std430) buffer Words { uint words[]; };

void main()
{
    uint word = gl_GlobalInvocationID.x;
    atomicMin(words[word], word ^ gl_WorkGroupID.y);
}
