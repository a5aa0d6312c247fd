// From a surface to its color: one white light at the eye, no attenuation, so that l = v. Phong's mirror direction is
// r = 2 (n.l) n - l, hence r.v = 2 (n.l)^2 - 1.

// Linear light. `normal` and `v`, the direction to the eye, are unit vectors in view space.
vec3 shaded(vec3 albedo, vec3 normal, vec3 v)
{
    if (SHADING == SHADING_ALBEDO) {
        return albedo;
    }
    if (SHADING == SHADING_NORMALS) {
        return 0.5 * vec3(normal.x, -normal.y, -normal.z) + 0.5;
    }
    float n_l = max(dot(normal, v), 0.0);
    vec3 lambert = albedo * (0.1 + FORMULA(FORMULA_DIFFUSE, 0.9 * n_l));
    if (SHADING == SHADING_LAMBERT) {
        return lambert;
    }
    float r_v = max(2.0 * n_l * n_l - 1.0, 0.0);
    float r_v_4 = r_v * r_v * r_v * r_v;
    float r_v_16 = r_v_4 * r_v_4 * r_v_4 * r_v_4;
    return lambert + FORMULA(FORMULA_SPECULAR, 0.2 * r_v_16 * r_v_16);
}
