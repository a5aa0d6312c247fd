// From a splat to the projective map between its plane and the image.
//
// Guennebaud, Barthe, Paulin: "Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based
// Rendering", PBG 2006, section 3.1. M = [s t p] maps (u, v, 1) to the image plane; any multiple of its inverse maps
// back (equations 3-5). With N = near / det * adj(M) the third coordinate is w = near / z: the reversed, infinite
// depth itself (equation 6 with a = 0, b = near), linear on the screen.
//
// Visibility shifts the splat along its projectors by f = 1 + epsilon / max(p_z, epsilon): the image is the same,
// the depth w / f stays linear.
//
// Of an orthographic camera M is [s t (0, 0, 1)], and w another linear function of the image: inc/projection.glsl.
//
// Both passes must find bit-equal depths, or the nearest surface would hide itself: the build forbids contraction in all
// vertex and compute stages (src/shaders/build/exact.rs), and what they hand over is `invariant`.

struct Mapping {
    vec3 p;              // center and tangent vectors after the filter, view space
    vec3 s;
    vec3 t;
    vec3 n0;             // t x p, p x s, s x t: the rows of adj(M); ORTHOGRAPHIC: with (0, 0, 1) in place of p
    vec3 n1;
    vec3 n2;
    float near;          // depth of the near plane, in the splat's own unit, like all lengths here
    float unit;          // that unit in view units is 1 / unit
    float scale;         // near / det, ORTHOGRAPHIC 1 / det; det as exact as the splat itself, also where it is seen edge-on
    float shift;         // 1 / f; ORTHOGRAPHIC: what visibility takes off w
    vec3 normal;         // unit, view space, turned to the eye
    float share;         // of its weight that the filter leaves to the splat
    bool regular;        // see below
    bool faces_away;     // the normal was turned
    bool reaches;        // further than what the filter makes of it (reach.glsl)
    bool edge_on;        // the plane holds the eye: only a filter makes the splat visible
};

// A splat is *regular* if it lies wholly beyond the near plane and is not nearly as deep as it is far: its image is an
// ellipse whose formulas keep their digits (box.glsl), and it has an affine approximation.
// Depth radius over center depth up to which p_z^2 - s_z^2 - t_z^2 keeps them: at least 0.19 p_z^2.
const float REGULAR_DEPTH_RATIO = 0.9;

// A splat is seen edge-on, and has no area, where near / det is beyond this. |det| is the distance of the eye from the splat's plane times
// the area of s and t, rounded about once, in a unit of which the splat is about 1 away or large: where it is so small, either the
// plane holds the eye to 30 digits, or the splat is 1e-15 of its distance large.
const float LARGEST_SCALE = 1e37;

// Everything belongs to the nearest surface long before.
const float LARGEST_EPSILON = 1e30;

// Epsilon of a transparent splat grows as the filter lengthens the minor axis of its image, from l to L = sqrt(l^2 + h^2): a
// slanted surface would peel again and again. A neighbor that still reaches a pixel has its center up to L from it, where the
// surface's depth is up to r L / l farther or nearer, of which its own plane makes up r: its fragment is r (L / l - 1) off
// the surface, to either side. Two such are r (2 L / l - 2) apart, and what was the epsilon without a filter comes upon
// that: 2 L / l - 1 times r. L / l counts as 16 at most: beyond, the splat is seen edge-on.
//
// Where edges are covered in part, so does epsilon of opaque splats, for all of a surface that reaches a pixel has to be summed: its color
// is nearer to the truth, too, from 0.031 to 0.011 RMS on a scan of 134 thousand splats in 256 x 256 pixels. There it goes by how deep the
// splat itself is: one that faces the eye has neighbors about as deep as it. Near a silhouette the surface bends away within the filter's
// reach, and is EDGE_LENGTHENING / 2 times as deep as if it were flat; of a surface with sharp edges SHARP_LENGTHENING / 2 times. With more, what lies behind a surface that is
// seen at a slant, and does not end there, would show through it (benches/README.md, "Edges"). Not so in layers: the far side of a ball would be in one layer with the near one, far from its rim, and their
// normals cancel.
const float MOST_LENGTHENED = 16.0;

