// Attribute accumulation as Guennebaud, Barthe, Paulin 2006 publish it: blending multiplies by the weight.
#version 460
#include "inc/paper_weight.glsl"

layout(location = 3) flat in vec3 normal;
layout(location = 4) flat in vec3 color;

layout(location = 0) out vec4 color_weight;
layout(location = 1) out vec4 normal_weight;

void main()
{
    float weight = weight_and_depth(gl_FragDepth);
    color_weight = vec4(color, weight);
    normal_weight = vec4(normal, weight);
}
