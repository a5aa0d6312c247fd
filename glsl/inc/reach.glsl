// How far splats at a border reach (src/geometry/borders.rs), where edges are covered in part, and what each of them covers by itself.
//
// The border of a half plane, filtered, is A = Phi(d / sigma h), d the distance within it, and goes on for more than h beyond. A filtered splat ends h^2 / 2 l beyond its rim, l its
// unfiltered half axis: most of that would have no splat. So where there is no other beside it, a splat goes on to REACH h beyond its rim along both axes, where Phi is 0.05. Its plane,
// its weights and where these end are as they were; beyond, it has a color, and its own part of the pixel.
//
// That is Phi of d / sigma h, with d to first order (1 - r0^2) g h / 2, r0 the radius in the unfiltered ellipse and g = sqrt(l1 l2) / h: of a wide splat d / sigma h is (1 - r0^2) g. Of a narrow
// one, g < 1/2, both rims are within the filter: a line that is as wide covers 2 Phi(2 g) - 1 in its middle, which is Phi(g - 2 t - t^2) within 0.03, with t = 1/2 - g, down to g = 1/4. What is
// smaller across does not reach: sums of weights tell what it covers.

// Beyond the rim, in h.
const float REACH = 0.8;

// No half axis gets longer by more, over what the filter makes of it: (l + a h) / sqrt(l^2 + h^2) is sqrt(1 + a^2) at most.
const float MOST_REACH = 1.2807;

// In h; what reaches does not become shorter by it.
const float LEAST_REACHING = 0.25;

// How far one reaches that has this unfiltered half axis.
float reaching_axis(float l, float h)
{
    return l + FORMULA(FORMULA_REACH, REACH) * h;
}
