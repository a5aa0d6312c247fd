// The principal axes of a disk's image, in the affine approximation of the projection at its center.
//
// With a = J s, b = J t (J the Jacobian of the projection at p) the image is {u a + v b : u^2 + v^2 <= 1}. Rotating the
// parametrization by theta, tan 2 theta = 2 a.b / (a.a - b.b), leaves the disk the same and makes the axes orthogonal, the
// longer one along a. The shorter is the determinant over the longer: no cancellation, as aa + bb - spread would have.

// `ray`: through the center, p itself, or of an orthographic camera (0, 0, 1), of which a and b are what x and y of s and t are.

struct Principal {
    vec2 direction; // unit, of the longer axis; the shorter's is this one turned by 90 degrees
    float major;    // half lengths, image plane; the minor one has the sign of the parametrization's orientation
    float minor;
    float cosine;   // of theta
    float sine;
};

// Projections below are none. Its inverse is finite.
const float TINY = 1e-37;

Principal principal_axes(vec3 ray, vec3 s, vec3 t)
{
    vec2 c = ray.xy / ray.z;
    vec2 a = (s.xy - c * s.z) / ray.z;
    vec2 b = (t.xy - c * t.z) / ray.z;
    // In units of the largest component: fourth powers of lengths neither under- nor overflow.
    float unit = max(max(max(abs(a.x), abs(a.y)), max(abs(b.x), abs(b.y))), TINY);
    a /= unit;
    b /= unit;
    float aa = dot(a, a);
    float bb = dot(b, b);
    float ab = dot(a, b);
    float difference = aa - bb;
    float spread = sqrt(difference * difference + 4.0 * ab * ab);
    // cos and sin of theta from cos 2 theta and sin 2 theta, the larger one by a square root, the other by division.
    float cosine = 1.0;
    float sine = 0.0;
    if (spread > 0.0) {
        float half_sin = 0.5 * FORMULA(FORMULA_FILTER_ROTATION, 2.0 * ab / spread);
        float larger = sqrt(0.5 + 0.5 * abs(difference) / spread);
        if (difference >= 0.0) {
            cosine = larger;
            sine = half_sin / larger;
        } else {
            sine = half_sin < 0.0 ? -larger : larger;
            cosine = abs(half_sin) / larger;
        }
    }
    vec2 axis = a * cosine + b * sine;
    float major = sqrt(dot(axis, axis));
    float area = a.x * b.y - a.y * b.x;
    Principal principal;
    principal.major = major * unit;
    principal.minor = major > 0.0 ? area / major * unit : 0.0;
    principal.direction = major > 0.0 ? axis / major : vec2(1.0, 0.0);
    principal.cosine = cosine;
    principal.sine = sine;
    return principal;
}
