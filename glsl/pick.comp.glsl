// What is picked in an image of one pixel: of each word of splats the one whose depth, moved away from the eye by epsilon, is nearest, as visibility
// has it. The host takes the nearest of all words.
#version 460
#include "inc/setup.glsl"
#include "inc/quad.glsl"
#include "inc/list.glsl"
#include "inc/levels.glsl"
#include "inc/picked.glsl"
#define PLANES_SET 1
#define PLANES_BINDING BIND_LIST_PLANES
#include "inc/planes.glsl"

layout(local_size_x = LIST_GROUP_SIZE) in;

// Depth of a splat in the pixel, 0 where it does not cover it: as glsl/inc/coverage.glsl has it.
float depth_of(uint index, Mapping m, vec2 px)
{
    Quad quad;
    if (!quad_of(m, 0, quad)) {
        return 0.0;
    }
    if (CLIPS) {
        Curve curves[2];
        clip_in_image(index, m, curves);
        bool first = keeps(curves[0], px);
        bool second = keeps(curves[1], px);
        if (!(is_told(curves[1].c, CURVE_BOTH) ? first || second : first && second)) {
            return 0.0;
        }
    }
    ImageMap map = quad_map(m, quad);
    vec2 d = px - map.x0_px;
    vec3 uvw = map.at_x0 + (map.along_x * d.x + map.along_y * d.y);
    if (!map.affine) {
        uvw.xy /= uvw.z;
    }
    bool inside = dot(uvw.xy, uvw.xy) <= COVERAGE_R2 && uvw.z > 0.0 && uvw.z <= 1.0 + 1e-6;
    float depth = inside ? uvw.z : 0.0;
    if (FILTER == FILTER_MAX && m.p.z > nearest_drawn(m)) {
        vec2 argument = (px - projected_center_px(m)) / (frame.filter_radius * frame.focal_px);
        if (!inside && dot(argument, argument) <= COVERAGE_R2) {
            depth = center_depth(m);
        }
    }
    depth = min(depth, 1.0);
    return PLANES > 0 && is_cut_off(px, depth) ? 0.0 : depth;
}

void main()
{
    uint word = LIST_INVOCATION;
    if (word >= words_of_chunk()) {
        return;
    }
    uint block = block_of(word);
    uint first = first_splat_of(block, word);
    uint end = min(first + WORD, frame.splat_count);
    uint bits = 0xffffffff;
    if (LEVELS != LEVELS_NONE && first < end && !is_known(block, ALL_OF_LEVEL)) {
        bits = bits_of_level(first / WORD);
    }
    vec2 px = 0.5 - frame.middle_px;
    Picked nearest = NOTHING_PICKED;
    for (uint index = first; index < end; index++) {
        Mapping m;
        if ((bits >> (index - first) & 1) != 0 && map_splat(index, m)) {
            float depth = depth_of(index, m, px);
            float moved = shifted(depth, m.shift);
            if (depth > 0.0 && moved > nearest.moved) {
                nearest = Picked(moved, depth, index, 0, vec4(m.normal, 0.0));
            }
        }
    }
    picked[first_word_of_chunk() + word] = nearest;
}
