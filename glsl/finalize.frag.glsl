// Normalization and shading (Guennebaud et al. 2006, section 2, "deferred shading"): one white light at the eye, no
// attenuation, so that l = v = -normalize(x, y, 1). Phong's mirror direction is r = 2 (n.l) n - l, hence
// r.v = 2 (n.l)^2 - 1. Writes linear light; an sRGB target encodes it.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/surface.glsl"

// The host's mirror is `FinalizeConstants` in src/passes/constants.rs; the build compares the offsets.
struct FinalizeConstants {
    vec4 background; // linear, of covered pixels without weight
    vec2 half_size_px;
    float focal_px;
    uint padding;
};
layout(push_constant, std430) uniform Push { FinalizeConstants push; };

layout(location = 0) out vec4 color;

vec3 shaded(Surface surface, vec3 v)
{
    if (SHADING == SHADING_ALBEDO) {
        return surface.albedo;
    }
    if (SHADING == SHADING_NORMALS) {
        return 0.5 * vec3(surface.normal.x, -surface.normal.y, -surface.normal.z) + 0.5;
    }
    float n_l = max(dot(surface.normal, v), 0.0);
    vec3 lambert = surface.albedo * (0.1 + FORMULA(FORMULA_DIFFUSE, 0.9 * n_l));
    if (SHADING == SHADING_LAMBERT) {
        return lambert;
    }
    float r_v = max(2.0 * n_l * n_l - 1.0, 0.0);
    float r_v_4 = r_v * r_v * r_v * r_v;
    float r_v_16 = r_v_4 * r_v_4 * r_v_4 * r_v_4;
    return lambert + FORMULA(FORMULA_SPECULAR, 0.2 * r_v_16 * r_v_16);
}

void main()
{
    Surface surface = load_surface(ivec2(gl_FragCoord.xy));
    vec3 v = -normalize(vec3(FORMULA(FORMULA_EYE_DIRECTION, (gl_FragCoord.xy - push.half_size_px) / push.focal_px), 1.0));
    // 16-bit sums may flush the weight of a pixel that only a rim touches: 2^-24 is their smallest number.
    color = surface.weight > 0.0 ? vec4(shaded(surface, v), 1.0) : push.background;
}
