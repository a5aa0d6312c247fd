// Polygons: their attributes, for the deferred shading that splats have too (Guennebaud et al. 2006, section 5.1, step 2 and
// its last paragraph).
//
// OPAQUE: the nearest one's. SHADED: the same, lit at once, for tiles that lay splats over them; HALF, SINGLE: the precision of the
// image. LAYER: those of a transparent layer, added. BLENDED: added to all that is left for the last
// layer, lit. PEELED: only what is behind the layer before; see peel.glsl.
// Permutations: opaque
// Permutations: shaded | half single | _ lit
// LIT: by lights of the scene's own.
// Permutations: layer blended | _ peeled
// Permutations: blended | _ peeled | lit
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#if defined(BLENDED) || defined(SHADED)
#define LIGHTS_SET 2
#define LIGHTS_BINDING 3
#include "inc/shading.glsl"
#endif
#if defined(PEELED)
#include "inc/peel.glsl"
#endif

layout(location = 0) in vec4 color_alpha; // linear
layout(location = 1) in vec3 normal;      // view space, on the side from which the corners are counterclockwise

#if defined(SHADED)
layout(location = 0) out vec4 shown; // linear light, 1
#elif defined(BLENDED)
layout(location = 0) out vec4 color_sum;   // alpha * linear color, alpha
layout(location = 1) out float weight_sum; // 1
#else
layout(location = 0) out vec4 color_sum;  // linear albedo, 1
layout(location = 1) out vec4 normal_sum; // normal, alpha
#endif

void main()
{
#if defined(PEELED)
    peel(gl_FragCoord.z);
#endif
#if !(defined(OPAQUE) || defined(SHADED))
    gl_FragDepth = gl_FragCoord.z; // the device's own may differ in the last bit
#endif
#if defined(LAYER)
    vec3 n = gl_FrontFacing || OUTWARD ? normal : -normal;
#else
    vec3 n = gl_FrontFacing ? normal : -normal;
#endif
    float length2 = dot(n, n);
    n = length2 > 0.0 ? n * inversesqrt(length2) : vec3(0.0, 0.0, -1.0);
#if defined(BLENDED) || defined(SHADED)
    vec3 v = -normalize(vec3((gl_FragCoord.xy - 0.5 * frame.size_px) / frame.focal_px, 1.0));
#endif
#if defined(SHADED)
    vec3 light = shaded(color_alpha.rgb, n, v);
#if defined(HALF)
    light = min(light, 65504.0); // where half floats end
#endif
    shown = vec4(light, 1.0);
#elif defined(BLENDED)
    color_sum = color_alpha.a * vec4(shaded(color_alpha.rgb, n, v), 1.0);
    weight_sum = 1.0;
#else
    color_sum = vec4(color_alpha.rgb, 1.0);
    normal_sum = vec4(n, color_alpha.a);
#endif
}
