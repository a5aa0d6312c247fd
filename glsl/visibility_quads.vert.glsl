// Visibility splatting: one quad for each splat of the list of large ones.
#version 460
#include "inc/setup.glsl"
#include "inc/emit_quad.glsl"

void main()
{
    Mapping m;
    if (map_splat(large_list[gl_InstanceIndex], m)) {
        emit_quad(m, vec3(m.inverse_shift, 0.0, 0.0));
    } else {
        emit_nothing();
    }
}
