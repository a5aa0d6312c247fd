// Attribute accumulation: one point a splat, where every splat is regular and fits a point.
#version 460
#include "inc/setup.glsl"
#include "inc/emit_point.glsl"

layout(location = 3) flat out vec3 splat_normal; // view space, unit, toward the eye

void main()
{
    uint index = uint(gl_VertexIndex);
    Mapping m;
    splat_normal = vec3(0.0);
    if (map_splat(index, m)) {
        emit_point(m, load_color(index));
        splat_normal = m.normal;
    } else {
        emit_nothing();
    }
}
