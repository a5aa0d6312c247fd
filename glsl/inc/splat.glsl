// Loads a splat and moves it to view space.
//
// The tangent frame of a disk is the branch-free one of Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin:
// "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017: orthonormal to f32 precision for every unit normal,
// also along the axes, where normalize(cross(n, z)) fails.

#include "inc/view.glsl"
#include "inc/packed.glsl"

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = BIND_SPLATS_COLORS, std430) readonly buffer Colors { uvec2 colors[]; };

// A point of the splat is p + u s + v t with u^2 + v^2 <= 1.
struct Splat {
    vec3 p;
    vec3 s;
    vec3 t;
    vec3 normal;  // unit, to the side from which the surface is seen
    float radius; // the larger one
    float det;    // (s x t) . p, with all its digits also where the splat is seen edge-on
};

vec3 precise_cross(vec3 a, vec3 b)
{
    vec3 product = a.yzx * b.zxy - a.zxy * b.yzx;
    return product;
}

// Scaled by the largest component first, so that nothing under- or overflows on the way.
vec3 safe_normalize(vec3 v)
{
    vec3 a = abs(v);
    vec3 scaled = v / max(max(a.x, a.y), a.z);
    vec3 unit = scaled / sqrt(dot(scaled, scaled));
    return unit;
}

// The upper 12 of a float's 24 bits: products of two such are exact.
vec3 upper_half(vec3 v)
{
    return uintBitsToFloat(floatBitsToUint(v) & 0xfffff000u);
}

// a . b + a . b_low, rounded about once: the products in halves (Dekker, "A floating-point technique for extending the
// available precision", Numer. Math. 18, 1971), their sum with what each addition loses (Knuth's two-sum).
float exact_dot(vec3 a, vec3 b, vec3 b_low)
{
    vec3 a1 = upper_half(a);
    vec3 b1 = upper_half(b);
    vec3 a2 = a - a1;
    vec3 b2 = b - b1;
    vec3 big = a1 * b1;
    vec3 small = a1 * b2 + a2 * b1 + (a2 * b2 + a * b_low);
    float xy = big.x + big.y;
    float y = xy - big.x;
    float lost_xy = (big.x - (xy - y)) + (big.y - y);
    float xyz = xy + big.z;
    float z = xyz - xy;
    float lost_xyz = (xy - (xyz - z)) + (big.z - z);
    float sum = xyz + (lost_xy + lost_xyz + (small.x + small.y + small.z));
    return sum;
}

// a x b, each component rounded about once.
vec3 exact_cross(vec3 a, vec3 b)
{
    return vec3(
        exact_dot(vec3(a.y, -a.z, 0.0), vec3(b.z, b.y, 0.0), vec3(0.0)),
        exact_dot(vec3(a.z, -a.x, 0.0), vec3(b.x, b.z, 0.0), vec3(0.0)),
        exact_dot(vec3(a.x, -a.y, 0.0), vec3(b.y, b.x, 0.0), vec3(0.0)));
}

// n . p of a local normal and a local position, the eye at the origin. Not in view space: there the rotation's rounding,
// 1e-7, is 1e-3 of the cosine of 89.99 degrees.
float normal_dot_center(vec3 n, vec3 position)
{
    vec3 origin = vec3(frame.origin_from_eye[0], frame.origin_from_eye[1], frame.origin_from_eye[2]);
    vec3 origin_low = vec3(frame.origin_from_eye[3], frame.origin_from_eye[4], frame.origin_from_eye[5]);
    vec3 moved = frame.view_from_local_scale * position; // exact, a power of two
    vec3 p = moved + origin;
    vec3 part = p - moved;
    vec3 lost = (moved - (p - part)) + (origin - part) + origin_low;
    return exact_dot(n, p, lost);
}

Splat load_splat(uint index)
{
    Splat splat;
    float scale = frame.view_from_local_scale;
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    if (ELLIPSES) {
        vec4 position_radius = shapes[3 * index];
        splat.p = scale * FORMULA(FORMULA_VIEW_TRANSFORM, rotated(position_radius.xyz)) + translation;
        splat.s = scale * FORMULA(FORMULA_TANGENT_FRAME, rotated(shapes[3 * index + 1].xyz));
        splat.t = scale * rotated(shapes[3 * index + 2].xyz);
        splat.normal = safe_normalize(cross(safe_normalize(splat.s), safe_normalize(splat.t)));
        splat.radius = scale * position_radius.w;
        vec3 n_local = exact_cross(scale * shapes[3 * index + 1].xyz, scale * shapes[3 * index + 2].xyz);
        splat.det = normal_dot_center(n_local, position_radius.xyz);
    } else {
        vec4 position_radius;
        vec3 n_local;
        if (PACKED) {
            uvec4 words = packed_shapes[index];
            position_radius = vec4(unpacked_coordinate(words.x), unpacked_coordinate(words.y),
                unpacked_coordinate(words.z), unpacked_radius(words.xyz));
            n_local = unpacked_normal(words.w);
        } else {
            position_radius = shapes[2 * index];
            n_local = shapes[2 * index + 1].xyz;
        }
        vec3 n = rotated(n_local);
        float side = n.z >= 0.0 ? 1.0 : -1.0;
        float a = -1.0 / (side + n.z);
        float b = n.x * n.y * a;
        splat.p = scale * FORMULA(FORMULA_VIEW_TRANSFORM, rotated(position_radius.xyz)) + translation;
        splat.radius = scale * position_radius.w;
        splat.s = splat.radius * FORMULA(FORMULA_TANGENT_FRAME, vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x));
        splat.t = splat.radius * vec3(b, side + n.y * n.y * a, -n.y);
        splat.normal = n;
        splat.det = splat.radius * splat.radius * normal_dot_center(n_local, position_radius.xyz);
    }
    return splat;
}

// Where each splat has its own color: one for all is never packed.
vec4 load_packed_color(uint index)
{
    uvec2 pair = colors[index >> 1];
    return unpacked_color((index & 1) == 0 ? pair.x : pair.y);
}

// Linear albedo of a splat.
vec3 load_color(uint index)
{
    if (PACKED && !UNIFORM_COLOR) {
        return FORMULA(FORMULA_COLOR, load_packed_color(index).rgb);
    }
    uvec2 packed = colors[UNIFORM_COLOR ? 0 : index];
    return FORMULA(FORMULA_COLOR, vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x));
}

// Its alpha.
float load_alpha(uint index)
{
    if (PACKED && !UNIFORM_COLOR) {
        return FORMULA(FORMULA_ALPHA, load_packed_color(index).a);
    }
    uvec2 packed = colors[UNIFORM_COLOR ? 0 : index];
    return FORMULA(FORMULA_ALPHA, unpackUnorm2x16(packed.y).y);
}
