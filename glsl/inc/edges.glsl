// What part of a pixel a surface covers, where it ends: its opacity there. In none of the papers, to which a pixel is
// covered or not.
//
// The filter widens a splat by the convolution with the low-pass filter G, and leaves it its area as weight. So the sum of
// weights is (G * K), with K(x) = sum of k(u, v) the unfiltered splats' own. The host finds what K is around each splat, the surface's
// *overlap* there, when a scene is prepared (src/geometry/overlaps.rs): with each weight over its overlap K is about 1 inside of a surface,
// and 0 outside. So the sum is A = (G * [inside]): the share of the
// pixel, under the filter, that the surface covers. So slivers near a silhouette, each of which covers little, cover a
// pixel together.
//
// Sums inside of a surface vary still, by an eighth and more where splats are larger than the filter, and what is behind would show through. So A is taken
// for what it is where the surface ends, and stretched above one half elsewhere, so that it is whole from WHOLE_EDGE_SUM on. How steeply A falls tells
// which: at the border of a half plane A = Phi(d / (sigma h)), d the distance in pixels, and falls by phi(Phi^-1(A)) / (sigma h) a pixel, which is
// A (1 - A) (2.15 - 2.2 A (1 - A)) over sigma h within 0.01. Inside A falls by a fifth of that, mostly. What falls by less than a quarter of it is inside for sure,
// and whole from a smaller sum on, WHOLE_FLAT_SUM. Where little is missing, noise may be as steep: from A = 0.92 on it counts as whole.
//
// Of what ends A is a little small: weights end with the kernel, at two standard deviations, and the rims of the last splats stand out of what
// is whole. t - A over A is 0.225 sqrt(A) (1 - A)^2 within 0.01 for balls and scans whose splats are up to some pixels large (LEFT_OUT).
// Where curves cut splats off, no rims stand out, and what lies outside of a part is not to be seen more: there A is left as it is.
//
// A falls short where one splat covers a pixel alone: at the rim of a large splat k is far below the overlap. There its own
// part C is a lower bound, of the distance d of the pixel to the rim of the unfiltered ellipse: the normal distribution of
// d / (sigma h), here a ramp of its slope. In units of the widened ellipse the rim is at rho = l2 / L2, with
// rho^2 = 1 - h^2 / L2^2, and d = (rho^2 - r^2) L2 / 2, as near the end of the minor axis. So
// C = 1/2 + (rho^2 - r^2) L2 / (2 sqrt(2 pi) sigma h); for splats below h, of which that is not true, it goes to 0. The
// opacity is max(A, C), and whole where next to nothing is missing. Own parts of several splats are taken for independent: what they leave
// uncovered multiplies.
//
// Where a surface has a border, C is short of it beyond the middle of the ramp, for widened splats end there: those at a border reach further, and have another C (reach.glsl).
// They lie beside each other along it, so that the one that covers most stands for all of them; what they and the others leave uncovered multiplies.
//
// Rough surfaces, as scanners measure them with noise, sum to less in places the flatter they are seen: their overlap is taken for less (src/geometry/overlaps.rs).
//
// Sharp surfaces are made of ellipses through the corners of triangles, slivers among them: at the corners of a flat side, and at its ridges, where
// nothing lies beyond, A is a half of its mean, and less. There the curves tell what is covered (inc/clip_image.glsl), so that A may be too much: it is
// SHARP_SUM times as much, but where the surface ends by turning away or is seen edge-on (tile_project.comp.glsl); and there what unfiltered ellipses cover is covered
// (inc/outlined.glsl).
//
// Limits: surfaces of which several lie within a few epsilon; A of a thin line of splats is too small, and along its middle, where it does not fall, may count as whole.

#include "inc/minor_axis.glsl"
#include "inc/smooth_step.glsl"
#include "inc/widened.glsl"
#include "inc/reach.glsl"

const float ROOT_TWO_PI = 2.5066283;
const float LN_2 = 0.69314718;

layout(constant_id = SPEC_FILTER_PX) const float FILTER_PX = 1.41421356; // h; the filter's own sigma is 1/2

