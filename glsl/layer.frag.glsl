// A transparent layer, normalized and shaded, put under those before it (Guennebaud et al. 2006, section 6, where the layers
// are kept and composed from back to front). Front to back needs no layer's image but the sum so far: with the alphas
// multiplied in, C = C_1 + (1 - a_1) (C_2 + (1 - a_2) (...)), and the parts are added as they come, each times what the ones
// before it leave; that factor is the blending unit's.
//
// SPLATS, POLYGONS, HYBRID: what transparent things there are. BLENDED: the last layer, where surfaces behind each other are
// one sum, lit already: color sum(w a C) / sum(w a), alpha sum(w a) / sum(w), which is that of one surface. STACKED: m surfaces
// of that alpha hide 1 - (1 - a)^m; how many there are is told by their weights, in weights of the layer before (BEFORE_SPLATS,
// BEFORE_POLYGONS: what it has), which every pixel that has a last layer has too, but
// of 1 at least: at a rim less is left of it.
//
// A pixel without a surface is discarded: whoever counts the fragments knows whether the layer is empty.
// LIT: the scene has lights of its own.
// Permutations: splats polygons hybrid | _ lit
// Permutations: blended
// Permutations: blended | stacked | before_splats before_polygons before_hybrid
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#define LAYER
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/image_plane.glsl"
#if defined(BLENDED)
#if defined(STACKED)
#if defined(BEFORE_SPLATS) || defined(BEFORE_HYBRID)
layout(set = 0, binding = 2) uniform texture2D splats_before; // fourth component: sum of weight
#endif
#if defined(BEFORE_POLYGONS) || defined(BEFORE_HYBRID)
layout(set = 0, binding = 3) uniform texture2D polygons_before;
#endif
#endif
layout(set = 0, binding = 0) uniform texture2D color_sums;  // sum of weight * alpha * color, sum of weight * alpha
layout(set = 0, binding = 1) uniform texture2D weight_sums; // sum of weight
#else
#define LIGHTS_SET 0
#define LIGHTS_BINDING 5
#include "inc/shading.glsl"
#include "inc/shown.glsl"
#endif

layout(location = 0) out vec4 layer; // alpha * linear color, alpha

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if defined(BLENDED)
    vec4 sum = texelFetch(color_sums, pixel, 0);
    float weight = texelFetch(weight_sums, pixel, 0).r;
    if (!(sum.a > 0.0 && weight > 0.0)) {
        discard;
    }
    // 16-bit sums round each on its own.
    float alpha = min(sum.a / weight, 1.0);
#if defined(STACKED)
    float before = 0.0;
#if defined(BEFORE_SPLATS) || defined(BEFORE_HYBRID)
    before += texelFetch(splats_before, pixel, 0).a;
#endif
#if defined(BEFORE_POLYGONS) || defined(BEFORE_HYBRID)
    before += texelFetch(polygons_before, pixel, 0).a;
#endif
    float surfaces = FORMULA(FORMULA_STACKED, clamp(weight / max(before, 1.0), 1.0, MOST_STACKED_SURFACES));
    alpha = 1.0 - pow(1.0 - alpha, surfaces);
#endif
    layer = vec4(alpha * (sum.rgb / sum.a), alpha);
#else
    Shown shown = load_shown(pixel, to_eye());
    if (!shown.covered) {
        discard;
    }
    layer = vec4(shown.alpha * shown.color, shown.alpha);
#endif
}
