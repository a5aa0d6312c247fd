// Lists the records of each bin: each goes behind those of its bin in the segments before, and those before it in its own.
// Permutations: _ kept | _ texels
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/tiles.glsl"

layout(local_size_x = WALKERS) in;
layout(push_constant, std430) uniform Push { TileConstants push; };
layout(set = 0, binding = 5, std430) buffer Counts { uint counts[]; };
layout(set = 0, binding = 6, std430) readonly buffer Starts { uint starts[]; };
#if defined(KEPT)
layout(constant_id = 16) const bool MAY_BE_LARGE = false; // some splats are left to the graphics pipeline
layout(set = 0, binding = 21, std430) readonly buffer KeptList { uint kept_list[]; };
#endif
layout(set = 0, binding = 7, std430) writeonly buffer Entries { uint entries[]; };

// The graphics pipeline, which draws what is in the bins of chunks, knows splats by their own numbers.
uint entry_of(uint record, uint bin)
{
#if defined(KEPT)
    return MAY_BE_LARGE && bin >= push.tile_count ? kept_list[record] : record;
#else
    return record;
#endif
}

void visit(uint record, uint bin)
{
    uint place = PLACE_OF_COUNT(gl_GlobalInvocationID.x, bin);
    uint before = counts[place];
    counts[place] = before + 1;
    entries[starts[bin] + before] = entry_of(record, bin);
}

#include "inc/tile_walk.glsl"

void main()
{
    walk();
}
