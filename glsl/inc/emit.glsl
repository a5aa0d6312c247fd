// Emits a splat's primitive with the pass's extra varyings; nothing where it covers no pixel's center.
//
// POINTS: a point sprite. TRIANGLES: three vertices. QUADS: a strip of four vertices an instance. SOME_LARGE: of points and triangles
// all but the splats that are listed as large, of quads only those.

// The same expressions must give the same bits in both passes, which are different pipelines (Vulkan 1.3, "Invariance").
#define VARYING invariant out
#include "inc/varyings.glsl"
#include "inc/expansion.glsl"
#include "inc/point.glsl"
#include "inc/quad.glsl"
#include "inc/triangle.glsl"

layout(constant_id = SPEC_SOME_LARGE) const bool SOME_LARGE = false;
#if defined(QUADS)
layout(set = 1, binding = BIND_LIST_ITEMS, std430) readonly buffer LargeList { uint large_list[]; };
#else
layout(set = 1, binding = BIND_LIST_BITS, std430) readonly buffer LargeBits { uint large_bits[]; };
#endif

// The splat of this vertex.
uint splat_index()
{
#if defined(QUADS)
    if (SOME_LARGE) {
        return large_list[gl_InstanceIndex] - frame.first_record;
    }
    return gl_InstanceIndex;
#elif defined(TRIANGLES)
    return gl_VertexIndex / 3;
#else
    return gl_VertexIndex;
#endif
}

bool is_drawn_elsewhere(uint index)
{
#if defined(QUADS)
    return false;
#else
    return SOME_LARGE && (large_bits[index / 32] >> (index % 32) & 1) != 0;
#endif
}

const float WITHIN_CLIP = 0.5; // a depth: fragments have their own

// What is handed on means nothing then.
void emit_nothing()
{
    gl_Position = NOWHERE;
#if defined(POINTS)
    gl_PointSize = 1.0;
#endif
}

#if defined(RAYS)
void hand_over(Mapping m, vec4 extra)
{
    // Dual to s and t in the splat's plane: u_axis . s = 1, u_axis . t = 0.
    vec3 normal = unit_of(largest(m.n2)) * m.n2;
    float length2 = precise_dot(normal, m.n2);
    vec3 u_axis = precise_cross(m.t, normal) / length2;
    vec3 v_axis = precise_cross(normal, m.s) / length2;
    // 1 / z is linear along the image: n2 . (x, y, 1) / det; of a regular splat expanded about the center. ORTHOGRAPHIC: z is.
    vec3 plane = ORTHOGRAPHIC ? vec3(-m.n2.xy * m.scale, m.p.z) : m.n2 * (m.scale / m.near);
    bool about_center = m.regular || ORTHOGRAPHIC;
    if (about_center && !ORTHOGRAPHIC) {
        plane.z = 1.0 / m.p.z; // there
    }
    if (m.edge_on) {
        about_center = false;
        plane = vec3(0.0, 0.0, ORTHOGRAPHIC ? 2.0 * m.near : 0.0); // its rays meet nothing
    }
    // The square that its approximate size leaves of the splat; none where the center is too near to have one.
    float half_square_px = 0.0;
    if (RASTERIZER == RASTERIZER_RAYCAST_APPROXIMATE && m.p.z > m.near) {
        half_square_px = approximate_radius(m) * frame.focal_px;
    }
    // x and y of positions in focal lengths, so that a pixel is its ray; lengths in the view unit, which fragments know.
    vec3 stretch = vec3(frame.focal_px, frame.focal_px, 1.0);
    ray_center_extra = vec4(m.p * stretch / m.unit, extra.x);
    ray_plane_extra = vec4(ORTHOGRAPHIC ? plane / vec3(stretch.xy, 1.0) : plane / stretch * m.unit, extra.y);
    ray_u_extra = vec4(u_axis / stretch * m.unit, extra.z);
    ray_v_square = vec4(v_axis / stretch * m.unit, about_center ? half_square_px : -1.0 - half_square_px);
}
#elif !defined(TRIANGLES)
void hand_over(Mapping m, ImageMap map, vec4 extra)
{
#if defined(PLAIN)
    x0_w_extra = vec4(expansion_of(map), extra.x);
#else
    x0_w_extra = vec4(handed_over_px(map.x0_px), map.at_x0.z, extra.x);
#endif
    per_x_extra = vec4(map.along_x, extra.y);
    per_y_extra = vec4(map.along_y, extra.z);
#if defined(FULL) || defined(CENTER)
    uv_affine = vec4(map.at_x0.xy, map.affine ? 1.0 : 0.0, extra.w);
#endif
#if defined(CENTER)
    bool low_pass = m.p.z > nearest_drawn(m);
    center_low_pass = low_pass ? vec3(handed_over_px(projected_center_px(m)), center_depth(m)) : vec3(0.0);
#endif
}
#endif

#if defined(CLIPPED)
void hand_clip_over(uint index, Mapping m)
{
    Curve curves[2];
    clip_in_image(index, m, curves);
    clip_curves = vec4[](curves[0].c, curves[0].a, curves[0].b, curves[1].c, curves[1].a, curves[1].b);
}
#else
void hand_clip_over(uint index, Mapping m) {}
#endif

// `moves`: depth that fragments don't find by themselves is moved away from the eye.
void emit(Mapping m, vec4 extra, bool moves)
{
#if defined(TRIANGLES)
    vec2 uv = triangle_corner(m, gl_VertexIndex % 3);
    vec3 q = m.p + m.s * uv.x + m.t * uv.y;
    float divisor = ORTHOGRAPHIC ? 1.0 : q.z;
    float z = FORMULA(FORMULA_CENTER_CONSTANTS, ORTHOGRAPHIC ? 1.0 - q.z / m.near : m.near);
    z = moves ? shifted(z, m.shift) : z;
    // Depth is this position's: bit-equal in both passes but for the shift. (gl_Position itself can't be `invariant`: Mesa
    // 22.3 warns of it.)
    vec2 xy = 2.0 * frame.focal_px / SIZE_PX * q.xy + clip_from_axis() * divisor;
    gl_Position = vec4(xy, z, divisor);
    triangle_uv = uv;
    triangle_extra = extra;
#else
#if defined(POINTS)
    Square square;
    if (!square_of(m, square)) {
        emit_nothing();
        return;
    }
    gl_Position = vec4(clip_middle(square), WITHIN_CLIP, 1.0);
    gl_PointSize = point_size_px(square);
#if !defined(RAYS)
    hand_over(m, regular_map(m), extra);
#endif
#else
    Quad quad;
    if (!quad_of(m, gl_VertexIndex, quad)) {
        emit_nothing();
        return;
    }
    gl_Position = vec4(quad.clip_corner, WITHIN_CLIP, 1.0);
#if !defined(RAYS)
    hand_over(m, quad_map(m, quad), extra);
#endif
#endif
#if defined(RAYS)
    hand_over(m, extra);
#endif
#if defined(FOURTH)
    fourth = extra.w;
#endif
#endif
}
