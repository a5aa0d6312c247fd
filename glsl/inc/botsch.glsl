// Ray casting as Botsch, Hornung, Zwicker, Kobbelt: "High-quality surface splatting on today's GPUs", PBG 2005, have it and
// nothing else: what table 1 of Guennebaud, Barthe, Paulin 2006 compares with. To be counted.
//
// A splat is its center, two tangent vectors and the normal; what its fragments need is handed over: the center, the normal
// and the tangent vectors over their squared lengths. The point's size is the larger radius as it appears at the center's
// depth; splats end where that does.

layout(set = 0, binding = 0, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = 1, std430) readonly buffer Colors { uvec2 colors[]; };

struct BotschConstants {
    vec4 view_from_local_x; // row of the rotation, then the translation, local unit
    vec4 view_from_local_y;
    vec4 view_from_local_z;
    vec4 clip_from_view_x;  // row of the projection
    vec4 clip_from_view_y;
    vec4 clip_from_view_z;
    vec4 clip_from_view_w;
    float size_px;          // 2 f
    float epsilon;
    float least_size_px;    // of the low-pass filter
};
layout(push_constant, std430) uniform Push { BotschConstants push; };

#define VARYING out
#include "inc/botsch_varyings.glsl"

vec3 view_center()
{
    vec4 position = vec4(shapes[3 * gl_VertexIndex].xyz, 1.0);
    return vec3(
        dot(push.view_from_local_x, position),
        dot(push.view_from_local_y, position),
        dot(push.view_from_local_z, position));
}

vec3 rotated(vec3 v)
{
    return vec3(
        dot(push.view_from_local_x.xyz, v), dot(push.view_from_local_y.xyz, v), dot(push.view_from_local_z.xyz, v));
}

// Sets the splat at p up. Answers with the unit normal and the point's size.
vec3 set_up(vec3 p, out float size_px)
{
    vec3 s = rotated(shapes[3 * gl_VertexIndex + 1].xyz);
    vec3 t = rotated(shapes[3 * gl_VertexIndex + 2].xyz);
    vec3 n = normalize(cross(s, t));
    float s2 = dot(s, s);
    float t2 = dot(t, t);
    center = p;
    plane = n / dot(n, p);
    u_axis = s / s2;
    v_axis = t / t2;
    float largest2 = max(s2, t2);
    size_px = push.size_px * (largest2 * inversesqrt(largest2)) / p.z;
    vec4 position = vec4(p, 1.0);
    gl_Position = vec4(
        dot(push.clip_from_view_x, position),
        dot(push.clip_from_view_y, position),
        dot(push.clip_from_view_z, position),
        dot(push.clip_from_view_w, position));
    return n;
}
