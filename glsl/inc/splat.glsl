// Loads a splat and moves it to view space.
//
// The tangent frame of a disk is the branch-free one of Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin:
// "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017: orthonormal to f32 precision for every unit normal,
// also along the axes, where normalize(cross(n, z)) fails.

layout(set = 0, binding = 0, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = 1, std430) readonly buffer Colors { uvec2 colors[]; };

// A point of the splat is p + u s + v t with u^2 + v^2 <= 1.
struct Splat {
    vec3 p;
    vec3 s;
    vec3 t;
    vec3 normal;  // unit, to the side from which the surface is seen
    float radius; // the larger one
};

// Written out, because the compiler marks no built-in function as exact: depth depends on these.
float precise_dot(vec3 a, vec3 b)
{
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

vec3 precise_cross(vec3 a, vec3 b)
{
    precise vec3 product = a.yzx * b.zxy - a.zxy * b.yzx;
    return product;
}

vec3 rotated(vec3 v)
{
    precise vec3 view = vec3(
        precise_dot(frame.view_from_local_x.xyz, v),
        precise_dot(frame.view_from_local_y.xyz, v),
        precise_dot(frame.view_from_local_z.xyz, v));
    return view;
}

// Scaled by the largest component first, so that nothing under- or overflows on the way.
vec3 safe_normalize(vec3 v)
{
    precise vec3 a = abs(v);
    precise vec3 scaled = v / max(max(a.x, a.y), a.z);
    precise vec3 unit = scaled / sqrt(dot(scaled, scaled));
    return unit;
}

Splat load_splat(uint index)
{
    precise Splat splat;
    float scale = frame.view_from_local_scale;
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    if (ELLIPSES) {
        vec4 position_radius = shapes[3 * index];
        splat.p = scale * FORMULA(FORMULA_VIEW_TRANSFORM, rotated(position_radius.xyz)) + translation;
        splat.s = scale * FORMULA(FORMULA_TANGENT_FRAME, rotated(shapes[3 * index + 1].xyz));
        splat.t = scale * rotated(shapes[3 * index + 2].xyz);
        splat.normal = safe_normalize(cross(safe_normalize(splat.s), safe_normalize(splat.t)));
        splat.radius = scale * position_radius.w;
    } else {
        vec4 position_radius = shapes[2 * index];
        vec3 n = rotated(shapes[2 * index + 1].xyz);
        float side = n.z >= 0.0 ? 1.0 : -1.0;
        precise float a = -1.0 / (side + n.z);
        precise float b = n.x * n.y * a;
        splat.p = scale * FORMULA(FORMULA_VIEW_TRANSFORM, rotated(position_radius.xyz)) + translation;
        splat.radius = scale * position_radius.w;
        splat.s = splat.radius * FORMULA(FORMULA_TANGENT_FRAME, vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x));
        splat.t = splat.radius * vec3(b, side + n.y * n.y * a, -n.y);
        splat.normal = n;
    }
    return splat;
}

// Linear albedo of a splat.
vec3 load_color(uint index)
{
    uvec2 packed = colors[frame.uniform_color != 0 ? 0 : index];
    return FORMULA(FORMULA_COLOR, vec3(unpackUnorm2x16(packed.x), unpackUnorm2x16(packed.y).x));
}
