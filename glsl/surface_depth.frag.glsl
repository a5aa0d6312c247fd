// The depth of the opaque surface that is seen, for a host that draws beside it: the mean of its splats' own depths by their weights, as
// export.frag.glsl has it, or the polygon's; w, 1 at the near plane (inc/projection.glsl for other cameras), 0 where nothing is.
//
// SHADED: tiles left it. SPLATS: it follows from sums. POLYGONS: their depth, or that of splats moved away by epsilon where those are
// nearer, behind which none of their own is; so the nearer of both is what is seen.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/config.glsl"
#include "inc/projection.glsl"
#include "inc/sums.glsl"

layout(constant_id = SPEC_SHADED) const bool SHADED = false;
layout(constant_id = SPEC_SPLATS) const bool SPLATS = false;
layout(constant_id = SPEC_POLYGONS) const bool POLYGONS = false;

layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D splat_depth; // SHADED: own; SPLATS: visible
layout(set = 0, binding = BIND_SUMS_POLYGON_COLORS) uniform texture2D polygon_depth;

layout(location = 0) out float depth;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float w = SHADED || SPLATS ? texelFetch(splat_depth, pixel, 0).r : 0.0;
    if (SPLATS) {
        float weight = texelFetch(color_sums, pixel, 0).w;
        float mean = FORMULA(FORMULA_NORMALIZED_DEPTH, texelFetch(normal_sums, pixel, 0).w / weight);
        w = weight > 0.0 && w > 0.0 ? depth_of_mean(w, mean) : 0.0;
    }
    depth = POLYGONS ? max(w, texelFetch(polygon_depth, pixel, 0).r) : w;
}
