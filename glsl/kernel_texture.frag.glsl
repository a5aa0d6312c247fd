// Writes the kernel over the square around the unit disk. Beyond the disk it goes on as it is (or is 0, for psi_e), because a fetch
// at the rim reads texels outside.
//
// CUT_OFF, for paper.frag.glsl: 0 outside of the disk, so that the alpha test finds the rim. u = -1 and 1 are the texture's
// borders there: what lies beyond is clamped to the texels there, which are 0 but for those on the axes, half a texel inside.
#version 460
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"

layout(constant_id = SPEC_CUT_OFF) const bool CUT_OFF = false;

layout(location = 0) out float weight;

void main()
{
    const float side = float(KERNEL_TEXTURE_SIDE);
    vec2 uv = CUT_OFF ? gl_FragCoord.xy * (2.0 / side) - 1.0 : (gl_FragCoord.xy - 0.5) * (2.0 / (side - 1.0)) - 1.0;
    bool on_border = CUT_OFF && any(greaterThan(abs(uv), vec2(1.0 - 1.5 / side)));
    bool outside = (CUT_OFF || KERNEL == KERNEL_PSI_E) && dot(uv, uv) >= 1.0;
    weight = on_border || outside ? 0.0 : kernel_weight(dot(uv, uv));
}
