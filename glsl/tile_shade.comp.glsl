// Visibility, accumulation and shading (finalize.frag.glsl) of a tile's splats: what a pixel shows, in place of sums, which never
// leave the registers; where nobody else reads them. Overflow tiles are left to tile_shade_overflow.comp.glsl.
//
// HIDDEN: what the tile's visible depth hides is not summed (tile/hidden.glsl). POLYGONS: polygons cover pixels in part (tile/polygons.glsl).
// Permutations: column pixel | _ hidden polygons
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
// Opaque surfaces are peeled where edges let what is behind them through.
#define PEELS COVERAGE_EDGES
#define OF_LAYERS false
#include "tile/surface.glsl"
#include "tile/ended.glsl"
#include "tile/hidden.glsl"

layout(set = 0, binding = BIND_COLORS) writeonly uniform image2D shown; // linear light and opacity, which multiplies it

layout(constant_id = SPEC_KEEPS_DEPTH) const bool KEEPS_DEPTH = false;
layout(set = 0, binding = BIND_VISIBLE_DEPTH) writeonly uniform image2D visible_depth;

// WITH_DEPTH: a host wants the depth of what is seen itself: the mean of its splats' own, not shifted; 0 where nothing is.
layout(set = 0, binding = BIND_NORMALS) writeonly uniform image2D own_depth;

#include "tile/polygons.glsl"

void begin_surface()
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        visible[row] = 0.0;
        colors[row] = vec4(0.0);
        normals[row] = vec4(0.0);
        begin_covering(row);
        begin_creases(row);
        visible_away[row] = false;
    }
}

// The depth of the surface that was summed; of both sides of a ridge, that of the one which has more of the pixel.
float own_depth_of(int row)
{
    bool beyond = CREASES && !(colors[row].w > 0.0);
    vec2 sums = beyond ? vec2(normals_beyond[row].w, colors_beyond[row].w) : vec2(normals[row].w, colors[row].w);
    float mean = FORMULA(FORMULA_NORMALIZED_DEPTH, sums.x / sums.y);
    return sums.y > 0.0 ? depth_of_mean(visible[row], mean) : 0.0;
}

// Puts polygons behind what a pixel shows already: so much of it, or what is left. `own`: as in shade_edges; where half is covered with them it is left to their
// depth at the middle of the pixel, which others have.
void put_behind(Polygons polygons, float whole, inout vec4 light, inout float own)
{
    float part = min(whole, 1.0 - light.a);
    if (WITH_DEPTH) {
        own = light.a < 0.5 && light.a + part >= 0.5 ? 0.0 : own;
    }
    light += part * vec4(polygons.light, 1.0);
}

