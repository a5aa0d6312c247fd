// From local to view space; see frame.glsl.

// Written out, because the compiler marks no built-in function as exact: depth depends on these.
float precise_dot(vec3 a, vec3 b)
{
    float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

vec3 rotated(vec3 v)
{
    vec3 view = vec3(
        precise_dot(frame.view_from_local_x.xyz, v),
        precise_dot(frame.view_from_local_y.xyz, v),
        precise_dot(frame.view_from_local_z.xyz, v));
    return view;
}
