// The filter `adjust`: EWA filtering by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1), made as exact as
// the convolution that it stands for, and for ellipses.
//
// The paper adjusts each tangent vector by itself and accepts that the projected vectors are not orthogonal; an axis that
// is shorter than h becomes h long and parallel to the screen. Two things are different here.
//
// Axes: the parametrization is rotated first (principal.glsl). Covariances of Gaussians add, so that an axis of length l
// should become sqrt(l^2 + h^2): the paper's max(l, h) is short of that by 29% at l = h, which doubles the error of a
// checkerboard there. Here it is max(l, sqrt(h^2 + 15/16 l^2)): within 3.1% of the sum everywhere, and splats wider than
// 4 h, which would gain nothing that can be seen, are left alone.
//
// Depth: an axis keeps its own, so that the splat's depths stay those of its surface. Parallel to the screen it would cut
// through its neighbors where it is stretched just a little. But one shorter than h / 16 loses it as it vanishes: which end
// is the nearer one is then rounding.
//
// Limits: affine approximation at the center, like every EWA filter; needs the center in front of the near plane.

const float UNTOUCHED = 4.0;                                     // in h
const float OWN_PART = 1.0 - 1.0 / (UNTOUCHED * UNTOUCHED);      // so that both forms meet at UNTOUCHED h
const float OWN_DEPTH = 1.0 / 16.0;                              // in h

float widened(float half_length, float h)
{
    return sqrt(h * h + FORMULA(FORMULA_WIDENED, OWN_PART * half_length * half_length));
}

// The vector at p that has this motion in the image plane and this depth.
vec3 with_projection(vec3 p, vec2 projected, float z)
{
    vec3 v = vec3(projected * p.z + p.xy / p.z * z, z);
    return v;
}

// Answers with the share of its weight that the splat keeps if weights go by area.
float adjust_tangents(vec3 p, inout vec3 s, inout vec3 t)
{
    Principal axes = principal_axes(p, s, t);
    float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    float major = axes.major;
    float minor = abs(axes.minor);
    if (minor >= UNTOUCHED * h) {
        return 1.0;
    }
    vec3 long_axis = s * axes.cosine + t * axes.sine;
    float short_z = t.z * axes.cosine - s.z * axes.sine;
    float drawn_major = major;
    s = long_axis;
    if (major < UNTOUCHED * h) {
        drawn_major = widened(major, h);
        float z = long_axis.z * min(major / (OWN_DEPTH * h), 1.0);
        s = with_projection(p, axes.direction * drawn_major, z);
    }
    float drawn_minor = widened(minor, h);
    vec2 turned = vec2(-axes.direction.y, axes.direction.x);
    float signed_minor = axes.minor < 0.0 ? -drawn_minor : drawn_minor;
    float z = FORMULA(FORMULA_KEPT_DEPTH, short_z) * min(minor / (OWN_DEPTH * h), 1.0);
    t = with_projection(p, turned * signed_minor, z);
    return FORMULA(FORMULA_SHARE, max(major * minor / (drawn_major * drawn_minor), LEAST_SHARE));
}
