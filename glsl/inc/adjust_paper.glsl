// The filter `adjust-paper`: tangent adjustment as Guennebaud, Barthe, Paulin 2006 have it, section 4.1: the basis
// s = p x n, t = n x s of a disk (equation 10), each tangent vector by itself (equations 8 and 9).
//
// Limits: disks only. The projected basis vectors are 60 to 90 degrees apart, so that most adjusted splats end up thinner
// than h, down to 0.71 h. For regular splats (mapping.glsl), as `adjust`.

float projected_area(vec3 p, vec3 s, vec3 t)
{
    vec2 c = p.xy / p.z;
    vec2 a = (s.xy - c * s.z) / p.z;
    vec2 b = (t.xy - c * t.z) / p.z;
    return abs(a.x * b.y - a.y * b.x);
}

// Equation 9: parallel to the screen, h long; `fallback` where equation 8 gives no direction.
void lengthen(vec3 p, float h, vec2 fallback, inout vec3 v)
{
    vec2 projected = (v.xy * p.z - v.z * p.xy) / (p.z * p.z - v.z * v.z); // equation 8
    float half_length = sqrt(dot(projected, projected));
    if (half_length < h) {
        vec2 direction = half_length > 0.0 ? projected / half_length : fallback;
        v = vec3(direction * (h * p.z), 0.0);
    }
}

// Answers with the share of its weight that the splat keeps if weights go by area.
float adjust_tangents_as_the_paper(vec3 p, vec3 normal, float radius, inout vec3 s, inout vec3 t)
{
    vec3 across = precise_cross(p, normal);
    if (dot(across, across) > 0.0) { // else any basis will do
        s = radius * safe_normalize(across);
        t = precise_cross(normal, s);
    }
    float before = projected_area(p, s, t);
    float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    vec2 s_across = (s.xy - p.xy / p.z * s.z);
    lengthen(p, h, vec2(1.0, 0.0), s);
    s_across = dot(s_across, s_across) > 0.0 ? normalize(s_across) : vec2(1.0, 0.0);
    lengthen(p, h, vec2(-s_across.y, s_across.x), t);
    float after = projected_area(p, s, t);
    return FORMULA(FORMULA_SHARE, clamp(before / after, LEAST_SHARE, 1.0));
}
