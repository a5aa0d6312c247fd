// A transparent layer, normalized and shaded, put under those before it (Guennebaud et al. 2006, section 6, where the layers
// are kept and composed from back to front). Front to back needs no layer's image but the sum so far: with the alphas
// multiplied in, C = C_1 + (1 - a_1) (C_2 + (1 - a_2) (...)), and the parts are added as they come, each times what the ones
// before it leave; that factor is the blending unit's.
//
// A pixel without a surface is discarded: whoever counts the fragments knows whether the layer is empty.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#define LAYER
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/image_plane.glsl"
#define LIT
#define LIGHTS_SET 0
#define LIGHTS_BINDING BIND_SUMS_LIGHTS
#include "inc/shading.glsl"
#include "inc/resolve.glsl"

layout(location = 0) out vec4 layer; // alpha * linear color, alpha

void main()
{
    Resolved surface = resolve(ivec2(gl_FragCoord.xy), to_eye());
    if (!surface.covered) {
        discard;
    }
    layer = vec4(surface.alpha * surface.color, surface.alpha);
}