// Opaque splats without sharp edges count longer, for their epsilon grows less with it: with all of EDGE_LENGTHENING it is 256 radii at most, as that of sharp ones. A ball of
// half a million splats that is some pixels large needs as much.
const float MOST_SLOPED = 52.0;

layout(constant_id = SPEC_SHARP) const bool SHARP = false; // and edges are covered in part

// L / l - 1.
float lengthening(float minor, float most)
{
    float h = frame.filter_radius;
    float ratio = h < most * minor ? h / minor : most;
    return min(sqrt(1.0 + ratio * ratio), most) - 1.0;
}

// `ray`: through its center. `slant`: the splat's depth over its radius.
float thickened(vec3 ray, vec3 s, vec3 t, float slant)
{
    float most = COVERAGE_EDGES && !IN_LAYERS && !SHARP ? MOST_SLOPED : MOST_LENGTHENED;
    float lengthened = lengthening(abs(principal_axes(ray, s, t).minor), most);
    return 1.0 + lengthened * (COVERAGE_EDGES && !IN_LAYERS ? 1.0 + (SHARP ? SHARP_LENGTHENING : EDGE_LENGTHENING) * slant : 2.0);
}

// What comes upon epsilon of a transparent splat of a surface with sharp edges, whose epsilon is not its radius (src/prepare/near_surfaces/sharp.rs): (2 L / l - 2) r as above,
// where r is by how much the end of its minor axis is deeper than its center.
float leaning(vec3 ray, vec3 s, vec3 t)
{
    Principal axes = principal_axes(ray, s, t);
    return 2.0 * lengthening(abs(axes.minor), MOST_LENGTHENED) * abs(axes.cosine * t.z - axes.sine * s.z);
}

// The direction of the ray through a point, of any length.
vec3 ray_through(vec3 p)
{
    return ORTHOGRAPHIC ? vec3(0.0, 0.0, 1.0) : p;
}

// The depth in front of which nothing is drawn.
float nearest_drawn(Mapping m)
{
    return ORTHOGRAPHIC ? 0.0 : m.near;
}

// The depth w of the center; only in front of the eye.
float center_depth(Mapping m)
{
    float w = ORTHOGRAPHIC ? 1.0 - m.p.z / m.near : m.near / m.p.z;
    return w;
}

