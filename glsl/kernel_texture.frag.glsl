// Writes the kernel over the square around the unit disk, for kernel_texture.glsl. Beyond the disk it goes on as it is (or
// is 0, for psi_e), because a fetch at the rim reads texels outside.
#version 460
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"

#define KERNEL_TEXTURE_SIDE 256 // as in inc/kernel_texture.glsl and src/passes/kernel_texture.rs

layout(location = 0) out float weight;

void main()
{
    vec2 uv = (gl_FragCoord.xy - 0.5) * (2.0 / float(KERNEL_TEXTURE_SIDE - 1)) - 1.0;
    weight = KERNEL == KERNEL_PSI_E && dot(uv, uv) >= 1.0 ? 0.0 : kernel_weight(dot(uv, uv));
}
