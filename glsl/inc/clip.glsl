// What clip curves leave of a splat (Ivo, Guthe et al., "Adaptive clipping of splats to models with sharp features", 2012, section 3),
// in the image. The test is not theirs, which solves for the curve's crossings with a line (equations 6 to 8).
//
// A rational Bezier curve of degree 2 with the control points P1, P2, P3 and the weights 1, w, 1 lies where b2^2 = 4 w^2 b1 b3, with b the
// areas of the triangles that a place makes with the sides opposite to the control points; nearer to the chord b2^2 is less. So with
// C = -b2, positive to the left of the way from P1 to P3, turn the side to which P2 lies (1 to the right), A = turn b1 and B = turn b3, what
// is kept is where
//    f = C + turn 2 w sqrt(max(A, 0) max(B, 0)) >= 0.
// Outside of the control triangle, left of it or right of it, the root is 0 or f's sign is that of C all the same.
//
// By how much it is kept (COVERAGE_EDGES) f does not tell: where P2 is near the chord, it is twice as steep on one side of the curve as on the other.
// Along a line through P2 the ratio of b1 and b3 is one number, and so is s = 2 w sqrt(b1 b3) / (b1 + b3); with b1 + b2 + b3 = T the curve is
// where b2 = T s / (1 + s). So C + T s / (1 + s) is as steep as C, everywhere.
//
// A, B and C are linear in (u, v). (uw, vw, w) are so in the image, by one factor: w, which is positive where a splat is seen. So each is a
// line of the image, and f is what it was, w times. It is counted in such units that C grows by 1 in a pixel (COVERAGE_EDGES: in half the
// ramp of inc/clip_image.glsl) across its line.

layout(constant_id = SPEC_CLIPS) const bool CLIPS = false;

// Of a curve C, A and B: what a pixel to the right and one down add, and the value in the middle of the image. C's w is the sum of CURVE_*,
// A's is 2 w.
struct Curve {
    vec4 c;
    vec4 a;
    vec4 b;
};

// The quarter of the circle, turned a little so that few edges lie on a border, in which the kept side is.
uint quarter_of(vec2 n)
{
    vec2 turned = vec2(0.9238795 * n.x + 0.3826834 * n.y, 0.9238795 * n.y - 0.3826834 * n.x);
    return turned.y >= 0.0 ? (turned.x >= 0.0 ? 0 : 1) : (turned.x < 0.0 ? 2 : 3);
}

bool is_told(vec4 c, uint what)
{
    return (uint(c.w) & what) != 0;
}

const float BY_PLANE = 4.0; // added to the direction's number where a plane decides what is left, not a curve

// What curves and planes leave of a splat in a pixel: the part, from 0 to 1, and COVERAGE_EDGES: the number of the direction in which what decides it keeps, of a plane and BY_PLANE.
struct Kept {
    float part;
    float toward;
};

const Kept WHOLE = Kept(1.0, 0.0);

float at(vec4 line, vec2 px)
{
    return line.x * px.x + line.z + line.y * px.y; // the first sum is one for a column
}

float turn_of(Curve curve)
{
    return is_told(curve.c, CURVE_LEFT) ? -1.0 : 1.0;
}

// 2 w sqrt(A B), where it is not 0.
float root_of(Curve curve, vec2 ab)
{
    return curve.a.w * FORMULA(FORMULA_CLIP_CURVE, sqrt(max(ab.x, 0.0) * max(ab.y, 0.0)));
}

// Whether the curve leaves a place, if it is one. What is no number is kept.
bool keeps(Curve curve, vec2 px)
{
    float f = at(curve.c, px) + turn_of(curve) * root_of(curve, vec2(at(curve.a, px), at(curve.b, px)));
    return !is_told(curve.c, CURVE_IS) || !(f < 0.0);
}

// By how much it leaves a place, as steep as C.
float kept_side(Curve curve, vec2 px)
{
    float c = at(curve.c, px);
    vec2 ab = vec2(at(curve.a, px), at(curve.b, px));
    float root = root_of(curve, ab);
    float sum = ab.x + ab.y;
    // s / (1 + s)
    float bulge = root > 0.0 ? root / (sum + root) : 0.0;
    return c + (turn_of(curve) * sum - c) * bulge;
}

// What has the sign of that, without a root or a division; less where roundings may decide, so that what is above 0 here is left there.
float kept_sign(Curve curve, vec2 px)
{
    float c = at(curve.c, px);
    float w2 = FORMULA(FORMULA_CLIP_CURVE, curve.a.w);
    float root2 = (w2 * max(at(curve.a, px), 0.0)) * (w2 * max(at(curve.b, px), 0.0)); // a product that is finite where w is 1e19 and more
    return c * abs(c) + turn_of(curve) * root2 - 1e-5 * (c * c + root2);
}
