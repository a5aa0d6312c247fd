// The mean of all samples of a pixel: linear light with straight alpha; an sRGB target encodes it.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"

layout(constant_id = SPEC_SAMPLES) const uint SAMPLES = 1;

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D all_samples; // sums of alpha times linear color, of alpha

layout(location = 0) out vec4 color;

void main()
{
    vec4 sum = texelFetch(all_samples, ivec2(gl_FragCoord.xy), 0);
    color = sum.a > 0.0 ? vec4(sum.rgb / sum.a, sum.a / float(SAMPLES)) : vec4(0.0);
}
