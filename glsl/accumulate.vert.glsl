// Attribute accumulation: sets splats up and hands color, normal and weight on. extra.w: beside polygons 1 / f, with which depth
// is shifted toward the viewer; of transparent splats alpha. Those of the last layer, where surfaces mix, are lit here, each by
// itself, at its center.
// Permutations: points | plain | _ fourth | _ clipped
// Permutations: points | center | _ clipped
// Permutations: points quads | rays | fourth | _ clipped
// Permutations: quads | full center | _ clipped
// Permutations: triangles | _ clipped
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"
#define LIT
#define LIGHTS_SET 2
#define LIGHTS_BINDING BIND_READ_LIGHTS
#include "inc/shading.glsl"
#define TINTS_SET 2
#define TINTS_BINDING BIND_READ_TINTS
#include "inc/tints.glsl"
#include "inc/summed.glsl"

layout(location = 5) flat out vec4 normal_weight; // view space, unit, toward the eye or outward; the splat's own weight

void main()
{
    uint index = splat_index();
    Mapping m;
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
        vec4 extra = vec4(tinted(vec4(load_color(index), 0.0)).rgb, 0.0);
        if (SUMMED == SUMMED_REST) {
            extra.rgb = shaded(extra.rgb, m.normal, ORTHOGRAPHIC ? vec3(0.0, 0.0, -1.0) : -safe_normalize(m.p));
        }
        if (SUMMED == SUMMED_BESIDE) {
            extra.w = m.shift;
        } else if (SUMMED != SUMMED_OPAQUE) {
            extra.w = tinted(vec4(load_alpha(index))).a;
        }
        emit(m, extra, false);
        hand_clip_over(index, m);
        bool outward = SUMMED == SUMMED_LAYER && OUTWARD && m.faces_away;
        normal_weight = vec4(outward ? -m.normal : m.normal, WEIGHTED ? share_of(m) * own_weight(index) : 1.0);
    } else {
        emit_nothing();
    }
}
