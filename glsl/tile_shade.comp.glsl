// What a tile shows whose splats were seen and summed in parts (tile_splat.comp.glsl with IN_SLOTS), as SHADED there does it of all
// others in registers. One workgroup an overfull tile, one invocation a pixel.
//
// HALF, SINGLE: the precision of what is shown; sums in parts have 32 bits. LIT: the scene has lights of its own. SHORT: tiles are
// half as high.
// Permutations: half single | _ lit | _ short
#version 460
#include "inc/perturb.glsl"
#include "inc/variant.glsl"
#include "inc/tiles.glsl"
layout(push_constant, std430) uniform Push { TileConstants push; };
#define IS_WHOLE false
#define PIXELS // one an invocation
#include "inc/tile_work.glsl"
#define LIGHTS_SET 0
#define LIGHTS_BINDING 16
#include "inc/shading.glsl"
#include "inc/normalized.glsl"

layout(set = 0, binding = 11, rgba32f) readonly uniform image2D color_sums;
layout(set = 0, binding = 12, rgba32f) readonly uniform image2D normal_sums;
#if defined(HALF)
layout(set = 0, binding = 13, rgba16f)
#else
layout(set = 0, binding = 13, rgba32f)
#endif
writeonly uniform image2D shown_colors; // linear light; 1: something is there

void main()
{
    if (GROUP_NUMBER >= starts[STARTS_OVERFULL]) {
        return;
    }
    ivec2 top = top_pixel(overfull_tiles[GROUP_NUMBER]);
    ivec2 pixel = pixel_of(top, 0);
    ivec2 in_slot = pixel_in_slot(0);
    Surface surface = normalized(imageLoad(color_sums, in_slot), imageLoad(normal_sums, in_slot).xyz);
    vec3 light = shaded(surface.albedo, surface.normal, to_eye(from_middle_px(pixel)));
#if defined(HALF)
    light = min(light, 65504.0); // where half floats end
#endif
    imageStore(shown_colors, pixel, surface.weight > 0.0 ? vec4(light, 1.0) : vec4(0.0));
}
