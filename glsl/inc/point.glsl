// A splat as a point sprite.

#include "inc/square.glsl"

void emit_point(uint index, Setup o)
{
    Square square = point_square(o);
    gl_Position = vec4(square.center, SAFE_DEPTH, 1.0);
    gl_PointSize = square.size_px;
    emit_varyings(index, o);
}
