// Attribute accumulation: weighted color and normal of every splat that is not behind the visible surface by more than
// its epsilon. The depth test compares the splat's own, unshifted depth; blending adds. extra() is the color.
//
// WITH_DEPTH: also the depth of the surface, the weighted mean of z, summed as z / z_visible, which is at most 1, so that 16
// bits neither overflow nor lose it. z = near / w, so the ratio is w_visible / w, with w_visible the visibility pass's
// (shifted) depth. TEXTURED: the kernel is read from a texture.
//
// BESIDE: there are polygons; a splat counts where its depth, shifted by epsilon toward the viewer, is not behind theirs
// (Guennebaud et al. 2006, section 5.1, step 3).
//
// LAYER: a transparent layer; the weighted alpha is summed too. BLENDED: the last one, with all that is left, as
// sum(w a C), sum(w a) and sum(w). PEELED: only what is behind the layer before; see peel.glsl. The rasterizer's own depth
// may differ from what a shader sees in the last bit: so layers are compared by the shader's alone, also of triangles.
// Permutations: plain full center rays | _ textured | _ with_depth | _ beside
// Permutations: triangles | _ textured | _ with_depth | _ beside
// Permutations: plain full center rays | _ textured | layer blended | _ peeled
// Permutations: triangles | _ textured | layer blended | _ peeled
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/coverage.glsl"
#if defined(TEXTURED)
#include "inc/kernel_texture.glsl"
#else
#include "inc/kernel.glsl"
#endif
#if defined(PEELED)
#include "inc/peel.glsl"
#endif

layout(location = 5) flat in vec4 normal_weight; // view space, unit, toward the eye; the splat's own weight

#if defined(BESIDE)
layout(location = 6) flat in float inverse_shift; // 1 / f
layout(set = 2, binding = 2) uniform texture2D depth_with_polygons; // the larger one of the splats' and the polygons'
#elif defined(LAYER) || defined(BLENDED)
layout(location = 6) flat in float alpha;
#endif

#if defined(WITH_DEPTH)
layout(set = 2, binding = 0) uniform texture2D visible_depth;
#endif

#if defined(BLENDED)
layout(location = 0) out vec4 color_sum;   // weight * alpha * linear color, weight * alpha
layout(location = 1) out float weight_sum; // weight
#else
layout(location = 0) out vec4 color_sum;  // weight * linear albedo, weight
layout(location = 1) out vec4 normal_sum; // weight * normal, weight * z / z_visible or 0; of a layer: weight * alpha
#endif

void main()
{
    Covered fragment = covered(COVERAGE_R2);
#if defined(PEELED)
    peel(fragment.w);
#endif
#if defined(BESIDE)
    // Where there is no polygon this is the splats' own depth, which the depth test compares without the shift.
    float w_polygon = texelFetch(depth_with_polygons, ivec2(gl_FragCoord.xy), 0).r;
    if (fragment.w < FORMULA(FORMULA_TOWARD_VIEWER, w_polygon * inverse_shift)) {
        discard;
    }
#endif
#if !defined(TRIANGLES) || defined(LAYER) || defined(BLENDED)
    gl_FragDepth = fragment.w;
#endif
#if defined(TEXTURED)
    float weight = kernel_from_texture(fragment.uv);
#else
    float weight = kernel_weight(dot(fragment.uv, fragment.uv));
#endif
    if (WEIGHTED) {
        weight = max(weight * normal_weight.w, LEAST_WEIGHT); // what covers must not vanish in 16-bit sums
    }
#if defined(WITH_DEPTH)
    float w_visible = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).r;
    float z_ratio = FORMULA(FORMULA_DEPTH_SUM, w_visible / fragment.w);
#elif !defined(LAYER) && !defined(BLENDED)
    const float z_ratio = 0.0;
#endif
#if defined(BLENDED)
    color_sum = weight * alpha * vec4(extra(), 1.0);
    weight_sum = weight;
#elif defined(LAYER)
    color_sum = weight * vec4(extra(), 1.0);
    normal_sum = weight * vec4(normal_weight.xyz, alpha);
#else
    color_sum = weight * vec4(extra(), 1.0);
    normal_sum = weight * vec4(normal_weight.xyz, z_ratio);
#endif
}
