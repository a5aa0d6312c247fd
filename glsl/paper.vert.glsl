// The splat setup as Guennebaud, Barthe, Paulin 2006 publish it and nothing else: to be counted, and to show what our own
// setup costs more and is more exact in. Sections 3.1, 3.2 and 4.1, for disks in front of the eye.
//
// N = adj(M) by three cross products (equation 5), scaled so that w = b / z (equation 6), a fourth row for the depth
// (equation 7 with a = 0). Pixels are mapped to the image plane and (u, v) to texture coordinates on the way: M is
// [2s, 2t, p - s - t], whose (u, v) go from 0 to 1 across the disk. All tangent vectors below are those doubled ones.
//
// The paper asks for a conservative box and leaves the how open: here a point about the projected center c. From
// x - c = (u a + v b) / (p_z (p_z + u s_z + v t_z)), a = s_xy p_z - s_z p_xy and b alike of t, follows
// |x - c| <= sqrt(a^2 + b^2) / (p_z (p_z - |s_z| - |t_z|)), component by component.
//
// Limits, all of them the paper's: no splat may reach the eye plane; products that cancel are left to f32 (edge-on disks, small
// and far ones); points that are larger than the device's are cut; rounding of a point's borders can lose a pixel.
//
// VISIBILITY: moved along the ray by epsilon. They do not say whether it is filtered; their table 1 has 12 instructions more for the
// attribute pass (ACCUMULATE), about what the filter takes, so that it is not.
// Permutations: visibility accumulate
#version 460
#include "inc/config.glsl"

layout(location = 0) flat out vec4 per_x; // the three columns of N, with a fourth row for the depth
layout(location = 1) flat out vec4 per_y;
layout(location = 2) flat out vec4 at_corner; // pixel (0, 0)
#if defined(ACCUMULATE)
layout(location = 3) flat out vec3 normal;
layout(location = 4) flat out vec3 color;
#else
layout(constant_id = SPEC_FILTERED) const bool FILTERED = false; // to see what of the error is the missing filter
#endif

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = BIND_SPLATS_COLORS, std430) readonly buffer Colors { uvec2 colors[]; };

// The host's mirror is `PaperConstants` in src/passes/pipeline/constants.rs; the build compares the offsets.
struct PaperConstants {
    vec4 view_from_local_x; // row of the rotation, then the translation, local unit
    vec4 view_from_local_y;
    vec4 view_from_local_z;
    vec4 clip_from_view;    // 2 f / width, 2 f / height, 1/2, 1
    vec3 scale;             // b / f, b / f, b with b = near, f in pixels
    float size_px;          // f
    vec2 middle_px;         // of the image
    float filter_radius;    // 2 h, image plane
    float epsilon_radii;    // of the visibility pass
};
layout(push_constant, std430) uniform Push { PaperConstants push; };

// Center and normal in view space, and the radius.
void load_disk(out vec3 p, out vec3 n, out float radius)
{
    vec4 position_radius = shapes[2 * gl_VertexIndex];
    vec4 position = vec4(position_radius.xyz, 1.0);
    vec3 normal = shapes[2 * gl_VertexIndex + 1].xyz;
    p = vec3(
        dot(push.view_from_local_x, position),
        dot(push.view_from_local_y, position),
        dot(push.view_from_local_z, position));
    n = vec3(
        dot(push.view_from_local_x.xyz, normal),
        dot(push.view_from_local_y.xyz, normal),
        dot(push.view_from_local_z.xyz, normal));
    radius = position_radius.w;
}

// Equation 10, to the diameter's length.
void basis(vec3 p, vec3 n, float radius, out vec3 s, out vec3 t)
{
    s = cross(p, n);
    s *= 2.0 * radius * inversesqrt(dot(s, s));
    t = cross(n, s);
}

// Of both tangent vectors: what their ends are away from the center on the screen, times z of both. The numerator of
// equation 8.
vec4 across(vec3 p, vec3 s, vec3 t)
{
    return vec4(s.xy, t.xy) * p.z - vec4(s.zz, t.zz) * p.xyxy;
}

// Equations 8 and 9 for both tangent vectors at once.
void adjust(vec3 p, inout vec3 s, inout vec3 t)
{
    vec4 projected = across(p, s, t);
    vec2 z = vec2(s.z, t.z);
    vec2 depth2 = p.z * p.z - 0.25 * (z * z);
    vec2 least = push.filter_radius * depth2;
    vec2 length2 = vec2(dot(projected.xy, projected.xy), dot(projected.zw, projected.zw));
    bvec2 is_short = lessThan(length2, least * least);
    vec2 stretch = (p.z * push.filter_radius) * vec2(inversesqrt(length2.x), inversesqrt(length2.y));
    vec4 xy = mix(vec4(s.xy, t.xy), projected * stretch.xxyy, is_short.xxyy);
    z = mix(z, vec2(0.0), is_short);
    s = vec3(xy.xy, z.x);
    t = vec3(xy.zw, z.y);
}

// The point and the three columns of the map. `depth_factor`: what the depth is multiplied by.
void emit(vec3 p, vec3 s, vec3 t, float depth_factor)
{
    vec4 away = across(p, s, t);
    vec2 size2 = away.xy * away.xy + away.zw * away.zw;
    float largest2 = max(size2.x, size2.y);
    vec2 z = abs(vec2(s.z, t.z));
    float nearest = p.z - 0.5 * z.x - 0.5 * z.y;
    gl_PointSize = push.size_px * (largest2 * inversesqrt(largest2)) / (p.z * nearest);
    gl_Position = p.xyzz * push.clip_from_view;

    vec3 p0 = p - 0.5 * s - 0.5 * t;
    vec3 u = cross(t, p0);
    vec3 v = cross(p0, s);
    vec3 w = cross(s, t);
    vec3 scale = push.scale / dot(w, p);
    u *= scale;
    v *= scale;
    w *= scale;
    vec3 depth = w * depth_factor;
    per_x = vec4(u.x, v.x, w.x, depth.x);
    per_y = vec4(u.y, v.y, w.y, depth.y);
    at_corner = vec4(u.z, v.z, w.z, depth.z) - per_x * push.middle_px.x - per_y * push.middle_px.y;
}

void main()
{
    vec3 p;
    vec3 n;
    float radius;
    load_disk(p, n, radius);
    vec3 s;
    vec3 t;
    basis(p, n, radius, s, t);
#if defined(ACCUMULATE)
    adjust(p, s, t);
    emit(p, s, t, 1.0);
    normal = n;
    uvec2 packed = colors[gl_VertexIndex];
    color = vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x);
#else
    if (FILTERED) {
        adjust(p, s, t);
    }
    // The same image, depth b / (z + epsilon).
    emit(p, s, t, p.z / (p.z + push.epsilon_radii * radius));
#endif
}
