// Attribute accumulation: one quad for each splat of the list of large ones.
#version 460
#include "inc/setup.glsl"
#include "inc/emit_quad.glsl"

layout(location = 4) flat out vec3 splat_normal; // view space, unit, toward the eye

void main()
{
    uint index = large_list[gl_InstanceIndex];
    Mapping m;
    splat_normal = vec3(0.0);
    if (map_splat(index, m)) {
        emit_quad(m, load_color(index));
        splat_normal = m.normal;
    } else {
        emit_nothing();
    }
}
