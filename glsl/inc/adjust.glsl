// The filter `adjust`: EWA filtering by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1, equations
// 8 and 9), made exact for ellipses.
//
// The paper adjusts each tangent vector by itself and accepts that the projected vectors are not orthogonal, so that
// most adjusted splats end up thinner than the filter. Here the parametrization is rotated first (principal.glsl). An
// axis shorter than h is then replaced by one of length h parallel to the screen; the direction of the short one is the
// long one's turned by 90 degrees, so that nothing is normalized that may vanish.
//
// Limits: affine approximation at the center, like every EWA filter; needs the center in front of the near plane.

// Answers with the share of its weight that the splat keeps if weights go by area.
float adjust_tangents(vec3 p, inout vec3 s, inout vec3 t)
{
    Principal axes = principal_axes(p, s, t);
    precise float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    if (abs(axes.minor) >= h) {
        return 1.0;
    }
    precise vec3 long_axis = s * axes.cosine + t * axes.sine;
    s = axes.major < h ? vec3(axes.direction * (h * p.z), 0.0) : long_axis;
    t = vec3(vec2(-axes.direction.y, axes.direction.x) * (h * p.z), 0.0);
    return FORMULA(FORMULA_SHARE, max(axes.major * abs(axes.minor) / (max(axes.major, h) * h), LEAST_SHARE));
}
