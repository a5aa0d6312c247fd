// Visibility splatting, for points.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/point_coverage.glsl"
#include "inc/visibility.glsl"
