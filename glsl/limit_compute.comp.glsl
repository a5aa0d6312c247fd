// For the limits beside the floor benchmark: invocations that do next to nothing. One of each group stores, in one row of
// groups only, so that something comes of them and no two store to one place.
#version 460

layout(local_size_x = 256) in;
layout(set = 1, binding = 0, std430) writeonly buffer Groups { uint groups[]; };

void main()
{
    if (gl_LocalInvocationIndex == 0 && gl_WorkGroupID.y == 0) {
        groups[gl_WorkGroupID.x] = gl_WorkGroupID.x;
    }
}
