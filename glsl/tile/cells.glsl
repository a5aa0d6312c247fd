// Cells of a splat's rect of tiles (tile/rect.glsl), and whether it covers no pixel of one.
//
// f = (uw)^2 + (vw)^2 - R^2 w^2 is convex and not above 0 where a pixel is covered (tile/corners.glsl): nowhere below its tangent plane at a place, whichever it is, and
// the cell's nearest place to where f is least says most. Pixels find f by roundings of some 2^-22 of its terms; what is left out has f above 2^-13 of what they are at most.

// A box of pixels, from the middle of the image.
struct Cell {
    vec2 middle_px;
    vec2 reach_px;
};

struct Ellipse {
    vec3 along_x; // (uw, vw, w) over w at x0, per pixel
    vec3 along_y;
    float limit;  // R^2
    vec2 x0_px;
    vec2 least_px; // where f is least, from x0
    vec3 growth;   // f's factors of x^2, xy and y^2 from there
};

Ellipse ellipse_of(ImageMap map)
{
    Ellipse ellipse;
    float w0 = map.at_x0.z;
    ellipse.along_x = map.affine ? vec3(map.along_x.xy, 0.0) : map.along_x / w0;
    ellipse.along_y = map.affine ? vec3(map.along_y.xy, 0.0) : map.along_y / w0;
    ellipse.limit = FORMULA(FORMULA_COVERAGE, COVERAGE_R2);
    ellipse.x0_px = map.x0_px;
    vec3 factors = vec3(1.0, 1.0, -ellipse.limit);
    float xx = dot(factors * ellipse.along_x, ellipse.along_x);
    float xy = dot(factors * ellipse.along_x, ellipse.along_y);
    float yy = dot(factors * ellipse.along_y, ellipse.along_y);
    vec2 slope = ellipse.limit * vec2(ellipse.along_x.z, ellipse.along_y.z);
    float det = xx * yy - xy * xy;
    ellipse.least_px = det > 0.0 ? vec2(yy * slope.x - xy * slope.y, xx * slope.y - xy * slope.x) / det : vec2(0.0);
    ellipse.growth = vec3(xx, 2.0 * xy, yy);
    return ellipse;
}

float grown(Ellipse ellipse, vec2 px)
{
    return dot(ellipse.growth, vec3(px.x * px.x, px.x * px.y, px.y * px.y));
}

bool is_outside(Ellipse ellipse, Cell cell)
{
    vec2 middle = cell.middle_px - ellipse.x0_px;
    vec2 first = middle - cell.reach_px - ellipse.least_px;
    vec2 last = middle + cell.reach_px - ellipse.least_px;
    // The least of f in the cell is on the side that is nearest along x, or on that along y.
    vec2 nearest = clamp(vec2(0.0), first, last);
    vec2 along_x = vec2(nearest.x, clamp(-0.5 * ellipse.growth.y / ellipse.growth.z * nearest.x, first.y, last.y));
    vec2 along_y = vec2(clamp(-0.5 * ellipse.growth.y / ellipse.growth.x * nearest.y, first.x, last.x), nearest.y);
    vec2 place = (grown(ellipse, along_x) < grown(ellipse, along_y) ? along_x : along_y) + ellipse.least_px;
    vec3 uvw = ellipse.along_x * place.x + ellipse.along_y * place.y + vec3(0.0, 0.0, 1.0);
    vec3 half_slope = vec3(uvw.xy, -ellipse.limit * uvw.z);
    vec2 slope = 2.0 * vec2(dot(half_slope, ellipse.along_x), dot(half_slope, ellipse.along_y));
    vec2 from_place = middle - place;
    vec2 falls = slope * from_place - abs(slope) * cell.reach_px;
    vec2 most_px = abs(middle) + cell.reach_px;
    vec3 most = abs(ellipse.along_x) * most_px.x + abs(ellipse.along_y) * most_px.y + vec3(0.0, 0.0, 1.0);
    float margin = 1.2207031e-4 * (dot(most.xy, most.xy) + ellipse.limit * most.z * most.z);
    return dot(half_slope, uvw) + falls.x + falls.y > margin;
}
