// The box of a splat's image: the smallest axis-parallel rectangle around its projection, in image-plane units.
//
// Extremes of x are tangent lines (1, 0, -x) of the dual conic M diag(1, 1, -1) M^T, M = [s t p]:
// d x^2 - 2 (s_x s_z + t_x t_z - p_x p_z) x + (s_x^2 + t_x^2 - p_x^2) = 0, d = s_z^2 + t_z^2 - p_z^2. The textbook
// half width cancels (62% wrong in f32 at radius / distance 1e-3); with Lagrange's identity the discriminant is a
// sum of components of the adjugate's rows instead, which stays below 4e-6. DESIGN: Guennebaud et al. 2006, 3.2, ask
// for "a conservative 2D box" and leave the how open.
//
// A disk that reaches the near plane (or is nearly as deep as it is far, where d cancels) is a convex region cut by
// z >= near. Its extremes lie on the rim, at the angles where x(theta) is stationary:
// (t x p)_y cos + (p x s)_y sin = (s x t)_y (for y: the x components), or at the ends of the chord z = near.

struct Box {
    vec2 lo;
    vec2 hi;
};

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
void include_rim(inout Box box, vec3 p, vec3 s, vec3 t, float a, float b, float c, float size)
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
        vec3 q = p + s * angle.x + t * angle.y;
        if (q.z >= frame.near) {
            include_point(box, q, size);
        }
    }
}

// n0 = t x p, n1 = p x s, n2 = s x t. Call only for disks that reach beyond the near plane.
Box image_box(vec3 p, vec3 s, vec3 t, vec3 n0, vec3 n1, vec3 n2)
{
    Box box;
    float depth_radius = sqrt(s.z * s.z + t.z * t.z);
    if (p.z - depth_radius >= frame.near && depth_radius <= 0.9 * p.z) {
        float d = s.z * s.z + t.z * t.z - p.z * p.z;
        vec2 center = FORMULA(FORMULA_BOX_CENTER, (s.xy * s.z + t.xy * t.z - p.xy * p.z) / d);
        vec2 squared = n0.yx * n0.yx + n1.yx * n1.yx - n2.yx * n2.yx;
        vec2 half_size = FORMULA_LESS(FORMULA_BOX_HALF_SIZE, sqrt(max(squared, 0.0)) / abs(d));
        box.lo = center - half_size;
        box.hi = center + half_size;
    } else {
        box.lo = vec2(FAR_AWAY);
        box.hi = vec2(-FAR_AWAY);
        float size = length(p) + length(s) + length(t);
        include_rim(box, p, s, t, n0.y, n1.y, n2.y, size);
        include_rim(box, p, s, t, n0.x, n1.x, n2.x, size);
        float chord = (frame.near - p.z) / depth_radius;
        if (depth_radius > 0.0 && abs(chord) <= 1.0) {
            vec2 e = vec2(s.z, t.z) / depth_radius;
            float root = sqrt(max(1.0 - chord * chord, 0.0));
            for (int sign = -1; sign <= 1; sign += 2) {
                vec2 angle = e * chord + float(sign) * root * vec2(-e.y, e.x);
                include_point(box, vec3((p + s * angle.x + t * angle.y).xy, frame.near), size);
            }
        }
    }
    return box;
}
