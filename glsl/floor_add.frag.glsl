// For the floor benchmark: a constant added to both sums.
#version 460

layout(location = 0) out vec4 color_sum;
layout(location = 1) out vec4 normal_sum;

void main()
{
    color_sum = vec4(0.125);
    normal_sum = vec4(0.125);
}
