// What polygons show that were drawn with several samples of each pixel: light, and how much of the pixel they cover, which multiplies it.
//
// DEPTH: and the depth from which on they cover half of it, which hides what is behind; 0 where they cover less.
// Permutations: _ depth
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"

layout(set = 0, binding = BIND_SUMS_POLYGON_COLORS) uniform texture2DMS colors;
layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2DMS depths;

layout(location = 0) out vec4 shown;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    float nearest = 0.0;
    float second = 0.0;
    [[unroll]] for (int i = 0; i < MOST_POLYGON_SAMPLES; i++) {
        sum += texelFetch(colors, pixel, i);
#if defined(DEPTH)
        float w = texelFetch(depths, pixel, i).r;
        second = max(second, min(nearest, w));
        nearest = max(nearest, w);
#endif
    }
    shown = sum / float(MOST_POLYGON_SAMPLES);
#if defined(DEPTH)
    gl_FragDepth = second;
#endif
}
