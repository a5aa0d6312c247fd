// Normalization and shading (Guennebaud et al. 2006, section 2, "deferred shading") of the opaque part, under the
// transparent layers. Writes linear light with straight alpha; an sRGB target encodes it.
//
// SPLATS, POLYGONS: what the opaque part has; or it is SHADED already, and the target's format and the background are what is left.
// LAYERED: there are transparent layers, composed already, with their alpha multiplied in: what is below them shows through by what
// they leave.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/image_plane.glsl"
#define LIT
#define LIGHTS_SET 0
#define LIGHTS_BINDING BIND_SUMS_LIGHTS
#include "inc/shading.glsl"
#include "inc/resolve.glsl"

layout(constant_id = SPEC_SHADED) const bool SHADED = false;
layout(constant_id = SPEC_LAYERED) const bool LAYERED = false;

layout(set = 0, binding = BIND_SUMS_LAYERS) uniform texture2D layers; // alpha times linear color, alpha

layout(location = 0) out vec4 color;

// `above`: light with its alpha multiplied in. `below`, and what is answered: straight.
vec4 over(vec4 above, vec4 below)
{
    float left = FORMULA(FORMULA_OVER, 1.0 - above.a) * below.a;
    float alpha = above.a + left;
    return alpha > 0.0 ? vec4((above.rgb + left * below.rgb) / alpha, alpha) : vec4(0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    color = push.background;
    if (SHADED) {
        color = over(texelFetch(color_sums, pixel, 0), color);
    } else if (SPLATS || POLYGONS) {
        Resolved opaque = resolve(pixel, to_eye());
        // 16-bit sums may flush the weight of a pixel that only a rim touches: 2^-24 is their smallest number.
        color = opaque.covered ? vec4(opaque.color, 1.0) : color;
    }
    if (LAYERED) {
        color = over(texelFetch(layers, pixel, 0), color);
    }
}
