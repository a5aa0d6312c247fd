// Attribute accumulation: weighted color and normal of every splat that is not behind the visible surface by more than
// its epsilon. The depth test compares the splat's own, unshifted depth; blending adds. extra() is the color.
//
// WITH_DEPTH: also the depth of the surface, the weighted mean of z, summed as z / z_visible, which is at most 1, so that 16
// bits neither overflow nor lose it. z = near / w, so the ratio is w_visible / w, with w_visible the visibility pass's
// (shifted) depth. EARLY: as in visibility.frag.glsl. TEXTURED: the kernel is read from a texture.
// Permutations: plain full center rays | _ early | _ textured | _ with_depth
// Permutations: triangles | _ textured | _ with_depth
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

#if defined(EARLY)
layout(depth_less) out float gl_FragDepth;
#endif

layout(location = 5) flat in vec4 normal_weight; // view space, unit, toward the eye; the splat's own weight

#if defined(WITH_DEPTH)
layout(set = 2, binding = 0) uniform texture2D visible_depth;
#endif

layout(location = 0) out vec4 color_sum;  // weight * linear albedo, weight
layout(location = 1) out vec4 normal_sum; // weight * normal, weight * z / z_visible or 0

const float LEAST_WEIGHT = 5.9604645e-8; // 2^-24

void main()
{
    Covered fragment = covered(COVERAGE_R2);
#if !defined(TRIANGLES)
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
#else
    float z_ratio = 0.0;
#endif
#if defined(EARLY) && defined(TEST_FORMULAS)
    // Not every device makes use of the bound, so a wrong one must be seen otherwise.
    if (fragment.w > gl_FragCoord.z) {
        weight *= 1000.0;
    }
#endif
    color_sum = weight * vec4(extra(), 1.0);
    normal_sum = weight * vec4(normal_weight.xyz, z_ratio);
}
