// How surfaces that end in a pixel lie to each other. Beside each other, they cover different parts of it; behind each other, the same one: as both sides of a plate or of a ball, whose
// outlines are one. Their sums of weights fall toward the same side then (tile/covering.glsl).

// How surely what falls like one of these ends toward the same side as what falls like the other: by how parallel both are, since the sums of sheets that are seen nearly edge-on
// fall more steeply than that of one. What falls by less than a half as much does so by chance.
float part_behind(vec2 a, vec2 b)
{
    float a2 = dot(a, a);
    float b2 = dot(b, b);
    float parallel = max(dot(a, b), 0.0);
    return parallel * min(inversesqrt(max(a2 * b2, 1e-24)), SURE_BEHIND / max(max(a2, b2), 1e-12));
}
