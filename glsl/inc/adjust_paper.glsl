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

// The projection of a vector's direction, of any length.
vec2 seen_along(vec3 p, vec3 direction)
{
    return direction.xy * p.z - direction.z * p.xy;
}

// The tangent vector along `direction`, a unit vector. Equation 9: where it is too short, parallel to the screen, h long; along
// `fallback` where equation 8 gives no direction. The radius comes last: its square may be nothing in f32.
vec3 lengthened(vec3 p, float h, vec2 fallback, float radius, vec3 direction)
{
    vec2 along = seen_along(p, direction);
    float seen = sqrt(dot(along, along));
    vec3 v = radius * direction;
    float half_length = radius * seen / (p.z * p.z - v.z * v.z); // equation 8
    return half_length < h ? vec3((seen > 0.0 ? along / seen : fallback) * (h * p.z), 0.0) : v;
}

// Answers with the share of its weight that the splat keeps if weights go by area.
float adjust_tangents_as_the_paper(vec3 p, vec3 normal, float radius, inout vec3 s, inout vec3 t)
{
    // Where the disk faces the eye, any basis will do. Written so that no radius divides by 0.
    vec3 direction_s = s / max(radius, 1e-38);
    vec3 direction_t = t / max(radius, 1e-38);
    vec3 across = precise_cross(p, normal);
    if (dot(across, across) > 0.0) {
        direction_s = safe_normalize(across);
        direction_t = precise_cross(normal, direction_s);
    }
    float before = projected_area(p, radius * direction_s, radius * direction_t);
    float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    vec2 s_across = seen_along(p, direction_s);
    s_across = dot(s_across, s_across) > 0.0 ? normalize(s_across) : vec2(1.0, 0.0);
    s = lengthened(p, h, vec2(1.0, 0.0), radius, direction_s);
    t = lengthened(p, h, vec2(-s_across.y, s_across.x), radius, direction_t);
    float after = projected_area(p, s, t);
    return FORMULA(FORMULA_SHARE, clamp(before / after, LEAST_SHARE, 1.0));
}