// What is covered to all but so little is covered: sums inside of a surface are not all the same.
const float NEARLY_WHOLE = 0.96;

const float LEFT_OUT = 0.225;

// Less than any argument of Phi.
const float NO_BORDER = -9.0;

// What falls as steeply, and no steeper, may end there or go on.
const float NOT_FLAT = 0.45;

// C = x - y r^2 of a splat whose map has this change of u along x and y, and of v, per pixel.
vec2 own_coverage(vec4 uv)
{
    float inverse2 = inverse_minor2(uv); // 1 / L2^2
    float minor_px = inversesqrt(inverse2);
    float rho2 = max(1.0 - FILTER_PX * FILTER_PX * inverse2, 0.0);
    float sureness = smooth_step(2.0 * sqrt(rho2) * minor_px / FILTER_PX - 1.0); // from none at l2 = h / 2 to all at h
    float slope = sureness * minor_px / (ROOT_TWO_PI * FILTER_PX);
    return vec2(0.5 * sureness + slope * rho2, slope);
}

// Of a splat at a border, which reaches further (reach.glsl), the argument of Phi: x, which is returned, less z u^2 + w v^2. r^2 in the filtered ellipse is x u^2 + y v^2.
float border_distance(vec4 uv, out vec4 reach)
{
    vec2 reaching_px = inversesqrt(vec2(dot(uv.xy, uv.xy), dot(uv.zw, uv.zw)));
    vec2 own_px = max(reaching_px - REACH * FILTER_PX, LEAST_REACHING * FILTER_PX);
    vec2 filtered_px = vec2(widened_axis(own_px.x, FILTER_PX), widened_axis(own_px.y, FILTER_PX));
    float size = FORMULA(FORMULA_BORDER_DISTANCE, sqrt(own_px.x * own_px.y) / FILTER_PX); // g
    float narrow = max(0.5 - size, 0.0);
    vec2 to_filtered = reaching_px / filtered_px;
    vec2 to_own = reaching_px / own_px;
    reach = vec4(to_filtered * to_filtered, size * to_own * to_own);
    return size - narrow * (2.0 + narrow);
}

// Phi within 1.5e-4 (Bowling, Khasawneh, Kaewkuekool, Cho: "A logistic approximation to the cumulative normal distribution", JIEM 2(1), 2009).
float normal_distribution(float z)
{
    return 1.0 / (1.0 + exp(-z * (1.5976 + 0.07056 * z * z)));
}

// What splats cover by themselves: what others leave uncovered, and the largest argument of Phi of those at a border. Of what is right as it is, next to nothing is not missing.
float own_of(float gap, float border)
{
    return REACHES ? 1.0 - gap * (1.0 - NEARLY_WHOLE * normal_distribution(border)) : 1.0 - gap;
}

// How steeply A falls, over how steeply it falls at a border. `fall`: by how much a pixel, over twice the decline of the kernel's logarithm at the center (kernel.glsl).
float steepness_of(float summed, float fall)
{
    float sum = min(summed, 1.0);
    float left = sum * (1.0 - sum);
    float steep = LN_2 * KERNEL_A * FILTER_PX * fall; // over sigma h, of which sigma is 1/2
    return steep / max(left * (2.15 - 2.2 * left), 1e-6);
}

// `summed`: A. `own`: C.
float edge_opacity(float summed, float own, float steepness)
{
    float sum = min(summed, 1.0);
    float ends = smooth_step((steepness - NOT_FLAT) / 0.35) * smooth_step((0.92 - sum) * 10.0);
    float whole = mix(WHOLE_FLAT_SUM, WHOLE_EDGE_SUM, smooth_step((steepness - 0.25) / 0.2));
    float stretched = min(sum, 0.5) + max(sum - 0.5, 0.0) * (0.5 / (whole - 0.5));
    float at_end = sum + (CURVED ? 0.0 : LEFT_OUT) * sqrt(sum) * (1.0 - sum) * (1.0 - sum);
    float opacity = FORMULA(FORMULA_EDGE_OPACITY, max(mix(stretched, at_end, ends), own) / NEARLY_WHOLE);
    return clamp(opacity, 0.0, 1.0);
}
