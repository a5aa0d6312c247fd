// No fragment of a regular splat is nearer: a bound of w. The depth of a disk is at most its center's times
// 1 + depth radius / (p_z - depth radius). An affine map stays below: at its (u, v) it has w0 (1 - (u s_z + v t_z) / p_z); one
// that keeps the contour has the disk's own plane within the disk's own image; a stretched one has the depth of what it stretches.
//
// A fragment finds w = w0 + g . d with g = near / det n2.xy. Where a splat is thin as it is seen, g is large, and what it loses of n2
// (2^-22 of |s| |t_z| + |t| |s_z|, no more: each term of n2.xy has a depth in it) and of its sum (some 2^-22 of |g| |d|) is no small
// part of w0: that is added, with room. d reaches from the center to the image's far side at most, or from its middle, less than
// 1 + |c| + |corner| in any case.
float nearest_of_regular(Mapping m)
{
    float depth_radius = sqrt(m.s.z * m.s.z + m.t.z * m.t.z);
    float terms = length(m.n2) + length(m.s) * abs(m.t.z) + length(m.t) * abs(m.s.z);
    vec2 most_px = max(abs(frame.middle_px), abs(SIZE_PX - frame.middle_px));
    float most_d = (ORTHOGRAPHIC ? 0.0 : 1.0) + length(projected_center(m)) + length(most_px / frame.focal_px);
    float lost = 1e-6 * abs(m.scale) * terms * most_d;
    if (ORTHOGRAPHIC) {
        return FORMULA_LESS(FORMULA_NEAREST_DEPTH, 1.0 - (m.p.z - depth_radius) / m.near + 1e-6 + lost / m.near);
    }
    return FORMULA_LESS(FORMULA_NEAREST_DEPTH, m.near / (m.p.z - depth_radius) * 1.00001 + lost);
}
