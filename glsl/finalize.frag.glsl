// Normalization and shading (Guennebaud et al. 2006, section 2, "deferred shading") of the opaque part, under the
// transparent layers. Writes linear light with straight alpha; an sRGB target encodes it.
//
// SPLATS, POLYGONS, HYBRID: what the opaque part has; NOTHING: none of it. LAYERED: there are transparent layers, composed
// already, with their alpha multiplied in: what is below them shows through by what they leave.
// LIT: the scene has lights of its own.
// SHADED: tiles hold what they show (tile_splat.comp.glsl); the target's format and the background are what is left.
// Permutations: splats polygons hybrid | _ layered | _ lit
// Permutations: nothing | layered
// Permutations: shaded
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/image_plane.glsl"
#define LIGHTS_SET 0
#define LIGHTS_BINDING 5
#include "inc/shading.glsl"
#if defined(SHADED)
layout(set = 0, binding = 0) uniform texture2D shown_colors; // linear light; 1: something is there
#elif !defined(NOTHING)
#include "inc/shown.glsl"
#endif

#if defined(LAYERED)
layout(set = 0, binding = 4) uniform texture2D layers; // alpha times linear color, alpha
#endif

layout(location = 0) out vec4 color;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if defined(NOTHING)
    vec4 below = push.background;
#elif defined(SHADED)
    vec4 shown = texelFetch(shown_colors, pixel, 0);
    vec4 below = shown.a > 0.0 ? shown : push.background;
#else
    Shown shown = load_shown(pixel, to_eye());
    // 16-bit sums may flush the weight of a pixel that only a rim touches: 2^-24 is their smallest number.
    vec4 below = shown.covered ? vec4(shown.color, 1.0) : push.background;
#endif
#if defined(LAYERED)
    vec4 above = texelFetch(layers, pixel, 0);
    float left = FORMULA(FORMULA_OVER, 1.0 - above.a) * below.a;
    float alpha = above.a + left;
    color = alpha > 0.0 ? vec4((above.rgb + left * below.rgb) / alpha, alpha) : vec4(0.0);
#else
    color = below;
#endif
}
