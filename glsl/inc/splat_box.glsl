// The box of what a rasterizer and a filter draw of a splat, image plane.

// The low-pass filter's disk of `max`.
void include_low_pass(inout Box box, Mapping m)
{
    vec2 center = projected_center(m);
    float h = FORMULA_LESS(FORMULA_LOW_PASS_BOX, frame.filter_radius);
    box.lo = min(box.lo, center - h);
    box.hi = max(box.hi, center + h);
}

// Botsch et al. 2005: the larger radius as it appears at the center's depth, about the projected center. Tilted disks off
// the axis reach beyond it and are chopped.
float approximate_radius(Mapping m)
{
    // The larger half axis, whatever the tangent vectors: with a = s . s, b = t . t its square is (a + b + |(a - b, 2 s . t)|) / 2.
    float a = dot(m.s, m.s);
    float b = dot(m.t, m.t);
    float radius = sqrt(0.5 * (a + b + length(vec2(a - b, 2.0 * dot(m.s, m.t)))));
    float half_size = FORMULA(FORMULA_APPROXIMATE_SIZE, radius / m.p.z);
    if (FILTER == FILTER_MAX) {
        half_size = max(half_size, frame.filter_radius);
    }
    return half_size;
}

Box splat_box(Mapping m)
{
    if (RASTERIZER == RASTERIZER_RAYCAST_APPROXIMATE && m.p.z > m.near) {
        vec2 center = m.p.xy / m.p.z;
        float half_size = approximate_radius(m);
        return Box(center - half_size, center + half_size);
    }
    if (FILTER == FILTER_EWA && m.regular) {
        Stretched ewa = stretched(m);
        vec2 minor_direction = vec2(-ewa.direction.y, ewa.direction.x);
        return ellipse_box(ewa.middle, ewa.direction * ewa.half_axes.x, minor_direction * ewa.half_axes.y);
    }
    Box box;
    if (ORTHOGRAPHIC) {
        box = ellipse_box(m.p.xy, m.s.xy, m.t.xy);
    } else if (RASTERIZER == RASTERIZER_AFFINE_CENTER && m.regular) {
        vec2 center = m.p.xy / m.p.z;
        box = ellipse_box(center, (m.s.xy - center * m.s.z) / m.p.z, (m.t.xy - center * m.t.z) / m.p.z);
    } else if (m.regular) {
        box = regular_box(m);
    } else {
        box = near_box(m);
    }
    if (FILTER == FILTER_MAX && m.p.z > nearest_drawn(m)) {
        include_low_pass(box, m);
    }
    return box;
}
