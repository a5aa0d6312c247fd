// For the floor benchmark: a constant to every pixel of the target.
#version 460

layout(location = 0) out vec4 color;

void main()
{
    color = vec4(0.5);
}
