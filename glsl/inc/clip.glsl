// What clip curves leave of a splat (Ivo, Guthe et al., "Adaptive clipping of splats to models with sharp features", 2012, section 3),
// in the image. The test is not theirs, which solves for the curve's crossings with a line (equations 6 to 8).
//
// A rational Bezier curve of degree 2 with the control points P1, P2, P3 and the weights 1, w, 1 lies where b2^2 = 4 w^2 b1 b3, with b the
// areas of the triangles that a place makes with the sides opposite to the control points; nearer to the chord b2^2 is less. So with
// C = -b2, positive to the left of the way from P1 to P3, turn the side to which P2 lies (1 to the right), A = turn 2 w b1 and
// B = turn 2 w b3, what is kept is where
//    f = C + turn sqrt(max(A, 0) max(B, 0)) >= 0.
// Outside of the control triangle, left of it or right of it, the root is 0 or f's sign is that of C all the same.
//
// A, B and C are linear in (u, v). (uw, vw, w) are so in the image, by one factor: w, which is positive where a splat is seen. So each is a
// line of the image, and f is what it was, w times. It is counted in such units that C grows by 1 in a pixel (COVERAGE_EDGES: in half the
// ramp of inc/clip_image.glsl) across its line.
//
layout(constant_id = SPEC_CLIPS) const bool CLIPS = false;

// Of a curve C, A and B: what a pixel to the right and one down add, and the value in the middle of the image. C's w is the sum of CURVE_*;
// COVERAGE_EDGES: those of A and B are what they gain where C gains 1 across its line.
struct Curve {
    vec4 c;
    vec4 a;
    vec4 b;
};

bool is_told(vec4 c, uint what)
{
    return (uint(c.w) & what) != 0;
}

float at(vec4 line, vec2 px)
{
    return line.x * px.x + line.z + line.y * px.y; // the first sum is one for a column
}

// f, `ahead` of a place across C's line.
float kept_side(Curve curve, vec2 px, float ahead)
{
    float a = max(at(curve.a, px) + ahead * curve.a.w, 0.0);
    float b = max(at(curve.b, px) + ahead * curve.b.w, 0.0);
    float turn = is_told(curve.c, CURVE_LEFT) ? -1.0 : 1.0;
    return at(curve.c, px) + ahead + turn * FORMULA(FORMULA_CLIP_CURVE, sqrt(a * b));
}

// Whether the curve leaves a place, if it is one. What is no number is kept.
bool keeps(Curve curve, vec2 px)
{
    return !is_told(curve.c, CURVE_IS) || !(kept_side(curve, px, 0.0) < 0.0);
}