// Surface after surface, until each pixel of the tile is covered or nothing is left: what lies side by side in a pixel adds up. But what ends toward the
// same side as what is before it lies behind that, as the far side of a plate does, and is seen only where it reaches further.
void shade_edges(Range range)
{
    vec4 light[ROWS];
    float polygons_left[ROWS]; // up to this depth polygons are not there yet
    float beside_depth[ROWS];  // of polygons before the surface; 0 where there are none
    float hiding[ROWS]; // depth of what covers half of a pixel, for transparent layers
    vec2 ended[ROWS];   // how what covers falls (tile/covering.glsl)
    float own[ROWS];    // WITH_DEPTH: the same, not shifted; where nothing covers as much, of what is nearest
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        light[row] = vec4(0.0);
        hiding[row] = 0.0;
        ended[row] = vec2(0.0);
        own[row] = 0.0;
        before[row] = INFINITELY_NEAR;
        before_away[row] = INFINITELY_NEAR;
        polygons_left[row] = INFINITELY_NEAR;
        begin_behind_polygons(row);
    }
    // A shader's loops have an end (tile/work.glsl): there are as many surfaces as it has walks over so many splats.
    uint most = clamp(PART_LENGTH / max(range.end - range.first, 1), 1, MOST_EDGE_SURFACES);
    for (uint number = 0; number < most; number++) {
        all_cover = number + 1 == most;
        begin_surface();
        see(range);
        bool left = false;
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            left = left || visible[row] > 0.0;
            beside_depth[row] = polygons_between(visible[row], polygons_left[row], row).depth;
            polygon[row] = max(beside_depth[row], visible[row]);
        }
        // Behind most silhouettes of a tile there is nothing.
        if (number > 0 && votes_of_tile(left).y == 0) {
            break;
        }
        sum(range, false);
        left = false;
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            Surface surface = normalized(colors[row], normals[row].xyz);
            vec3 v = to_eye(top_px + vec2(0.0, float(first_row + row)));
            vec3 color = shaded(surface.albedo, surface.normal, v);
            if (CREASES) {
                Surface beyond = normalized(colors_beyond[row], normals_beyond[row].xyz);
                color = mix(color, shaded(beyond.albedo, beyond.normal, v), share_beyond(row));
                surface.weight += beyond.weight;
            }
            float opacity = opacity_of(row);
            bool beside = WITH_POLYGONS && beside_depth[row] > 0.0;
            Polygons polygons = polygons_between(visible[row], polygons_left[row], row);
            float both = polygons.share;
            if (beside) {
                // Polygons are the nearest surface; splats of the same one blend with them (inc/resolve.glsl), in all that either of both covers.
                both = surface.weight > 0.0 ? max(opacity, both) : both;
                opacity = TRANSITION == TRANSITION_NONE ? 0.0 : min(FORMULA(FORMULA_TRANSITION, surface.weight / WHOLE_SEAM_SUM), 1.0);
                opacity *= both;
            }
            float behind = beside ? 0.0 : part_behind(fall[row], ended[row]);
            ended[row] += (1.0 - behind) * fall[row];
            float part = mix(min(opacity, 1.0 - light[row].a), max(opacity - light[row].a, 0.0), behind);
            part = surface.weight > 0.0 ? part : 0.0;
            bool covers_half = light[row].a < 0.5 && light[row].a + part >= 0.5;
            hiding[row] = covers_half ? visible[row] : hiding[row];
            if (WITH_DEPTH) {
                float depth = max(own_depth_of(row), beside ? beside_depth[row] : 0.0);
                own[row] = part > 0.0 && (covers_half || own[row] == 0.0) ? depth : own[row];
            }
            light[row] += part * vec4(color, 1.0);
            bool ends = !(surface.weight > 0.0) || light[row].a >= 1.0;
            if (WITH_POLYGONS) {
                put_behind(polygons, beside ? both - part : 0.0, light[row], own[row]);
                polygons_left[row] = beside ? visible[row] : polygons_left[row];
                // Behind polygons that cover a part there may be more, where splats are left.
                ends = light[row].a >= 1.0 || (beside ? POLYGON_SAMPLES == 1 || visible[row] == 0.0 : ends);
                go_behind_polygons(beside, row);
            }
            if (BY_SIDES) {
                before_away[row] = ends ? NOTHING_LEFT : visible_away[row] && !beside ? visible[row] : before_away[row];
                before[row] = ends ? NOTHING_LEFT : visible_away[row] || beside ? before[row] : visible[row];
            } else {
                before[row] = ends ? NOTHING_LEFT : beside ? before[row] : visible[row];
            }
            left = left || !ends;
        }
        if (votes_of_tile(left).y == 0) {
            break;
        }
    }
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        if (WITH_POLYGONS) {
            Polygons rest = polygons_between(0.0, polygons_left[row], row);
            put_behind(rest, rest.share, light[row], own[row]);
        }
        vec4 seen = light[row];
        seen.rgb = HALF_FLOATS ? min(seen.rgb, HALF_FLOAT_MAX) : seen.rgb;
        imageStore(shown, pixel_of(row), seen);
        if (KEEPS_DEPTH) {
            imageStore(visible_depth, pixel_of(row), vec4(hiding[row]));
        }
        if (WITH_DEPTH) {
            imageStore(own_depth, pixel_of(row), vec4(own[row]));
        }
    }
}

void main()
{
    Range range;
    if (!find_work(true, range)) {
        return;
    }
    if (COVERAGE_EDGES) {
        shade_edges(range);
        return;
    }
    begin_surface();
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
        if (WITH_DEPTH) {
            float of_polygon = WITH_POLYGONS ? polygon[row] : 0.0;
            imageStore(own_depth, pixel_of(row), vec4(max(own_depth_of(row), of_polygon)));
        }
    }
}
