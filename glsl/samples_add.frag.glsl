// Adds a sample of the picture to those before it: the blending unit multiplies its color by its alpha, since a mean of straight colors
// would count what is not there.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D one_sample; // linear light, straight alpha

layout(location = 0) out vec4 light;

void main()
{
    light = texelFetch(one_sample, ivec2(gl_FragCoord.xy), 0);
}
