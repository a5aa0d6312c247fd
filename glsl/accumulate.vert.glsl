// Attribute accumulation: sets splats up and hands color, normal and weight on.
// Permutations: points small_points | plain center rays
// Permutations: quads listed_quads | full center
// Permutations: listed_quads | rays
// Permutations: triangles small_triangles
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"

layout(location = 5) flat out vec4 normal_weight; // view space, unit, toward the eye; the splat's own weight

void main()
{
    uint index = splat_index();
    Mapping m;
    normal_weight = vec4(0.0);
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
        emit(m, load_color(index), 1.0);
        normal_weight = vec4(m.normal, WEIGHTED ? share_of(m) : 1.0);
    } else {
        emit_nothing();
    }
}
