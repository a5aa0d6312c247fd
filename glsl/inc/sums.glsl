// The sums of the accumulation pass, normalized.

#include "inc/normalized.glsl"

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D color_sums;
layout(set = 0, binding = BIND_SUMS_NORMALS) uniform texture2D normal_sums;

Surface load_surface(ivec2 pixel)
{
    return normalized(texelFetch(color_sums, pixel, 0), texelFetch(normal_sums, pixel, 0).xyz);
}
