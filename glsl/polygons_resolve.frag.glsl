// What polygons show that were drawn at several places of each pixel, in images that lie one beside the other: light, and how much of the pixel they cover, which multiplies it.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"

layout(set = 0, binding = BIND_SUMS_POLYGON_COLORS) uniform texture2D colors;

layout(location = 0) out vec4 shown;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size_px = textureSize(colors, 0) / 2;
    vec4 sum = vec4(0.0);
    [[unroll]] for (int i = 0; i < MOST_POLYGON_SAMPLES; i++) {
        ivec2 at = pixel + ivec2(i & 1, i >> 1) * size_px;
        sum += texelFetch(colors, at, 0);
    }
    shown = sum / float(MOST_POLYGON_SAMPLES);
}
