// Visibility and accumulation of a tile's splats, which leave depth and sums in images.
//
// SEES and SUMS: both, of one tile after the other. One of them alone: where the graphics pipeline draws in between; or of a part of
// an overflow tile, where depths and sums go on from what the image holds.
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
#include "tile/constants.glsl"
#include "tile/lanes.glsl"
#include "tile/work.glsl"
#define PEELS false
#define OF_LAYERS false
#include "tile/surface.glsl"
#include "tile/hidden.glsl"

layout(constant_id = SPEC_SEES) const bool SEES = true;
layout(constant_id = SPEC_SUMS) const bool SUMS = true;
layout(constant_id = SPEC_IN_SLOTS) const bool IN_SLOTS = false; // images hold overflow tiles alone
layout(constant_id = SPEC_KEEPS_DEPTH) const bool KEEPS_DEPTH = true;
layout(set = 0, binding = BIND_COLORS) writeonly uniform image2D color_sums;
layout(set = 0, binding = BIND_NORMALS) writeonly uniform image2D normal_sums;
layout(set = 0, binding = BIND_VISIBLE_DEPTH) writeonly uniform image2D visible_depth;
layout(set = 0, binding = BIND_COLORS_BEFORE) uniform texture2D color_sums_before;
layout(set = 0, binding = BIND_NORMALS_BEFORE) uniform texture2D normal_sums_before;
layout(set = 0, binding = BIND_VISIBLE_BEFORE) uniform texture2D visible_before;
layout(set = 0, binding = BIND_POLYGON_DEPTH) uniform texture2D polygon_depth; // or of splats, where those are nearer

layout(constant_id = SPEC_DEPTH_PRELOADED) const bool DEPTH_PRELOADED = false; // the graphics pipeline has drawn splats
layout(set = 0, binding = BIND_DEPTH_BEFORE) uniform texture2D depth_before;

// Edges are covered in part: below the sums of colors of all overflow tiles is what covers their pixels (tile/covering.glsl): fall, gap, and sum.
const bool COVERS = COVERAGE_EDGES && IN_SLOTS;

ivec2 place_of_covering(int row)
{
    return pixel_in_slot(row) + ivec2(0, imageSize(color_sums).y / (REACHES ? 3 : 2));
}

// REACHES: below that, what disks at a border cover.
ivec2 place_of_border(int row)
{
    return pixel_in_slot(row) + ivec2(0, imageSize(color_sums).y / 3 * 2);
}

// Where images have what a pixel of the tile has.
ivec2 stored_at(int row)
{
    return IN_SLOTS ? pixel_in_slot(row) : pixel_of(row);
}

void load(bool goes_on)
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        ivec2 pixel = pixel_within_image(row);
        ivec2 place = IN_SLOTS ? pixel_in_slot(row) : pixel;
        visible[row] = DEPTH_PRELOADED ? texelFetch(depth_before, pixel, 0).r : 0.0;
        if (!SEES || goes_on) {
            visible[row] = texelFetch(visible_before, place, 0).r;
        }
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
        if (SUMS && goes_on) {
            colors[row] = texelFetch(color_sums_before, place, 0);
            normals[row] = texelFetch(normal_sums_before, place, 0);
        }
        begin_covering(row);
        if (COVERS && SUMS && goes_on) {
            vec4 covering = texelFetch(color_sums_before, place_of_covering(row), 0);
            fall[row] = covering.xy;
            gap[row] = covering.z;
            summed[row] = covering.w;
            border[row] = REACHES ? texelFetch(color_sums_before, place_of_border(row), 0).x : NO_BORDER;
            uncut[row] = vec3(covering.wz, border[row]);
        }
        polygon[row] = WITH_POLYGONS ? texelFetch(polygon_depth, pixel, 0).r : 0.0;
    }
}

// Half floats end at HALF_FLOAT_MAX, and what covers must not become 0. Of sums only ratios count.
void fit_half_floats(int row)
{
    vec4 largest = max(abs(colors[row]), abs(normals[row]));
    float most = max(max(largest.x, largest.y), max(largest.z, largest.w));
    float factor = most > HALF_FLOAT_FITS ? HALF_FLOAT_FITS / most : 1.0;
    if (colors[row].a > 0.0 && colors[row].a < LEAST_HALF_FLOAT) {
        factor = LEAST_HALF_FLOAT / colors[row].a;
    }
    colors[row] *= factor;
    normals[row] *= factor;
}

void main()
{
    bool whole = SEES && SUMS || push.part == WHOLE_TILES;
    Range range;
    if (!find_work(whole, range)) {
        return;
    }
    all_cover = COVERS;
    load(!whole && push.part > 0);
    if (SEES) {
        see(range);
    }
    if (SEES && KEEPS_DEPTH) {
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            imageStore(visible_depth, stored_at(row), vec4(visible[row]));
        }
    }
    if (SUMS) {
        sum(unhidden(range), false);
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            if (COVERS) {
                imageStore(color_sums, place_of_covering(row), vec4(fall[row], gap_of(row), covering_sum(row)));
                if (REACHES) {
                    imageStore(color_sums, place_of_border(row), vec4(border[row], vec3(0.0)));
                }
            }
            if (HALF_FLOATS) {
                fit_half_floats(row);
            }
            imageStore(color_sums, stored_at(row), colors[row]);
            imageStore(normal_sums, stored_at(row), normals[row]);
        }
    }
}
