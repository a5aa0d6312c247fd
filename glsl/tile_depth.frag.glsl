// The depth that tiles have found, into the depth buffer of the graphics pipeline.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

#include "inc/config.glsl"

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D visible_depth;

void main()
{
    gl_FragDepth = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).r;
}
