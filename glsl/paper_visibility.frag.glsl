// Visibility splatting as Guennebaud, Barthe, Paulin 2006 publish it.
#version 460
#include "inc/paper_weight.glsl"

void main()
{
    weight_and_depth(gl_FragDepth);
}
