// What is picked in an image of one pixel: of each run of triangles the nearest. The host takes the nearest of all.
//
// A triangle covers the pixel where the three edges see it on one side: with the corners moved so that the pixel is on the view's axis, the signs of
// x0 y1 - x1 y0 and so on, which are each other's negatives where two triangles share an edge, so that no pixel is between them.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/view.glsl"
#include "inc/variant.glsl"
#include "inc/groups.glsl"
#include "inc/picked.glsl"
#define PLANES_SET 1
#define PLANES_BINDING BIND_LIST_PLANES
#include "inc/planes.glsl"

#define RUN 32

layout(local_size_x = LIST_GROUP_SIZE) in;
layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Vertices { vec4 vertices[]; }; // as polygons.vert.glsl has them
layout(set = 0, binding = BIND_SPLATS_INDICES, std430) readonly buffer Indices { uint indices[]; };

vec3 corner_of(uint vertex)
{
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    return frame.view_from_local_scale * rotated(vertices[2 * vertex].xyz) + translation;
}

// Places in the image seen from the pixel, times z unless ORTHOGRAPHIC.
vec2 from_pixel(vec3 p, vec2 ray)
{
    return p.xy - (ORTHOGRAPHIC ? ray : p.z * ray);
}

float side_of(vec2 a, vec2 b)
{
    return a.x * b.y - b.x * a.y;
}

Picked pick_triangle(uint index)
{
    vec3 a = corner_of(indices[3 * index]);
    vec3 b = corner_of(indices[3 * index + 1]);
    vec3 c = corner_of(indices[3 * index + 2]);
    vec2 ray = (0.5 - frame.middle_px) / frame.focal_px;
    vec2 pa = from_pixel(a, ray);
    vec2 pb = from_pixel(b, ray);
    vec2 pc = from_pixel(c, ray);
    vec3 sides = vec3(side_of(pb, pc), side_of(pc, pa), side_of(pa, pb));
    bool toward = all(lessThanEqual(sides, vec3(0.0)));
    float sum = sides.x + sides.y + sides.z;
    if (sum == 0.0 || !(toward || all(greaterThanEqual(sides, vec3(0.0)))) || CULL_BACKFACES && !toward) {
        return NOTHING_PICKED;
    }
    // The sides are shares of the corners, in space.
    float z = dot(sides, vec3(a.z, b.z, c.z)) / sum;
    float depth = ORTHOGRAPHIC ? 1.0 - z / frame.near : frame.near / z;
    if (!(depth > 0.0 && depth <= 1.0) || PLANES > 0 && is_cut_off(0.5 - frame.middle_px, depth)) {
        return NOTHING_PICKED;
    }
    // As polygons_depth.frag.glsl has it.
    float shift = ORTHOGRAPHIC ? frame.epsilon_length / frame.near : frame.near / (frame.near + frame.epsilon_length * depth);
    float moved = IN_LAYERS && frame.epsilon_length > 0.0 ? shifted(depth, shift) : depth;
    vec3 across = cross(b - a, c - a);
    vec3 normal = normalize(across / max(max(abs(across.x), abs(across.y)), abs(across.z)));
    return Picked(moved, depth, index, 0, vec4(toward ? normal : -normal, 0.0));
}

void main()
{
    uint run = GROUP_NUMBER * LIST_GROUP_SIZE + gl_LocalInvocationID.x;
    uint first = run * RUN;
    if (first >= frame.splat_count) {
        return;
    }
    Picked nearest = NOTHING_PICKED;
    for (uint index = first; index < min(first + RUN, frame.splat_count); index++) {
        Picked found = pick_triangle(index);
        if (found.moved > nearest.moved) {
            nearest = found;
        }
    }
    picked[frame.first_record + run] = nearest;
}
