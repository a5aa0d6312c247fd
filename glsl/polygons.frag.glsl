// Polygons: their attributes, for the deferred shading that splats have too (Guennebaud et al. 2006, section 5.1, step 2 and
// its last paragraph).
//
// OPAQUE: the nearest one's. SHADED: the same, lit at once, for tiles that lay splats over them; SAMPLED: so at several places of
// each pixel, in an image for each, one beside the other. HIDING: their depth alone. TRANSPARENT: those of a layer, added (SUMMED_LAYER); or added to all that is left for the last layer, lit (SUMMED_REST).
// Permutations: opaque shaded sampled hiding transparent
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#define LIT
#define LIGHTS_SET 2
#define LIGHTS_BINDING BIND_READ_LIGHTS
#include "inc/shading.glsl"
#include "inc/normalized.glsl"
#include "inc/summed.glsl"
#include "inc/peel.glsl"
#define PLANES_SET 2
#define PLANES_BINDING BIND_READ_PLANES
#include "inc/planes.glsl"

#if defined(SAMPLED)
#define SHADED
#endif

layout(location = 0) in vec4 color_alpha; // linear
layout(location = 1) in vec3 normal;      // view space, on the side from which the corners are counterclockwise

#if defined(SHADED)
layout(constant_id = SPEC_HALF_FLOATS) const bool HALF_FLOATS = false;

layout(location = 0) out vec4 shown; // linear light, 1
#elif !defined(HIDING)
layout(location = 0) out vec4 color_sum;  // linear albedo, 1; of the rest: alpha * linear color, alpha
layout(location = 1) out vec4 normal_sum; // normal, alpha; of the rest: 1
#endif

// From the view's axis.
vec2 place_px()
{
    vec2 at = gl_FragCoord.xy;
#if defined(SAMPLED)
    at -= vec2(SIZE_PX) * vec2(greaterThan(at, vec2(SIZE_PX)));
#endif
    return at - frame.middle_px;
}

// The direction to the eye.
vec3 to_eye()
{
    return direction_to_eye(vec3(place_px() / frame.focal_px, 1.0));
}

void main()
{
    // A triangle that is seen exactly edge-on has no area, but some devices give it fragments, between whose corners nothing can be found.
    if (any(isnan(color_alpha))) {
        discard;
    }
    if (PLANES > 0 && is_cut_off(place_px(), gl_FragCoord.z)) {
        discard;
    }
#if defined(TRANSPARENT)
    if (PEELED) {
        peel(gl_FragCoord.z);
    }
    gl_FragDepth = gl_FragCoord.z; // the device's own may differ in the last bit
#endif
    bool outward = SUMMED == SUMMED_LAYER && OUTWARD;
    vec3 n = normal_of_sum(gl_FrontFacing || outward ? normal : -normal);
#if defined(SHADED)
    vec3 light = shaded(color_alpha.rgb, n, to_eye());
    shown = vec4(HALF_FLOATS ? min(light, HALF_FLOAT_MAX) : light, 1.0);
#elif !defined(HIDING)
    color_sum = vec4(color_alpha.rgb, 1.0);
    normal_sum = vec4(n, color_alpha.a);
#endif
#if defined(TRANSPARENT)
    if (SUMMED == SUMMED_REST) {
        color_sum = color_alpha.a * vec4(shaded(color_alpha.rgb, n, to_eye()), 1.0);
        normal_sum = vec4(1.0);
    }
#endif
}
