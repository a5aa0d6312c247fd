// Visibility splatting: sets splats up and hands on by what their depth is moved away from the eye. The
// fragments of triangles have it from the rasterizer; but in a transparent layer the shader compares their own depth and moves it.
// Permutations: points | plain center rays | _ clipped
// Permutations: quads | full center rays | _ clipped
// Permutations: triangles | _ clipped
#version 460
#include "inc/setup.glsl"
#include "inc/emit.glsl"

void main()
{
    uint index = splat_index();
    Mapping m;
    if (!is_drawn_elsewhere(index) && map_splat(index, m)) {
#if defined(TRIANGLES)
        bool moves = !IN_LAYERS;
#else
        bool moves = false;
#endif
        emit(m, vec4(m.shift, 0.0, 0.0, 0.0), moves);
        hand_clip_over(index, m);
    } else {
        emit_nothing();
    }
}
