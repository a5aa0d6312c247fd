// Clip curves from a splat's plane to the image.
//
// The curve stays where it is when a filter widens the splat: its lines are mapped by the splat as the scene has it.
//
// COVERAGE_EDGES: a clipped edge is low-passed, as the surface is that it ends. What a pixel at d from a splat's center has of the surface comes from
// around P d, P = V (V + h^2)^-1: V is the covariance of a disk in the splat's plane, several times as large as the splat, since neighbors go on beyond it,
// and h^2 the filter's, in the same multiple. So a surface that is large beside h is seen around the pixel itself, with the covariance h^2 P, and one that is
// seen edge-on around the line that it is, however far from there the pixel's own (u, v) lie: unfiltered, its ridges would end in spikes.
// The curve is looked at in P d, and the part of it that is kept rises from 0 to 1 in a ramp with the slope of the
// normal distribution, sqrt(2 pi) sigma wide, sigma = 1/2 h sqrt(n P n) across the chord.
//
// In units of h, P = (V + det V) / (1 + trace V + det V), and det V is a square: nothing cancels. (u, v) of what is seen edge-on change a thousand times as
// fast across its image as along it, so that P has to be 0 there to the last digit.
//
// Limits: affine at the center, as the filter is. Two curves are looked at one by one.

layout(set = 0, binding = BIND_SPLATS_CLIPS, std430) readonly buffer Clips { vec4 clips[]; };

const float ROOT_TWO_PI = 2.5066283;

// The ramp's width has an inverse.
const float LEAST_RAMP2 = 1e-6;

// Farther from the middle of the image the center's place has no digits left to count pixels from.
const float FAR_CENTER_PX = 65536.0;

// (u, v, 1) by one factor, which is positive where the splat is seen: per pixel in x and in y, and in the middle of the image.
struct PlaneRows {
    vec3 u;
    vec3 v;
    vec3 one;
    vec2 center_px;
};

PlaneRows plane_rows(Splat splat)
{
    vec3 ray = ray_through(splat.p);
    vec3 n0 = precise_cross(splat.t, ray);
    vec3 n1 = precise_cross(ray, splat.s);
    vec3 n2 = precise_cross(splat.s, splat.t);
    float det = splat.area * normal_dot_ray(splat);
    float toward = det < 0.0 ? -1.0 : 1.0;
    float per_px = toward / frame.focal_px;
    PlaneRows rows;
    rows.center_px = (ORTHOGRAPHIC ? splat.p.xy : splat.p.xy / splat.p.z) * frame.focal_px;
    rows.u.xy = per_px * n0.xy;
    rows.v.xy = per_px * n1.xy;
    rows.one.xy = ORTHOGRAPHIC ? vec2(0.0) : per_px * n2.xy;
    bool about_center = ORTHOGRAPHIC || splat.p.z > 0.0 && max(abs(rows.center_px.x), abs(rows.center_px.y)) < FAR_CENTER_PX;
    if (about_center) {
        rows.u.z = -dot(rows.u.xy, rows.center_px);
        rows.v.z = -dot(rows.v.xy, rows.center_px);
        rows.one.z = abs(det) / (ORTHOGRAPHIC ? 1.0 : splat.p.z) - dot(rows.one.xy, rows.center_px);
    } else {
        rows.u.z = toward * n0.z;
        rows.v.z = toward * n1.z;
        rows.one.z = toward * n2.z;
    }
    return rows;
}

// The surface around a splat, in its radii.
const float SURFACE_RADII = 2.0;

// Where the low-pass filter lets a pixel see the surface: P, symmetric, as (xx, xy, yy).
vec3 seen_through(Splat splat, Mapping m)
{
    bool is_filtered = m.regular && (FILTER == FILTER_ADJUST || FILTER == FILTER_ADJUST_PAPER || FILTER == FILTER_EWA);
    if (!COVERAGE_EDGES || !is_filtered) {
        return vec3(1.0, 0.0, 1.0);
    }
    vec3 ray = ray_through(splat.p);
    vec2 c = ray.xy / ray.z;
    vec3 s = SURFACE_RADII * (dot(splat.s, splat.s) > dot(splat.t, splat.t) ? splat.s : splat.t);
    vec3 t = cross(splat.normal, s);
    vec2 a = (s.xy - c * s.z) / (ray.z * frame.filter_radius);
    vec2 b = (t.xy - c * t.z) / (ray.z * frame.filter_radius);
    vec3 image = vec3(a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
    float area = dot(s, s) / (ray.z * frame.filter_radius * ray.z * frame.filter_radius);
    float across = area * normal_dot_ray(splat) / (length(splat.n) * ray.z); // a x b, to the last digit where it is seen edge-on
    float det = across * across;
    return (image + vec3(det, 0.0, det)) / (1.0 + image.x + image.z + det);
}

vec2 times(vec3 symmetric, vec2 v)
{
    return vec2(symmetric.x * v.x + symmetric.y * v.y, symmetric.y * v.x + symmetric.z * v.y);
}

// A line of the splat's plane in the image.
vec3 line_in_image(PlaneRows rows, vec3 line)
{
    return FORMULA(FORMULA_CLIP_LINE, line.x) * rows.u + line.y * rows.v + line.z * rows.one;
}

// The line as it is seen through the filter.
vec3 seen_line(PlaneRows rows, vec3 through, vec3 line)
{
    vec2 seen = times(through, line.xy);
    return vec3(seen, line.z + dot(line.xy - seen, rows.center_px));
}

Curve curve_in_image(uint first, PlaneRows rows, vec3 through)
{
    vec3 c = line_in_image(rows, clips[first].xyz);
    vec3 a = line_in_image(rows, clips[first + 1].xyz);
    vec3 b = line_in_image(rows, clips[first + 2].xyz);
    float steepness = length(c.xy);
    vec2 n = steepness > 0.0 ? c.xy / steepness : vec2(0.0);
    float ramp_px = 1.0;
    if (COVERAGE_EDGES) {
        float half_ramp = 0.25 * ROOT_TWO_PI * frame.filter_radius * frame.focal_px;
        ramp_px = half_ramp * FORMULA(FORMULA_CLIP_RAMP, sqrt(max(dot(n, times(through, n)), LEAST_RAMP2)));
    }
    float unit = steepness > 0.0 ? 1.0 / (steepness * ramp_px) : 1.0;
    Curve curve = Curve(
        vec4(unit * seen_line(rows, through, c), 0.0),
        vec4(unit * seen_line(rows, through, a), clips[first + 1].w),
        vec4(unit * seen_line(rows, through, b), 0.0));
    curve.c.w = clips[first].w + float(CURVE_TOWARD * quarter_of(n));
    return curve;
}

// Both curves of a splat; the second one is nothing where there is one.
void clip_in_image(uint index, Mapping m, out Curve curves[2])
{
    Splat splat = load_splat(index);
    PlaneRows rows = plane_rows(splat);
    vec3 through = seen_through(splat, m);
    curves[0] = curve_in_image(CLIP_VECTORS * index, rows, through);
    curves[1] = curve_in_image(CLIP_VECTORS * index + 3, rows, through);
}
