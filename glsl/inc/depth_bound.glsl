// No fragment of a regular splat is nearer: a bound of w. The depth of a disk is at most its center's times
// 1 + depth radius / (p_z - depth radius); affine and stretched maps stay below.
float nearest_of_regular(Mapping m)
{
    float depth_radius = sqrt(m.s.z * m.s.z + m.t.z * m.t.z);
    return FORMULA_LESS(FORMULA_NEAREST_DEPTH, m.near / (m.p.z - depth_radius) * 1.00001);
}
