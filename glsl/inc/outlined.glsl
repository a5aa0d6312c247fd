// What a splat of a sharp surface covers of a pixel as no filter has widened it, where the surface goes on around it.
//
// Its ellipse passes through the corners of a triangle, so that together ellipses hold all of the surface, and what they cover sums to a whole wherever it goes
// on: up to the ridges, where curves tell what is left. Weights do not (inc/edges.glsl): they fall to a seventh at a corner, and beyond a ridge nothing lies.
//
// In the principal axes of its image, u and v, of L pixels each, the unfiltered ellipse has the axes l = sqrt(L^2 - h^2). A pixel is rho of its radii from the center,
// rho^2 = (u L / l)^2 + (v L / l)^2, and so (1 - rho) / |grad rho| inside of the rim, to first order. The part is that of a half plane at that distance, a ramp with the slope of
// the normal distribution; what is narrower than the ramp covers no more than the strip that it is.
//
// Ellipses overlap, by 2.4 times what their triangles are on average, so that their sum is too much across an end that no curve tells to the pixel, and the more of them are
// there the bolder that end is: what is narrower than half of the filter's radius is left to its weights more and more, as they sum to what is there.

#define RAMP_PX (0.5 * ROOT_TWO_PI * FILTER_PX)
const float LEAST_OWN2 = 1e-3; // of L^2

// The factors of u^2 and v^2 in rho^2, how much of the ramp it fills, and how surely the surface goes on and it is not narrow. `uv`: as own_coverage has it.
vec4 outline_of(vec4 uv, float goes_on)
{
    vec2 inverse2 = vec2(dot(uv.xy, uv.xy), dot(uv.zw, uv.zw)); // 1 / L^2
    vec2 own = max(1.0 - FILTER_PX * FILTER_PX * inverse2, LEAST_OWN2);
    vec2 axes_px = sqrt(own / inverse2);
    vec2 wide = min(2.0 / RAMP_PX * axes_px, 1.0);
    // All of it where the narrower axis is 3/4 of the filter's radius, none at 1/4.
    float is_wide = smooth_step(2.0 / FILTER_PX * min(axes_px.x, axes_px.y) - 0.5);
    return vec4(1.0 / own, wide.x * wide.y, goes_on * is_wide);
}

// What it covers. `uvw`: (uw, vw, w).
float part_of_outline(vec4 outline, vec4 uv, vec3 uvw)
{
    vec2 scaled = outline.xy * uvw.xy;
    float rho2 = dot(scaled, uvw.xy); // w^2 times
    vec2 slope = uv.xy * scaled.x + uv.zw * scaled.y; // half of how rho^2 changes a pixel
    float inside_px = (sqrt(rho2) * uvw.z - rho2) * inversesqrt(max(dot(slope, slope), 1e-20));
    float part = clamp(min(0.5 + inside_px / RAMP_PX, outline.z), 0.0, 1.0);
    return outline.w * FORMULA(FORMULA_OUTLINED, part);
}
