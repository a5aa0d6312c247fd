// The depth of what a host has drawn, as ours: w.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"
#include "inc/host.glsl"

layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D host_depth;

void main()
{
    float d = texelFetch(host_depth, push.corner_px + turned_over(ivec2(gl_FragCoord.xy)), 0).r;
    gl_FragDepth = clamp((d - push.offset) / push.scale, 0.0, 1.0);
}
