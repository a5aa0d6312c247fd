// Attribute accumulation, for quads.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/quad_coverage.glsl"
#include "inc/kernel.glsl"

layout(location = 4) flat in vec3 splat_normal; // view space, unit, toward the eye

#include "inc/accumulate.glsl"
