// Whether nothing within `reach` of a point of view space is seen between these rows of tiles; mark_visible.comp.glsl says why of splats.
bool is_outside(vec3 p, float reach, uvec2 rows)
{
    if (p.z + reach < (ORTHOGRAPHIC ? 0.0 : frame.near)) {
        return true;
    }
    if (!ORTHOGRAPHIC && !(reach <= 0.25 * p.z)) {
        return false;
    }
    vec2 c = ORTHOGRAPHIC ? p.xy : p.xy / p.z;
    vec2 away = (ORTHOGRAPHIC ? vec2(reach) : reach / p.z * (1.0 + abs(c))) + 2.0 * frame.filter_radius;
    vec2 low_px = vec2(0.0, BAND_ROW * rows.x);
    vec2 high_px = vec2(SIZE_PX.x, min(SIZE_PX.y, BAND_ROW * rows.y));
    vec2 low = (low_px - frame.middle_px) / frame.focal_px;
    vec2 high = (high_px - frame.middle_px) / frame.focal_px;
    return any(lessThan(c, low - away)) || any(greaterThan(c, high + away));
}
