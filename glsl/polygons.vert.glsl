// Polygons: the vertices of triangles, for every pass that draws them, so that their depth is the same in all.
//
// Reversed, infinite depth, near / z, is what the division by z leaves of the constant `near`; the device clips at z = near.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/view.glsl"
#include "inc/projection.glsl"
#define TINTS_SET 2
#define TINTS_BINDING BIND_READ_TINTS
#include "inc/tints.glsl"

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Vertices { vec4 vertices[]; }; // position 0, normal 0; local space
layout(set = 0, binding = BIND_SPLATS_COLORS, std430) readonly buffer Colors { uvec2 colors[]; };

layout(location = 0) out vec4 color_alpha; // linear
layout(location = 1) out vec3 normal;      // view space, on the side from which the corners are counterclockwise

void main()
{
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    vec3 p = frame.view_from_local_scale * rotated(vertices[2 * gl_VertexIndex].xyz) + translation;
    vec2 xy = 2.0 * frame.focal_px / SIZE_PX * p.xy;
    if (ORTHOGRAPHIC) {
        gl_Position = vec4(xy + clip_from_axis(), FORMULA(FORMULA_POLYGON_DEPTH, 1.0 - p.z / frame.near), 1.0);
    } else {
        gl_Position = vec4(xy + clip_from_axis() * p.z, FORMULA(FORMULA_POLYGON_DEPTH, frame.near), p.z);
    }
    uvec2 packed = colors[UNIFORM_COLOR ? 0 : gl_VertexIndex];
    color_alpha = tinted(vec4(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y)));
    normal = rotated(vertices[2 * gl_VertexIndex + 1].xyz);
}
