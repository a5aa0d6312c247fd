// For the floor benchmark: position and size of every splat's point, precomputed, exactly as the splat passes find
// them; what they don't draw lies outside of the clip volume.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/splat.glsl"
#include "inc/adjust.glsl"
#include "inc/box.glsl"
#include "inc/setup.glsl"
#include "inc/square.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) writeonly buffer FloorPoints { vec4 points[]; }; // x, y, depth, size

void main()
{
    uint index = gl_GlobalInvocationID.x;
    if (index >= frame.splat_count) {
        return;
    }
    Setup o;
    vec4 point = vec4(2.0, 2.0, 2.0, 1.0);
    if (set_up(index, o)) {
        Square square = point_square(o);
        point = vec4(square.center, o.constants.z * o.inverse_shift, square.size_px);
    }
    points[index] = point;
}
