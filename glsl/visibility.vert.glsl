// Visibility splatting: sets splats up and hands 1 / f on, with which their depth is moved away from the eye.
// Permutations: points small_points | plain center rays
// Permutations: quads listed_quads | full center
// Permutations: listed_quads | rays
// Permutations: triangles small_triangles
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"

void main()
{
    uint index = splat_index();
    Mapping m;
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
        emit(m, vec3(m.inverse_shift, 0.0, 0.0), m.inverse_shift);
    } else {
        emit_nothing();
    }
}
