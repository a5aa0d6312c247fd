// For the floor benchmark: depth alone.
#version 460

void main()
{
}
