// Numbers that shaders and host share. build.rs makes a constant of `surfel::shaders::config` of each; what stands behind a number
// becomes its documentation.

// Specialization constants.
#define SPEC_ELLIPSES 0       // Constant: splats carry tangent vectors; else a normal and a radius.
#define SPEC_CULL_BACKFACES 1 // Constant: splats that face away are not drawn; else their normals are turned to the eye.
#define SPEC_FILTER 2         // Constant: one of `FILTER_*`.
#define SPEC_KERNEL 3         // Constant: one of `KERNEL_*`.
#define SPEC_KERNEL_A 4       // Constant: log2(e) / (2 sigma^2) of a Gaussian, log2(e) a of psi_e.
#define SPEC_KERNEL_N 5       // Constant: n of psi_e.
#define SPEC_SHADING 6        // Constant: one of `SHADING_*`.
#define SPEC_RASTERIZER 7     // Constant: one of `RASTERIZER_*`.
#define SPEC_WEIGHT_BY_AREA 8 // Constant: splats that a filter enlarged weigh their old area over the new one; else 1.
#define SPEC_COVERAGE_R2 10   // Constant: the largest u^2 + v^2 that covers; below 1 where the kernel ends earlier.
#define SPEC_FROM_CORNER 11   // Constant: places may be counted from the image's corner (`inc/places.glsl`).
#define SPEC_TRANSITION 12    // Constant: one of `TRANSITION_*`.
#define SPEC_OUTWARD 13       // Constant: transparent and closed; normals stay outward in layers.
#define SPEC_IN_LAYERS 14     // Constant: transparent; drawn in layers.
#define SPEC_PACKED 15        // Constant: disks in 16 bytes, their colors in 4 (`inc/packed.glsl`).

// Values of SPEC_FILTER.
#define FILTER_NONE 0         // No filter.
#define FILTER_ADJUST 1       // Tangent adjustment of the principal axes.
#define FILTER_ADJUST_PAPER 2 // Tangent adjustment as published (Guennebaud et al. 2006, equations 8 to 10).
#define FILTER_MAX 3          // The larger one of kernel and low-pass filter (Botsch et al. 2005).
#define FILTER_EWA 4          // Full EWA: an affine map, convolved with the low-pass filter.

// Values of SPEC_KERNEL.
#define KERNEL_GAUSSIAN 0 // exp(-r^2 / (2 sigma^2)).
#define KERNEL_PSI_E 1    // Pajarola et al. 2003, section 5.2.

// Values of SPEC_SHADING.
#define SHADING_PHONG 0   // Diffuse and specular light.
#define SHADING_LAMBERT 1 // Diffuse light.
#define SHADING_NORMALS 2 // Normals as colors.
#define SHADING_ALBEDO 3  // Unlit.

// Values of SPEC_TRANSITION.
#define TRANSITION_COLOR 0      // Splats and polygons blend as shaded colors.
#define TRANSITION_ATTRIBUTES 1 // They blend as attributes, before shading.
#define TRANSITION_NONE 2       // Polygons hide splats of the same surface.

// Values of SPEC_RASTERIZER.
#define RASTERIZER_PERSPECTIVE 0         // Perspective-correct, expanded about the projected center.
#define RASTERIZER_PERSPECTIVE_PAPER 1   // The same in the paper's form, about the image's middle.
#define RASTERIZER_RAYCAST 2             // Ray casting (Botsch et al. 2005).
#define RASTERIZER_RAYCAST_APPROXIMATE 3 // Ray casting with its approximate point size.
#define RASTERIZER_AFFINE_CENTER 4       // An affine map, exact at the center.
#define RASTERIZER_AFFINE_CONTOUR 5      // An affine map, exact at the contour.
#define RASTERIZER_TRIANGLE 6            // Triangles in the splat's plane (Pajarola et al. 2003, section 5.2).
