// What an overflow tile shows whose splats were seen and summed in parts (tile_accumulate.comp.glsl with IN_SLOTS), as tile_shade.comp.glsl
// does it of all others in registers. One workgroup a tile, one invocation a pixel.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/normalized.glsl"
#include "tile/constants.glsl"
layout(local_size_x = TILE_WIDTH, local_size_y_id = SPEC_TILE_HEIGHT) in;
#define TILE_HEIGHT gl_WorkGroupSize.y
#define OWN_ROW int(gl_LocalInvocationID.y)
#include "inc/clip.glsl"
#include "tile/work.glsl"
#define LIT
#define LIGHTS_SET 0
#define LIGHTS_BINDING BIND_LIGHTS
#include "inc/shading.glsl"
#include "inc/edges.glsl"

layout(set = 0, binding = BIND_COLORS_BEFORE) uniform texture2D color_sums;
layout(set = 0, binding = BIND_NORMALS_BEFORE) uniform texture2D normal_sums;
layout(set = 0, binding = BIND_VISIBLE_BEFORE) uniform texture2D visible_before;
layout(constant_id = SPEC_WITH_DEPTH) const bool WITH_DEPTH = false; // as in tile_shade.comp.glsl
layout(set = 0, binding = BIND_NORMALS) writeonly uniform image2D own_depth;
layout(set = 0, binding = BIND_COLORS) writeonly uniform image2D shown; // linear light and opacity, which multiplies it

void main()
{
    Range range;
    if (!find_work(false, range)) {
        return;
    }
    ivec2 in_slot = pixel_in_slot(0);
    vec4 normal_sum = texelFetch(normal_sums, in_slot, 0);
    Surface surface = normalized(texelFetch(color_sums, in_slot, 0), normal_sum.xyz);
    vec3 v = to_eye(top_px + vec2(0.0, float(first_row)));
    vec3 light = shaded(surface.albedo, surface.normal, v);
    light = HALF_FLOATS ? min(light, HALF_FLOAT_MAX) : light;
    if (WITH_DEPTH) {
        float mean = FORMULA(FORMULA_NORMALIZED_DEPTH, normal_sum.w / surface.weight);
        float own = depth_of_mean(texelFetch(visible_before, in_slot, 0).r, mean);
        imageStore(own_depth, pixel_of(0), vec4(surface.weight > 0.0 ? own : 0.0));
    }
    float opacity = 1.0;
    if (COVERAGE_EDGES) {
        // As tile_accumulate.comp.glsl leaves them.
        ivec2 below = ivec2(0, textureSize(color_sums, 0).y / (REACHES ? 3 : 2));
        vec4 covering = texelFetch(color_sums, in_slot + below, 0);
        float border = REACHES ? texelFetch(color_sums, in_slot + 2 * below, 0).x : NO_BORDER;
        opacity = edge_opacity(covering.w, own_of(covering.z, border), steepness_of(covering.w, length(covering.xy)));
    }
    imageStore(shown, pixel_of(0), surface.weight > 0.0 ? opacity * vec4(light, 1.0) : vec4(0.0));
}
