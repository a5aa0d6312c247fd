// Which of the tiles in the corners of a splat's box have no pixel that it covers: an ellipse leaves out the corners of its box,
// and small ones have tiles there.
//
// A pixel is covered where f = (uw)^2 + (vw)^2 - R^2 w^2 is not above 0: a quadratic function of the pixel, convex where what it covers
// is an ellipse. Of the tile in a corner, P is the pixel that is nearest to the box's middle. If f(P) > 0, and f grows from P away from
// the middle in x and in y, then f > 0 in all of the tile, since a convex function is nowhere below its tangent plane.
//
// Pixels find f from the record (tile/splat.glsl), whose numbers are those here, with roundings of some 2^-22 of T, what its terms are at
// most; so does this, and its slope. T is that of a place a pixel beyond P; 8 pixels beyond, terms are at most 81 times as much: 2e-5 T.
// What is left out has f(P) > 2^-10 T.

// `first`, `last`: the tiles of the box's corners, in tiles of that size.
uint corners_outside(ImageMap map, uvec2 first, uvec2 last, vec2 tile_px)
{
    if (any(equal(first, last))) {
        return 0;
    }
    float limit = FORMULA(FORMULA_COVERAGE, COVERAGE_R2);
    // Over the depth at the center, which may be so small that its square is none.
    float w0 = map.at_x0.z;
    vec3 along_x = map.affine ? vec3(map.along_x.xy, 0.0) : map.along_x / w0;
    vec3 along_y = map.affine ? vec3(map.along_y.xy, 0.0) : map.along_y / w0;
    // The centers of the last pixels of the first tiles, and of the first of the last ones, from the map's middle: rounded once.
    vec2 near_px = (vec2(first + 1) * tile_px - 0.5 - frame.middle_px) - map.x0_px;
    vec2 far_px = (vec2(last) * tile_px + 0.5 - frame.middle_px) - map.x0_px;
    vec2 most_px = max(abs(near_px), abs(far_px)) + 1.0;
    vec3 most = abs(along_x) * most_px.x + abs(along_y) * most_px.y + vec3(0.0, 0.0, 1.0);
    float margin = 9.765625e-4 * (dot(most.xy, most.xy) + limit * most.z * most.z);
    uint outside = 0;
    [[unroll]] for (uint corner = 0; corner < 4; corner++) {
        bool right = (corner & 1) != 0;
        bool below = (corner & 2) != 0;
        vec3 uvw = along_x * (right ? far_px.x : near_px.x) + along_y * (below ? far_px.y : near_px.y) + vec3(0.0, 0.0, 1.0);
        vec3 slope = vec3(uvw.xy, -limit * uvw.z);
        float slope_x = dot(slope, along_x);
        float slope_y = dot(slope, along_y);
        bool grows = (right ? slope_x : -slope_x) > 0.0 && (below ? slope_y : -slope_y) > 0.0;
        outside |= grows && dot(slope, uvw) > margin ? 1u << corner : 0u;
    }
    // A row keeps one tile at least.
    if (last.x == first.x + 1) {
        outside &= (outside & 3) == 3 ? ~2u : ~0u;
        outside &= (outside & 12) == 12 ? ~8u : ~0u;
    }
    return outside;
}
