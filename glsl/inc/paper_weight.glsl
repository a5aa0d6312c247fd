// The "three instructions" of Guennebaud et al. 2006, section 3.2: two multiply-adds and a projective fetch. What the alpha
// test unit removed is discarded.

#define VARYING in
#include "inc/paper_varyings.glsl"

layout(set = 2, binding = 1) uniform sampler2D kernel; // 0 outside of the disk

float weight_and_depth(out float depth)
{
    vec4 uvwd = per_x * gl_FragCoord.x + at_corner;
    uvwd = per_y * gl_FragCoord.y + uvwd;
    depth = uvwd.w;
    float weight = textureProj(kernel, uvwd.xyz).r;
    if (weight <= 0.0) {
        discard;
    }
    return weight;
}
