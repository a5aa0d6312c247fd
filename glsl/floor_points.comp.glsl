// For the floor benchmark: position and size of every splat's point, precomputed, exactly as the splat passes find
// them; what they don't draw lies outside of the clip volume. Every splat must be regular and fit a point.
#version 460
#include "inc/setup.glsl"
#include "inc/point.glsl"

layout(local_size_x = FLOOR_GROUP_SIZE) in;
layout(set = 1, binding = BIND_LIST_POINTS, std430) writeonly buffer FloorPoints { vec4 points[]; }; // x, y, depth, size

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= frame.splat_count) {
        return;
    }
    Mapping m;
    Square square;
    vec4 found = vec4(NOWHERE.xyz, 1.0);
    if (map_splat(index, m) && square_of(m, square)) {
        found = vec4(clip_middle(square), shifted(center_depth(m), m.shift), point_size_px(square));
    }
    points[index] = found;
}
