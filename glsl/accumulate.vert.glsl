// Attribute accumulation: sets splats up and hands color, normal and weight on.
//
// BESIDE: there are polygons, against which depth is shifted toward the viewer. LAYER: the splats are transparent. BLENDED: they
// are in the last layer, where surfaces mix, so that each is lit by itself, at its center.
// LIT: by lights of the scene's own.
// Permutations: points small_points | plain center rays | _ beside layer blended blended_lit
// Permutations: quads listed_quads | full center | _ beside layer blended blended_lit
// Permutations: listed_quads | rays | _ beside layer blended blended_lit
// Permutations: triangles small_triangles | _ beside layer blended blended_lit
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"
#if defined(BLENDED_LIT)
#define BLENDED
#define LIT
#endif
#if defined(BLENDED)
#define LIGHTS_SET 2
#define LIGHTS_BINDING 3
#include "inc/shading.glsl"
#endif

layout(location = 5) flat out vec4 normal_weight; // view space, unit, toward the eye or outward; the splat's own weight
#if defined(BESIDE)
layout(location = 6) flat out float inverse_shift; // 1 / f
#elif defined(LAYER) || defined(BLENDED)
layout(location = 6) flat out float alpha;
#endif

void main()
{
    uint index = splat_index();
    Mapping m;
    normal_weight = vec4(0.0);
#if defined(BESIDE)
    inverse_shift = 1.0;
#elif defined(LAYER) || defined(BLENDED)
    alpha = 0.0;
#endif
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
        vec3 color = load_color(index);
#if defined(BLENDED)
        color = shaded(color, m.normal, -safe_normalize(m.p));
#endif
        emit(m, color, 1.0);
        vec3 normal = m.normal;
#if defined(LAYER)
        normal = OUTWARD && m.faces_away ? -normal : normal;
#endif
        normal_weight = vec4(normal, WEIGHTED ? share_of(m) : 1.0);
#if defined(BESIDE)
        inverse_shift = m.inverse_shift;
#elif defined(LAYER) || defined(BLENDED)
        alpha = load_alpha(index);
#endif
    } else {
        emit_nothing();
    }
}
