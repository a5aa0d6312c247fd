// For the floor benchmark: depth alone; a constant added to both sums; a constant to every pixel of the target.
// Permutations: depth add fill
#version 460

#if !defined(DEPTH)
layout(location = 0) out vec4 color;
#endif
#if defined(ADD)
layout(location = 1) out vec4 normal;
#endif

void main()
{
#if defined(ADD)
    color = vec4(0.125);
    normal = vec4(0.125);
#elif defined(FILL)
    color = vec4(0.5);
#endif
}
