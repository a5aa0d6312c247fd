// How many records of each segment fall into each bin: the invocation's own counts.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "tile/constants.glsl"
#include "tile/walk.glsl"

void visit(uint record, uint bin)
{
    counts[place_of_count(gl_GlobalInvocationID.x, bin)] += 1;
}

void main()
{
    walk();
}
