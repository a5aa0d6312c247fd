// What differs between pipelines of the same shader. The host's mirror is src/passes/variant.rs.

layout(constant_id = 0) const bool ELLIPSES = false;       // splats carry tangent vectors; else normal and radius
layout(constant_id = 1) const bool CULL_BACKFACES = false; // splats that face away are not drawn; else flipped
layout(constant_id = 2) const uint FILTER = 0;             // FILTER_NONE ...
layout(constant_id = 3) const uint KERNEL = 0;             // KERNEL_GAUSSIAN or KERNEL_PSI_E
layout(constant_id = 4) const float KERNEL_A = 2.0;        // gaussian: log2(e) / (2 sigma^2); psi_e: log2(e) a
layout(constant_id = 5) const float KERNEL_N = 1.0;        // psi_e: n
layout(constant_id = 6) const uint SHADING = 0;            // SHADING_PHONG ...
layout(constant_id = 7) const uint RASTERIZER = 0;         // RASTERIZER_PERSPECTIVE ...
layout(constant_id = 8) const bool WEIGHT_BY_AREA = false; // adjusted splats weigh old area / new area; else 1
layout(constant_id = 9) const bool EARLY_DEPTH = false;    // the vertex stage bounds the fragments' depth; else any will do
layout(constant_id = 10) const float COVERAGE_R2 = 1.0;    // largest u^2 + v^2 that covers: less where the kernel ends earlier
layout(constant_id = 11) const bool FROM_CORNER = false;   // places may be counted from the corner (places.glsl)
layout(constant_id = 12) const uint TRANSITION = 0;        // TRANSITION_COLOR ...
layout(constant_id = 13) const bool OUTWARD = false;       // transparent and closed: normals stay outward in layers (shown.glsl)
layout(constant_id = 14) const bool IN_LAYERS = false;     // transparent: drawn in layers (mapping.glsl)
layout(constant_id = 15) const bool PACKED = false;        // disks in 16 bytes, their colors in 4 (packed.glsl)

#define FILTER_NONE 0
#define FILTER_ADJUST 1
#define FILTER_ADJUST_PAPER 2
#define FILTER_MAX 3
#define FILTER_EWA 4
#define KERNEL_GAUSSIAN 0
#define KERNEL_PSI_E 1
#define SHADING_PHONG 0
#define SHADING_LAMBERT 1
#define SHADING_NORMALS 2
#define SHADING_ALBEDO 3
#define TRANSITION_COLOR 0
#define TRANSITION_ATTRIBUTES 1
#define TRANSITION_NONE 2
#define RASTERIZER_PERSPECTIVE 0
#define RASTERIZER_PERSPECTIVE_PAPER 1
#define RASTERIZER_RAYCAST 2
#define RASTERIZER_RAYCAST_APPROXIMATE 3
#define RASTERIZER_AFFINE_CENTER 4
#define RASTERIZER_AFFINE_CONTOUR 5
#define RASTERIZER_TRIANGLE 6

// Regular splats (see mapping.glsl) are mapped by an affine map: u and v are linear in the image.
const bool AFFINE = RASTERIZER == RASTERIZER_AFFINE_CENTER || RASTERIZER == RASTERIZER_AFFINE_CONTOUR
    || FILTER == FILTER_EWA;
// Splats have weights of their own.
const bool WEIGHTED = FILTER == FILTER_EWA || WEIGHT_BY_AREA;
