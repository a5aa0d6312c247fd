// Visibility splatting: sets splats up and hands 1 / f on, with which their depth is moved away from the eye. The
// fragments of triangles have it from the rasterizer; but in a transparent LAYER the shader compares their own depth and moves it.
// Permutations: points small_points | plain center rays
// Permutations: quads listed_quads | full center
// Permutations: listed_quads | rays
// Permutations: triangles small_triangles | _ layer
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"

void main()
{
    uint index = splat_index();
    Mapping m;
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
#if defined(LAYER)
        const float depth_factor = 1.0;
#else
        float depth_factor = m.inverse_shift;
#endif
        emit(m, vec3(m.inverse_shift, 0.0, 0.0), depth_factor);
    } else {
        emit_nothing();
    }
}
