// From a surface to its color. Phong's mirror direction is r = 2 (n.l) n - l.
//
// Without LIT, or with LIGHTS of 0, there is one white light at the eye, no attenuation, so that l = v and r.v = 2 (n.l)^2 - 1. Else
// there are those of the scene; LIGHTS_SET and LIGHTS_BINDING say where. They are uniform, and their number is a constant of the
// pipeline: from a storage buffer, or where a loop indexes it, a CPU driver fetches for each lane by itself.

#if defined(LIT)
layout(constant_id = SPEC_LIGHTS) const uint LIGHTS = 0;
struct Light {
    vec4 to_light_eye; // the unit direction to the light, view space; 1: it is at the eye, whatever the direction
    vec4 color;        // linear, 0
};
layout(set = LIGHTS_SET, binding = LIGHTS_BINDING, std140) uniform Lights { Light lights[MOST_LIGHTS]; };
#endif

// Linear light. `normal` and `v`, the direction to the eye, are unit vectors in view space.
vec3 shaded(vec3 albedo, vec3 normal, vec3 v)
{
    if (SHADING == SHADING_ALBEDO) {
        return albedo;
    }
    if (SHADING == SHADING_NORMALS) {
        return 0.5 * vec3(normal.x, -normal.y, -normal.z) + 0.5;
    }
#if defined(LIT)
    if (LIGHTS > 0) {
        vec3 diffuse = vec3(0.0);
        vec3 specular = vec3(0.0);
        for (uint i = 0; i < LIGHTS; i++) {
            Light light = lights[i];
            vec3 l = light.to_light_eye.w > 0.0 ? v : light.to_light_eye.xyz;
            float n_l = dot(normal, l);
            if (n_l > 0.0) {
                diffuse += n_l * light.color.rgb;
                float r_v = max(dot(2.0 * n_l * normal - l, v), 0.0);
                float r_v_4 = r_v * r_v * r_v * r_v;
                float r_v_16 = r_v_4 * r_v_4 * r_v_4 * r_v_4;
                specular += FORMULA(FORMULA_LIT_SPECULAR, r_v_16 * r_v_16) * light.color.rgb;
            }
        }
        vec3 lambert = albedo * (0.1 + FORMULA(FORMULA_LIT_DIFFUSE, 0.9 * diffuse));
        return SHADING == SHADING_LAMBERT ? lambert : lambert + 0.2 * specular;
    }
#endif
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
