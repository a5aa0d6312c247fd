// Which splats are surely inside of a surface, away from where it ends.
//
// Sums of weights over the overlap (inc/edges.glsl) vary inside of a surface, by an eighth where splats are larger than the filter, and what is behind would
// show through. About the silhouette of a smooth surface they are right as they are. There the surface turns away: at d pixels from the silhouette the cosine
// between normal and ray is the root of 2 d / R, R the radius of curvature in pixels. From two pixels on a splat is taken to be inside, of a surface that
// bends by 0.03 within one splat (EDGE_BEND); finer ones bend less, but are small, so that the filter evens their sums out.

// How surely a surface of this cosine between normal and ray does not end there, if it may end up to the cosine `may_end`.
float surely_inside(float facing, float may_end)
{
    float x = clamp(facing / may_end - 1.0, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// What weights over the overlap of a splat are multiplied by, whose map has this change of u and v per pixel.
float inside_factor(float facing, vec4 uv)
{
    float per_size2 = abs(uv.x * uv.w - uv.y * uv.z) * inversesqrt(dot(uv, uv)); // one over the root of the sum of its axes' squares
    float may_end = min(sqrt(EDGE_BEND * per_size2), EDGE_FACING);
    return mix(1.0, 1.0 / WHOLE_EDGE_SUM, surely_inside(facing, may_end));
}