// False where nothing of the splat can be seen.
bool map_splat(uint index, out Mapping m)
{
    Splat splat = load_splat(index);
    if (SPARSE && splat.radius < 0.0) {
        return false;
    }
    vec3 p = splat.p;
    vec3 s = splat.s;
    vec3 t = splat.t;
    m.near = frame.near * splat.unit;
    m.unit = splat.unit;
    // Not by the determinant, which is nothing where a splat is 1e-19 of its distance large.
    float facing = normal_dot_ray(splat);
    bool faces_away = facing > 0.0;
    if (CULL_BACKFACES && faces_away) {
        return false;
    }
    vec3 normal = vec3(FORMULA(FORMULA_NORMAL, splat.normal.xy), splat.normal.z);
    m.normal = faces_away ? -normal : normal;
    m.faces_away = faces_away;

    // No filter makes a splat deeper: what is regular stays so.
    float depth_radius = sqrt(s.z * s.z + t.z * t.z);
    float nearest = nearest_drawn(m);
    if (p.z + depth_radius < nearest) {
        return false; // wholly behind the near plane
    }
    m.regular = p.z - depth_radius >= nearest && (ORTHOGRAPHIC || depth_radius <= REGULAR_DEPTH_RATIO * p.z);
    vec3 ray = ray_through(p);

    m.share = 1.0;
    m.reaches = false;
    bool is_widened = FILTER == FILTER_ADJUST && m.regular;
    Widened widened;
    if (is_widened) {
        // What is regular shall stay so.
        float reaching_depth = MOST_REACH * depth_radius;
        bool may_reach = REACHES && splat.at_border && p.z - reaching_depth >= nearest && (ORTHOGRAPHIC || reaching_depth <= REGULAR_DEPTH_RATIO * p.z);
        widened = adjust_tangents(ray, s, t, may_reach);
        m.reaches = widened.reaches;
        s = widened.s;
        t = widened.t;
        m.share = widened.share;
    }
    if (FILTER == FILTER_ADJUST_PAPER && m.regular) {
        m.share = adjust_tangents_as_the_paper(p, splat.normal, splat.radius, s, t);
    }
    vec3 n0;
    vec3 n1;
    vec3 n2;
    float det;
    if (is_widened) {
        n0 = widened.n0;
        n1 = widened.n1;
        n2 = widened.n2;
        det = widened.det;
    } else {
        n0 = precise_cross(t, ray);
        n1 = precise_cross(ray, s);
        n2 = precise_cross(s, t);
        bool changed = FILTER == FILTER_ADJUST_PAPER && (any(notEqual(s, splat.s)) || any(notEqual(t, splat.t)));
        det = changed ? precise_dot(n2, p) : splat.area * facing;
    }
    float scale = (ORTHOGRAPHIC ? 1.0 : m.near) / det;
    m.edge_on = !(abs(scale) <= LARGEST_SCALE);
    if (m.edge_on && !(FILTER == FILTER_MAX && p.z > nearest) && !(FILTER == FILTER_EWA && m.regular)) {
        return false;
    }
    m.p = p;
    m.s = s;
    m.t = t;
    m.n0 = n0;
    m.n1 = n1;
    m.n2 = n2;
    m.scale = scale;

    float thickness = splat.radius * splat.epsilon_share;
    if ((IN_LAYERS || COVERAGE_EDGES) && FILTER != FILTER_NONE && m.regular) {
        if (IN_LAYERS && SHARP) {
            thickness += FORMULA(FORMULA_LENGTHENED, leaning(ray_through(splat.p), splat.s, splat.t));
        } else {
            thickness *= FORMULA(FORMULA_LENGTHENED, thickened(ray_through(splat.p), splat.s, splat.t, depth_radius / splat.radius));
        }
    }
    // Depths of one surface, found from two splats of it, differ by some steps of f32: with a smaller shift than the least it would
    // hide itself in part. The reference has this rule, too (src/reference/splat.rs). A product of f32 may be 0 where neither factor
    // is: such a splat keeps the least shift.
    float epsilon = min(frame.epsilon_radii * thickness + frame.epsilon_length * splat.unit, LARGEST_EPSILON);
    float of_depth = ORTHOGRAPHIC ? m.near : max(p.z, epsilon);
    float part = epsilon > 0.0 ? FORMULA(FORMULA_EPSILON_SHIFT, epsilon / of_depth) : 0.0;
    float relative = frame.epsilon_radii + frame.epsilon_length > 0.0 ? max(part, LEAST_SHIFT) : 0.0;
    // Exactly 1 without epsilon: a division need not be.
    m.shift = ORTHOGRAPHIC ? relative : relative > 0.0 ? 1.0 / (1.0 + relative) : 1.0;
    return true;
}

// The projected center, image plane. Only for centers in front of the eye.
vec2 projected_center(Mapping m)
{
    return ORTHOGRAPHIC ? m.p.xy : m.p.xy / m.p.z;
}

// The projected center in pixels from the middle of the image: from a corner it would lose the digits that a thin splat in
// the middle needs. Only for centers in front of the eye.
vec2 projected_center_px(Mapping m)
{
    vec2 center = projected_center(m) * frame.focal_px;
    return center;
}
