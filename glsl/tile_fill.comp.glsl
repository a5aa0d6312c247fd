// Lists the records of each bin: each goes behind those of its bin in the segments before, and those before it in its own.
// Permutations: column pixel
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "tile/constants.glsl"
#define LISTS
#include "tile/walk.glsl"

layout(set = 0, binding = BIND_STARTS, std430) readonly buffer Starts { uint starts[]; };
layout(set = 0, binding = BIND_ENTRIES, std430) writeonly buffer Entries { uint entries[]; };

layout(constant_id = SPEC_MAY_BE_LARGE) const bool MAY_BE_LARGE = false;
layout(set = 0, binding = BIND_VISIBLE_LIST, std430) readonly buffer VisibleList { uint visible_list[]; };

void list(uint record, uint bin, uint before)
{
    // The graphics pipeline, which draws what is in the bins of chunks, knows splats by their own numbers.
    bool own_number = LISTED && MAY_BE_LARGE && bin >= FIRST_CHUNK_BIN;
    entries[starts[bin] + before] = own_number ? visible_list[record] : record;
}

void main()
{
    walk();
}
