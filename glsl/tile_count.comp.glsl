// How many records of each segment fall into each bin.
// Permutations: column pixel
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "tile/constants.glsl"
#include "tile/walk.glsl"

void main()
{
    walk();
}
