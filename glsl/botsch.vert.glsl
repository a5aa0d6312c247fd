// Ray casting as Botsch, Hornung, Zwicker, Kobbelt: "High-quality surface splatting on today's GPUs", PBG 2005, have it and
// nothing else: what table 1 of Guennebaud, Barthe, Paulin 2006 compares with. To be counted.
//
// A splat is its center, two tangent vectors and the normal; what its fragments need is handed over: the center, the normal
// and the tangent vectors over their squared lengths. The point's size is the larger radius as it appears at the center's
// depth; splats end where that does.
//
// VISIBILITY: moved along the ray by epsilon. ACCUMULATE: the point is as large as the low-pass filter at least; the normal looks to the
// eye, for shading.
// Permutations: visibility accumulate
#version 460
#include "inc/config.glsl"

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = BIND_SPLATS_COLORS, std430) readonly buffer Colors { uvec2 colors[]; };

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

layout(location = 0) flat out vec3 center; // view space
layout(location = 1) flat out vec3 plane;  // n / (n . p)
layout(location = 2) flat out vec3 u_axis; // s / s.s
layout(location = 3) flat out vec3 v_axis; // t / t.t
#if defined(ACCUMULATE)
layout(location = 4) flat out vec2 center_px; // in radii of the low-pass filter
layout(location = 5) flat out vec3 normal;
layout(location = 6) flat out vec3 color;
#endif

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

void main()
{
    vec3 p = view_center();
#if defined(ACCUMULATE)
    float size_px;
    vec3 n = set_up(p, size_px);
    gl_PointSize = max(size_px, push.least_size_px);
    center_px = p.xy / p.z * push.size_px;
    normal = dot(n, p) > 0.0 ? -n : n;
    uvec2 packed = colors[gl_VertexIndex];
    color = vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x);
#else
    p += push.epsilon * inversesqrt(dot(p, p)) * p;
    set_up(p, gl_PointSize);
#endif
}
