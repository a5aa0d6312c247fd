// Both splat passes as Guennebaud, Barthe, Paulin 2006 publish them: the "three instructions" of section 3.2, two multiply-adds and a
// projective fetch. What the alpha test unit removed is discarded; blending multiplies by the weight.
// Permutations: visibility accumulate
#version 460
#include "inc/config.glsl"

layout(set = 2, binding = BIND_READ_KERNEL) uniform sampler2D kernel; // 0 outside of the disk

layout(location = 0) flat in vec4 per_x; // see paper.vert.glsl
layout(location = 1) flat in vec4 per_y;
layout(location = 2) flat in vec4 at_corner;
#if defined(ACCUMULATE)
layout(location = 3) flat in vec3 normal;
layout(location = 4) flat in vec3 color;

layout(location = 0) out vec4 color_weight;
layout(location = 1) out vec4 normal_weight;
#endif

void main()
{
    vec4 uvwd = per_x * gl_FragCoord.x + at_corner;
    uvwd = per_y * gl_FragCoord.y + uvwd;
    gl_FragDepth = uvwd.w;
    float weight = textureProj(kernel, uvwd.xyz).r;
    if (weight <= 0.0) {
        discard;
    }
#if defined(ACCUMULATE)
    color_weight = vec4(color, weight);
    normal_weight = vec4(normal, weight);
#endif
}
