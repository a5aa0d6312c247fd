// Attribute accumulation: weighted color and normal of every splat that is not behind the visible surface by more than
// its epsilon. The depth test compares the splat's own, unshifted depth; blending adds. extra() is the color; beside polygons
// 1 / f, of transparent splats alpha.
//
// WITH_DEPTH: also the depth of the surface, the weighted mean of z, summed as z / z_visible, which is at most 1, so that 16
// bits neither overflow nor lose it. z = near / w, so the ratio is w_visible / w, with w_visible the visibility pass's
// (shifted) depth.
//
// SUMMED_BESIDE: a splat counts where its depth, shifted by epsilon toward the viewer, is not behind the polygons' (Guennebaud et
// al. 2006, section 5.1, step 3). SUMMED_LAYER: the weighted alpha is summed too. SUMMED_REST: sum(w a C), sum(w a) and sum(w).
//
// OWN_DEPTH, of transparent triangles: the rasterizer's own depth may differ from what a shader sees in the last bit: so layers are compared by
// the shader's alone.
// Permutations: plain | _ fourth | _ clipped
// Permutations: full center | _ clipped
// Permutations: rays | fourth | _ clipped
// Permutations: triangles | _ own_depth | _ clipped
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/summed.glsl"
#include "inc/coverage.glsl"
#include "inc/kernel_texture.glsl"
#include "inc/kernel.glsl"
#include "inc/outline.glsl"
#include "inc/peel.glsl"

layout(constant_id = SPEC_TEXTURED) const bool TEXTURED = false;
layout(constant_id = SPEC_WITH_DEPTH) const bool WITH_DEPTH = false;

layout(location = 5) flat in vec4 normal_weight; // view space, unit, toward the eye; the splat's own weight

layout(set = 2, binding = BIND_READ_DEPTH) uniform texture2D visible_depth;
layout(set = 2, binding = BIND_READ_POLYGON_DEPTH) uniform texture2D depth_with_polygons; // the larger one of the splats' and the polygons'

layout(location = 0) out vec4 color_sum;  // weight * linear albedo, weight; of the rest: weight * alpha * linear color, weight * alpha
layout(location = 1) out vec4 normal_sum; // weight * normal, weight * z / z_visible or 0; of a layer: weight * alpha; of the rest: weight

void main()
{
    Covered fragment = covered(COVERAGE_R2);
    if (PEELED) {
        peel(fragment.w);
    }
    vec4 extra = extra();
    if (SUMMED == SUMMED_BESIDE) {
        // Where there is no polygon this is the splats' own depth, which the depth test compares without the shift.
        float w_polygon = texelFetch(depth_with_polygons, ivec2(gl_FragCoord.xy), 0).r;
        if (fragment.w < FORMULA(FORMULA_TOWARD_VIEWER, shifted(w_polygon, extra.w))) {
            discard;
        }
    }
#if !defined(TRIANGLES) || defined(OWN_DEPTH)
    gl_FragDepth = fragment.w;
#endif
    float weight;
    if (TEXTURED) {
        weight = kernel_from_texture(fragment.uv);
    } else {
        weight = kernel_weight(dot(fragment.uv, fragment.uv));
    }
    if (WEIGHTED) {
        weight = max(weight * normal_weight.w, LEAST_WEIGHT);
    }
    if (is_outline(dot(fragment.uv, fragment.uv))) {
        weight *= OUTLINE_WEIGHT;
        extra.rgb = vec3(0.0);
    }
    if (SUMMED == SUMMED_REST) {
        color_sum = weight * extra.w * vec4(extra.rgb, 1.0);
        normal_sum = vec4(weight);
        return;
    }
    float last = SUMMED == SUMMED_LAYER ? extra.w : 0.0;
    if (WITH_DEPTH) {
        float w_visible = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).r;
        last = FORMULA(FORMULA_DEPTH_SUM, depth_term(w_visible, fragment.w));
    }
    color_sum = weight * vec4(extra.rgb, 1.0);
    normal_sum = weight * vec4(normal_weight.xyz, last);
}
