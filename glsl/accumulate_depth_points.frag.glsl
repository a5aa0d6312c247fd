// Attribute accumulation with the depth of the surface, for points.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/variant.glsl"
#include "inc/point_coverage.glsl"
#include "inc/kernel.glsl"

layout(location = 3) flat in vec3 splat_normal; // view space, unit, toward the eye

#include "inc/accumulate_depth.glsl"
