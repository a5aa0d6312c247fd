// The box of a splat's image: the smallest axis-parallel rectangle around its projection, in image-plane units
// (Guennebaud et al. 2006, section 3.2, ask for "a conservative 2D axis aligned bounding box" and leave the how open).
//
// Extremes of x are tangent lines (1, 0, -x) of the dual conic M diag(1, 1, -1) M^T, M = [s t p]:
// d x^2 - 2 (s_x s_z + t_x t_z - p_x p_z) x + (s_x^2 + t_x^2 - p_x^2) = 0, d = s_z^2 + t_z^2 - p_z^2. The textbook
// half width cancels (62% wrong in f32 at radius / distance 1e-3); with Lagrange's identity the discriminant is a
// sum of components of the adjugate's rows instead, which stays below 4e-6.
//
// That holds for a regular splat (mapping.glsl): where d does not cancel. Any other is a convex region cut by z >= near.
// Its extremes lie on the rim, at the angles where x(theta) is stationary: (t x p)_y cos + (p x s)_y sin = (s x t)_y (for
// y: the x components), or at the ends of the chord z = near.

struct Box {
    vec2 lo;
    vec2 hi;
};

Box regular_box(Mapping m)
{
    float d = m.s.z * m.s.z + m.t.z * m.t.z - m.p.z * m.p.z;
    vec2 center = FORMULA(FORMULA_BOX_CENTER, (m.s.xy * m.s.z + m.t.xy * m.t.z - m.p.xy * m.p.z) / d);
    vec2 squared = m.n0.yx * m.n0.yx + m.n1.yx * m.n1.yx - m.n2.yx * m.n2.yx;
    vec2 half_size = FORMULA_LESS(FORMULA_BOX_HALF_SIZE, sqrt(max(squared, 0.0)) / abs(d));
    return Box(center - half_size, center + half_size);
}

const float FAR_AWAY = 1e30;
// Rounding of a point's coordinates on the rim, relative to |p| + |s| + |t|: three products and sums of f32.
const float RIM_ROUNDING = 4e-7;

void include_point(inout Box box, vec3 q, float size)
{
    float rounding = RIM_ROUNDING * size / q.z;
    vec2 x = FORMULA_LESS(FORMULA_NEAR_BOX, q.xy / q.z);
    vec2 slack = rounding * (1.0 + abs(x));
    box.lo = min(box.lo, x - slack);
    box.hi = max(box.hi, x + slack);
}

// Both rim points with a cos + b sin = c, as far as they lie in front of the near plane.
void include_rim(inout Box box, Mapping m, float a, float b, float c, float size)
{
    float length_ab = sqrt(a * a + b * b);
    if (!(length_ab > 0.0) || abs(c) > 1.00001 * length_ab) {
        return; // no tangent of this direction: the image has no extreme here
    }
    vec2 e = vec2(a, b) / length_ab;
    float k = clamp(c / length_ab, -1.0, 1.0);
    float root = sqrt(1.0 - k * k);
    for (int sign = -1; sign <= 1; sign += 2) {
        vec2 angle = e * k + float(sign) * root * vec2(-e.y, e.x);
        vec3 q = m.p + m.s * angle.x + m.t * angle.y;
        if (q.z >= m.near) {
            include_point(box, q, size);
        }
    }
}

// For splats that are not regular and reach beyond the near plane.
Box near_box(Mapping m)
{
    Box box = Box(vec2(FAR_AWAY), vec2(-FAR_AWAY));
    float size = length(m.p) + length(m.s) + length(m.t);
    include_rim(box, m, m.n0.y, m.n1.y, m.n2.y, size);
    include_rim(box, m, m.n0.x, m.n1.x, m.n2.x, size);
    float depth_radius = sqrt(m.s.z * m.s.z + m.t.z * m.t.z);
    float chord = (m.near - m.p.z) / depth_radius;
    if (depth_radius > 0.0 && abs(chord) <= 1.0) {
        vec2 e = vec2(m.s.z, m.t.z) / depth_radius;
        float root = sqrt(max(1.0 - chord * chord, 0.0));
        for (int sign = -1; sign <= 1; sign += 2) {
            vec2 angle = e * chord + float(sign) * root * vec2(-e.y, e.x);
            include_point(box, vec3((m.p + m.s * angle.x + m.t * angle.y).xy, m.near), size);
        }
    }
    return box;
}

// Of an affine image with these half axes about a center: extremes of u a + v b.
Box ellipse_box(vec2 center, vec2 a, vec2 b)
{
    vec2 half_size = FORMULA_LESS(FORMULA_BOX_HALF_SIZE, sqrt(a * a + b * b));
    return Box(center - half_size, center + half_size);
}

// The box within the viewport in pixels, and the pixels whose centers it holds.
struct PixelBox {
    vec2 lo;
    vec2 hi;
    ivec2 first;
    ivec2 last; // inclusive
};

// The box is enlarged by more than its own rounding (4e-6 of a coordinate; twice as much of the largest, with room for inexact division). Pixels are counted by their centers, so points and
// quads end on pixel borders, half a pixel from the nearest center: no subpixel rounding of theirs can lose one.
const float BOX_MARGIN_PX = 1.0 / 256.0;

// False where the box holds no pixel's center.
bool pixel_box(Box box, out PixelBox px)
{
    vec2 size_px = SIZE_PX;
    vec2 most_px = max(abs(frame.middle_px), abs(size_px - frame.middle_px)); // of the image, from where places are counted
    float margin_px = max(BOX_MARGIN_PX, 8e-6 * max(most_px.x, most_px.y));
    px.lo = clamp(box.lo * frame.focal_px + (frame.middle_px - margin_px), vec2(0.0), size_px);
    px.hi = clamp(box.hi * frame.focal_px + (frame.middle_px + margin_px), vec2(0.0), size_px);
    px.first = ivec2(ceil(px.lo - 0.5));
    px.last = ivec2(floor(px.hi - 0.5));
    return all(lessThanEqual(px.first, px.last));
}

// The side of the square of pixels around the box.
float square_side_px(PixelBox px)
{
    ivec2 size = px.last - px.first + 1;
    return float(max(size.x, size.y));
}
