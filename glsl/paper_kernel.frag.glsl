// Writes the kernel for inc/paper_weight.glsl: over the square around the unit disk, 0 outside of that, so that the alpha
// test finds the rim. u = -1 and 1 are the texture's borders: what lies beyond is clamped to the texels there, which are 0
// but for those on the axes, half a texel inside.
#version 460
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"

#define KERNEL_TEXTURE_SIDE 256 // as in src/passes/kernel_texture.rs

layout(location = 0) out float weight;

void main()
{
    vec2 uv = gl_FragCoord.xy * (2.0 / float(KERNEL_TEXTURE_SIDE)) - 1.0;
    bool on_border = any(greaterThan(abs(uv), vec2(1.0 - 1.5 / float(KERNEL_TEXTURE_SIDE))));
    weight = on_border || dot(uv, uv) >= 1.0 ? 0.0 : kernel_weight(dot(uv, uv));
}
