// The filter `adjust`: EWA filtering by tangent adjustment (Guennebaud, Barthe, Paulin 2006, section 4.1, equations
// 8 and 9), made exact for ellipses.
//
// The paper adjusts each tangent vector by itself and accepts that the projected vectors are not orthogonal, so that
// most adjusted splats end up thinner than the filter. Here the parametrization is rotated first: with a = J s,
// b = J t (J the Jacobian of the projection at the center) and tan 2 theta = 2 a.b / (a.a - b.b) the disk is the
// same, and its projected axes are the orthogonal principal ones, the longer along a. An axis shorter than h is then
// replaced by one of length h parallel to the screen; the direction of the short one is the long one's turned by
// 90 degrees, so that nothing is normalized that may vanish.
//
// Limits: affine approximation at the center, like every EWA filter; needs the center in front of the near plane.

void adjust_tangents(vec3 p, inout vec3 s, inout vec3 t)
{
    precise vec2 c = p.xy / p.z;
    precise vec2 a = (s.xy - c * s.z) / p.z;
    precise vec2 b = (t.xy - c * t.z) / p.z;
    precise float aa = dot(a, a);
    precise float bb = dot(b, b);
    precise float ab = dot(a, b);
    precise float difference = aa - bb;
    precise float spread = sqrt(difference * difference + 4.0 * ab * ab);
    precise float major2 = 0.5 * (aa + bb + spread);
    // The product of the axes is the determinant: no cancellation, as aa + bb - spread would have.
    precise float area = a.x * b.y - a.y * b.x;
    precise float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    if (area * area >= h * h * major2 && major2 > 0.0) {
        return; // the minor axis, area / sqrt(major2), is wide enough
    }

    // cos and sin of theta from cos 2 theta and sin 2 theta, the larger one by a square root, the other by division.
    precise float cosine = 1.0;
    precise float sine = 0.0;
    if (spread > 0.0) {
        precise float half_sin = 0.5 * FORMULA(FORMULA_FILTER_ROTATION, 2.0 * ab / spread);
        precise float larger = sqrt(0.5 + 0.5 * abs(difference) / spread);
        if (difference >= 0.0) {
            cosine = larger;
            sine = half_sin / larger;
        } else {
            sine = half_sin < 0.0 ? -larger : larger;
            cosine = abs(half_sin) / larger;
        }
    }
    precise vec3 long_axis = s * cosine + t * sine;
    precise vec2 a1 = a * cosine + b * sine;
    precise float length_a1 = sqrt(dot(a1, a1));
    precise vec2 direction = length_a1 > 0.0 ? a1 / length_a1 : vec2(1.0, 0.0);
    s = length_a1 < h ? vec3(direction * (h * p.z), 0.0) : long_axis;
    t = vec3(vec2(-direction.y, direction.x) * (h * p.z), 0.0);
}
