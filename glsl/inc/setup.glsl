// All that the stages which set splats up include: constants, variants, the splat, its filter, its map, its box.

#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/splat.glsl"
#include "inc/adjust.glsl"
#include "inc/mapping.glsl"
#include "inc/box.glsl"

// What is not drawn goes here: outside of the clip volume.
const vec4 NOWHERE = vec4(2.0, 2.0, 2.0, 1.0);
// The fragment stage writes the depth; this one only has to be inside the clip volume.
const float SAFE_DEPTH = 0.5;
