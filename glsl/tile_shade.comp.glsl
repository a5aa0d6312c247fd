// Visibility, accumulation and shading (finalize.frag.glsl) of a tile's splats: what a pixel shows, in place of sums, which never
// leave the registers; where nobody else reads them. Overflow tiles are left to tile_shade_overflow.comp.glsl.
//
// HIDDEN: what the tile's visible depth hides is not summed (tile/hidden.glsl).
// Permutations: column pixel | _ hidden
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/kernel.glsl"
#include "inc/normalized.glsl"
#include "tile/constants.glsl"
#include "tile/lanes.glsl"
#include "tile/work.glsl"
#define PEELS false
#include "tile/surface.glsl"
#include "tile/hidden.glsl"

layout(set = 0, binding = BIND_COLORS) writeonly uniform image2D shown; // linear light; 1: something is there

// WITH_POLYGONS: these were drawn and shaded as if there were no splats.
layout(set = 0, binding = BIND_COLORS_BEFORE) uniform texture2D shown_before;
layout(set = 0, binding = BIND_POLYGON_DEPTH) uniform texture2D polygon_depth;

void main()
{
    Range range;
    if (!find_work(true, range)) {
        return;
    }
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        visible[row] = 0.0;
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
    }
    see(range);
    if (WITH_POLYGONS) {
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            polygon[row] = max(texelFetch(polygon_depth, pixel_within_image(row), 0).r, visible[row]);
        }
    }
    sum(unhidden(range), false);
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        Surface surface = normalized(colors[row], normals[row].xyz);
        vec3 light = shaded(surface.albedo, surface.normal, to_eye(top_px + vec2(0.0, float(first_row + row))));
        bool covered = surface.weight > 0.0;
        if (WITH_POLYGONS) {
            // Of polygons, the nearest is shown already. Where splats do not hide it, both blend (inc/resolve.glsl).
            vec3 of_polygon = texelFetch(shown_before, pixel_within_image(row), 0).rgb;
            bool is_seen = polygon[row] > visible[row];
            float share = TRANSITION == TRANSITION_NONE ? 0.0 : min(FORMULA(FORMULA_TRANSITION, surface.weight), 1.0);
            light = is_seen ? mix(of_polygon, light, share) : light;
            covered = covered || is_seen;
        }
        light = HALF_FLOATS ? min(light, HALF_FLOAT_MAX) : light;
        imageStore(shown, pixel_of(row), covered ? vec4(light, 1.0) : vec4(0.0));
    }
}
