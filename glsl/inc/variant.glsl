// What differs between pipelines of the same shader; config.glsl says what each number means, and src/passes/pipeline/variant.rs sets them.
#include "inc/config.glsl"
#include "inc/projection.glsl"

layout(constant_id = SPEC_ELLIPSES) const bool ELLIPSES = false;
layout(constant_id = SPEC_CULL_BACKFACES) const bool CULL_BACKFACES = false;
layout(constant_id = SPEC_FILTER) const uint FILTER = FILTER_NONE;
layout(constant_id = SPEC_KERNEL) const uint KERNEL = KERNEL_GAUSSIAN;
layout(constant_id = SPEC_KERNEL_A) const float KERNEL_A = 2.0;
layout(constant_id = SPEC_KERNEL_N) const float KERNEL_N = 1.0;
layout(constant_id = SPEC_SHADING) const uint SHADING = SHADING_PHONG;
layout(constant_id = SPEC_RASTERIZER) const uint RASTERIZER = RASTERIZER_PERSPECTIVE;
layout(constant_id = SPEC_WEIGHT_BY_AREA) const bool WEIGHT_BY_AREA = false;
layout(constant_id = SPEC_COVERAGE_R2) const float COVERAGE_R2 = 1.0;
layout(constant_id = SPEC_FROM_CORNER) const bool FROM_CORNER = false;
layout(constant_id = SPEC_TRANSITION) const uint TRANSITION = TRANSITION_COLOR;
layout(constant_id = SPEC_OUTWARD) const bool OUTWARD = false;
layout(constant_id = SPEC_IN_LAYERS) const bool IN_LAYERS = false;
layout(constant_id = SPEC_OWN_EPSILON) const bool OWN_EPSILON = false;
layout(constant_id = SPEC_PACKED) const bool PACKED = false;
layout(constant_id = SPEC_FINE) const bool FINE = false;
layout(constant_id = SPEC_SPARSE) const bool SPARSE = false;
layout(constant_id = SPEC_HALF_SUMS) const bool HALF_SUMS = false;
layout(constant_id = SPEC_LEVELS) const uint LEVELS = LEVELS_NONE;
layout(constant_id = SPEC_BLENDED) const bool BLENDED = false;
layout(constant_id = SPEC_COVERAGE_EDGES) const bool COVERAGE_EDGES = false;
layout(constant_id = SPEC_REACHES) const bool REACHES = false;
layout(constant_id = SPEC_TWO_SIDED) const bool TWO_SIDED = false;

// Regular splats (see mapping.glsl) are mapped by an affine map: u and v are linear in the image. Of an orthographic camera all are.
const bool AFFINE = RASTERIZER == RASTERIZER_AFFINE_CENTER || RASTERIZER == RASTERIZER_AFFINE_CONTOUR
    || FILTER == FILTER_EWA || ORTHOGRAPHIC;
// Splats have weights of their own.
const bool WEIGHTED = FILTER == FILTER_EWA || WEIGHT_BY_AREA;

// What covers has a weight, 2^-60 at least: squares of sums don't vanish. In sums of 16 bits nothing above 0 is smaller than
// LEAST_HALF_FLOAT, and of less than a 16th they lose dark colors.
#define LEAST_SHARE (HALF_SUMS ? 1.0 / 16.0 : 0.0)
#define LEAST_WEIGHT (HALF_SUMS ? LEAST_HALF_FLOAT : 8.6736174e-19)
