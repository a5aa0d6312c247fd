// The last transparent layer (layer.frag.glsl), where surfaces behind each other are one sum, lit already: color
// sum(w a C) / sum(w a), alpha sum(w a) / sum(w), which is that of one surface. m surfaces of that alpha hide 1 - (1 - a)^m: where
// they count as several, how many there are is told by their weights, in weights of the layer before (SPLATS, POLYGONS: what it
// has), which every pixel that has a last layer has too, but of 1 at least: at a rim less is left of it.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/config.glsl"

layout(constant_id = SPEC_SPLATS) const bool SPLATS = false;
layout(constant_id = SPEC_POLYGONS) const bool POLYGONS = false;

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D color_sums;   // sum of weight * alpha * color, sum of weight * alpha
layout(set = 0, binding = BIND_SUMS_NORMALS) uniform texture2D weight_sums; // sum of weight
layout(set = 0, binding = BIND_SUMS_SPLATS_BEFORE) uniform texture2D splats_before; // fourth component: sum of weight
layout(set = 0, binding = BIND_SUMS_POLYGONS_BEFORE) uniform texture2D polygons_before;

layout(location = 0) out vec4 layer; // alpha * linear color, alpha

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(color_sums, pixel, 0);
    float weight = texelFetch(weight_sums, pixel, 0).r;
    if (!(sum.a > 0.0 && weight > 0.0)) {
        discard;
    }
    // 16-bit sums round each on its own.
    float alpha = min(sum.a / weight, 1.0);
    if (SPLATS || POLYGONS) {
        float before = 0.0;
        if (SPLATS) {
            before += texelFetch(splats_before, pixel, 0).a;
        }
        if (POLYGONS) {
            before += texelFetch(polygons_before, pixel, 0).a;
        }
        float surfaces = FORMULA(FORMULA_STACKED, clamp(weight / max(before, 1.0), 1.0, MOST_STACKED_SURFACES));
        alpha = 1.0 - pow(1.0 - alpha, surfaces);
    }
    layer = vec4(alpha * (sum.rgb / sum.a), alpha);
}
