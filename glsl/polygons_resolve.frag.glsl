// What polygons show that were drawn at several places of each pixel, in images that lie one beside the other: light, and how much of the pixel they cover, which multiplies it.
//
// DEPTH: and the depth from which on they cover half of it, which hides what is behind; 0 where they cover less.
// Permutations: _ depth
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"

layout(set = 0, binding = BIND_SUMS_POLYGON_COLORS) uniform texture2D colors;
layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D depths;

layout(location = 0) out vec4 shown;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size_px = textureSize(colors, 0) / 2;
    vec4 sum = vec4(0.0);
    float nearest = 0.0;
    float second = 0.0;
    [[unroll]] for (int i = 0; i < MOST_POLYGON_SAMPLES; i++) {
        ivec2 at = pixel + ivec2(i & 1, i >> 1) * size_px;
        sum += texelFetch(colors, at, 0);
#if defined(DEPTH)
        float w = texelFetch(depths, at, 0).r;
        second = max(second, min(nearest, w));
        nearest = max(nearest, w);
#endif
    }
    shown = sum / float(MOST_POLYGON_SAMPLES);
#if defined(DEPTH)
    gl_FragDepth = second;
#endif
}
