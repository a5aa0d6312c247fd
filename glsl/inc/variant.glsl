// What differs between pipelines of the same shader. The host's mirror is src/passes/variant.rs.

layout(constant_id = 0) const bool ELLIPSES = false;       // splats carry tangent vectors; else normal and radius
layout(constant_id = 1) const bool CULL_BACKFACES = false; // splats that face away are not drawn; else flipped
layout(constant_id = 2) const bool FILTER_ADJUST = false;  // tangent adjustment; else no filter
layout(constant_id = 3) const uint KERNEL = 0;             // KERNEL_GAUSSIAN or KERNEL_PSI_E
layout(constant_id = 4) const float KERNEL_A = 2.0;        // gaussian: log2(e) / (2 sigma^2); psi_e: log2(e) a
layout(constant_id = 5) const float KERNEL_N = 1.0;        // psi_e: n
layout(constant_id = 6) const uint SHADING = 0;            // SHADING_PHONG ...

#define KERNEL_GAUSSIAN 0
#define KERNEL_PSI_E 1
#define SHADING_PHONG 0
#define SHADING_LAMBERT 1
#define SHADING_NORMALS 2
#define SHADING_ALBEDO 3
