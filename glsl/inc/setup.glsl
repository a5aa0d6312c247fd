// All that the stages which set splats up include: constants, variants, the splat, its filter, its map, its box.

#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/splat.glsl"

#include "inc/principal.glsl"
#include "inc/adjust.glsl"
#include "inc/adjust_paper.glsl"
#include "inc/mapping.glsl"
#include "inc/box.glsl"
#include "inc/image_map.glsl"
#include "inc/splat_box.glsl"
#include "inc/clip.glsl"
#include "inc/clip_image.glsl"

// What is not drawn goes here: outside of the clip volume.
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
