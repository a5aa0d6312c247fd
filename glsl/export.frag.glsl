// The normalized surface itself, for whoever wants data instead of a picture. Empty pixels: weight, albedo and normal
// 0, depth +infinity.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/config.glsl"
#include "inc/finalize.glsl"
#include "inc/projection.glsl"
#include "inc/sums.glsl"

layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D visible_depth;

layout(location = 0) out float weight;
layout(location = 1) out vec4 albedo;
layout(location = 2) out vec4 normal;
layout(location = 3) out float depth; // view-space z of the normalized surface, world unit

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = load_surface(pixel);
    float w_visible = texelFetch(visible_depth, pixel, 0).r;
    // Without a visible depth only a hair of a rim was accumulated: see visibility.frag.glsl.
    bool covered = surface.weight > 0.0 && w_visible > 0.0;
    float depth_sum = texelFetch(normal_sums, pixel, 0).w; // of weight * z / z_visible
    weight = covered ? surface.weight : 0.0;
    albedo = covered ? vec4(surface.albedo, 1.0) : vec4(0.0);
    normal = covered ? vec4(surface.normal, 1.0) : vec4(0.0);
    float mean = FORMULA(FORMULA_NORMALIZED_DEPTH, depth_sum / surface.weight);
    float z = ORTHOGRAPHIC ? push.eye_to_depth + push.near * (1.0 - (w_visible + mean)) : push.near / w_visible * mean;
    depth = covered ? z : uintBitsToFloat(0x7f800000u);
}
