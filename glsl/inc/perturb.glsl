// The tests' lever: each formula of the GPU path can be falsified by 1%, so that a comparison with the oracle that
// still passes is caught lying. Without TEST_FORMULAS (every build but the tests') nothing of it is compiled.
//
// FORMULA makes a value too large. FORMULA_LESS makes it too small: for those that bound what is drawn, where too much
// is only slow and must not be seen.

#include "inc/config.glsl"

#ifdef TEST_FORMULAS
#ifndef FORMULA // planes bring it, too
layout(constant_id = SPEC_PERTURBED_FORMULA) const uint PERTURBED_FORMULA = 0;
#define FORMULA(number, value) ((PERTURBED_FORMULA == number) ? 1.01 * (value) : (value))
#define FORMULA_LESS(number, value) ((PERTURBED_FORMULA == number) ? 0.99 * (value) : (value))
#endif
#else
#define FORMULA(number, value) (value)
#define FORMULA_LESS(number, value) (value)
#endif

// The numbers; src/passes/pipeline/formula.rs names the same.
#define FORMULA_INVERSE_MAPPING_U 1
#define FORMULA_INVERSE_MAPPING_V 2
#define FORMULA_INVERSE_MAPPING_W 3
#define FORMULA_EXPANSION_POINT 4
#define FORMULA_CENTER_CONSTANTS 5
#define FORMULA_BOX_CENTER 6
#define FORMULA_BOX_HALF_SIZE 7
#define FORMULA_NEAR_BOX 8
#define FORMULA_EPSILON_SHIFT 9
#define FORMULA_FILTER_RADIUS 10
#define FORMULA_FILTER_ROTATION 11
#define FORMULA_KERNEL 12
#define FORMULA_TANGENT_FRAME 13
#define FORMULA_NORMAL 14
#define FORMULA_COLOR 15
#define FORMULA_DEPTH_SUM 16
#define FORMULA_VIEW_TRANSFORM 17
#define FORMULA_ELSEWHERE_CONSTANTS 18
#define FORMULA_COVERAGE 19
#define FORMULA_NEAR_CUT 20
#define FORMULA_KERNEL_POWER 21
#define FORMULA_POINT_CENTER 22
#define FORMULA_POINT_SIZE 23
#define FORMULA_QUAD_CORNER 24
#define FORMULA_NORMALIZED_COLOR 25
#define FORMULA_NORMALIZED_DEPTH 26
#define FORMULA_EYE_DIRECTION 27
#define FORMULA_DIFFUSE 28
#define FORMULA_SPECULAR 29
#define FORMULA_LOW_PASS 30
#define FORMULA_LOW_PASS_BOX 31
#define FORMULA_SHARE 32
#define FORMULA_AFFINE_MAP 33
#define FORMULA_CONTOUR 34
#define FORMULA_RAY_DEPTH 35
#define FORMULA_RAY_AXIS 36
#define FORMULA_APPROXIMATE_SIZE 37
#define FORMULA_TRIANGLE_CORNER 38
#define FORMULA_KERNEL_TEXTURE 39
#define FORMULA_NEAREST_DEPTH 40
#define FORMULA_WIDENED 41
#define FORMULA_KEPT_DEPTH 42
#define FORMULA_ALPHA 43
#define FORMULA_PEELED 44
#define FORMULA_TOWARD_VIEWER 45
#define FORMULA_TRANSITION 46
#define FORMULA_POLYGON_DEPTH 47
#define FORMULA_POLYGON_SHIFT 48
#define FORMULA_OVER 49
#define FORMULA_LIT_DIFFUSE 50
#define FORMULA_LIT_SPECULAR 51
#define FORMULA_STACKED 52
#define FORMULA_LENGTHENED 53
#define FORMULA_EYE_DOME 54
#define FORMULA_EDGE_OPACITY 55
#define FORMULA_CLIP_LINE 56
#define FORMULA_CLIP_CURVE 57
#define FORMULA_CLIP_RAMP 58
#define FORMULA_PLANE 59
#define FORMULA_CREASE 60
#define FORMULA_SHARP_SUM 61
#define FORMULA_OUTLINED 62
#define FORMULA_REACH 63
#define FORMULA_BORDER_DISTANCE 64
#define FORMULA_LAYER_BEHIND 65
#define FORMULA_LAYER_BESIDE 66
