// Visibility splatting, for quads.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/quad_coverage.glsl"
#include "inc/visibility.glsl"
