// The filter `adjust`: EWA filtering by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1), made as exact as
// the convolution that it stands for, and for ellipses.
//
// The paper adjusts each tangent vector by itself and accepts that the projected vectors are not orthogonal; an axis that
// is shorter than h becomes h long and parallel to the screen. Two things are different here.
//
// Axes: the parametrization is rotated first (principal.glsl). Covariances of Gaussians add, so that an axis of length l
// should become sqrt(l^2 + h^2): the paper's max(l, h) is short of that by 29% at l = h, which doubles the error of a
// checkerboard there. Here it is max(l, h, sqrt(250/251 l^2 + 609/610 h^2)): 0.2% short of the sum at most, so that the
// exact outline, which in perspective is larger than the affine one, has no more fragments than EWA. Below h / 24 and from
// 16 h on it is the paper's. The two parts were found by trying: benches/README.md, "Filters over distance".
//
// Depth: an axis keeps its own, as it is at its ends. Parallel to the screen it would cut through its neighbors where it is
// stretched just a little. But one shorter than h / 16 loses it as it vanishes: which end is the nearer one is rounding then.
//
// The widened vectors are s = L1 p_z e + (z1 / p_z) p and t = L2 p_z f + (z2 / p_z) p, with e and f = e turned by 90 degrees
// in the image plane. The multiples of p cancel in the adjugate, so that they are left out from the start: in f32 they would
// hide a thin splat's own part.
//   t x p = L2 p_z (f x p)    p x s = -L1 p_z (e x p)    s x t = L1 L2 p_z^2 (0, 0, 1) + L1 z2 (e x p) - L2 z1 (f x p)
//   det = (s x t) . p = L1 L2 p_z^3, which is never 0: no widened splat is edge-on
//
// An orthographic camera has (0, 0, 1) in place of p.
//
// Limits: affine approximation at the center, like every EWA filter: for regular splats (mapping.glsl). A center that is
// nearer than the splat is deep has no image of which that would be true, and in f32 no digits.

#include "inc/reach.glsl"
#include "inc/widened.glsl"

const float OWN_DEPTH = 1.0 / 16.0; // in h: shorter axes lose their depth

struct Widened {
    vec3 s;
    vec3 t;
    vec3 n0; // t x p, p x s, s x t
    vec3 n1;
    vec3 n2;
    float det;
    float share; // of its weight that the splat keeps if weights go by area
    bool reaches; // further than what the filter makes of it
};

// (v, 0) x p
vec3 flat_cross(vec2 v, vec3 p)
{
    return vec3(v.y * p.z, -v.x * p.z, v.x * p.y - v.y * p.x);
}

// Along both axes, the plane as it is.
void lengthen(inout Widened widened, vec2 by)
{
    widened.s *= by.x;
    widened.t *= by.y;
    widened.n0 *= by.y;
    widened.n1 *= by.x;
    widened.n2 *= by.x * by.y;
    widened.det *= by.x * by.y;
}

// `may_reach`: it lies at a border, and is no deeper for a camera than what may reach.
Widened adjust_tangents(vec3 p, vec3 s, vec3 t, bool may_reach)
{
    Principal axes = principal_axes(p, s, t);
    float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    float minor = abs(axes.minor);
    float l1 = widened_axis(axes.major, h);
    float l2 = widened_axis(minor, h);
    vec2 e = axes.direction;
    vec2 f = vec2(-e.y, e.x);
    // Of the axes as they are, with the sign with which the parametrization runs along f.
    float z1 = (s.z * axes.cosine + t.z * axes.sine) * min(axes.major / (OWN_DEPTH * h), 1.0);
    float z2 = FORMULA(FORMULA_KEPT_DEPTH, t.z * axes.cosine - s.z * axes.sine) * min(minor / (OWN_DEPTH * h), 1.0);
    z2 = axes.minor < 0.0 ? -z2 : z2;
    vec3 e_p = flat_cross(e, p);
    vec3 f_p = flat_cross(f, p);
    vec2 c = p.xy / p.z;
    Widened widened;
    widened.s = vec3(e * (l1 * p.z) + c * z1, z1);
    widened.t = vec3(f * (l2 * p.z) + c * z2, z2);
    widened.n0 = l2 * p.z * f_p;
    widened.n1 = -l1 * p.z * e_p;
    widened.n2 = l1 * z2 * e_p - l2 * z1 * f_p;
    widened.n2.z += l1 * l2 * p.z * p.z;
    widened.det = l1 * l2 * p.z * p.z * p.z;
    widened.share = FORMULA(FORMULA_SHARE, max(axes.major * minor / (l1 * l2), LEAST_SHARE));
    widened.reaches = REACHES && may_reach && minor >= LEAST_REACHING * h;
    if (widened.reaches) {
        lengthen(widened, vec2(reaching_axis(axes.major, h) / l1, reaching_axis(minor, h) / l2));
    }
    return widened;
}
