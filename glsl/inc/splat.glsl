// Loads a splat and moves it to view space.
//
// The tangent frame of a disk is the branch-free one of Duff, Burgess, Christensen, Hery, Kensler, Liani, Villemin:
// "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017: orthonormal to f32 precision for every unit normal,
// also along the axes, where normalize(cross(n, z)) fails.

#include "inc/view.glsl"
#include "inc/packed.glsl"

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer Shapes { vec4 shapes[]; };
layout(set = 0, binding = BIND_SPLATS_COLORS, std430) readonly buffer Colors { uvec2 colors[]; };

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

// The power of two that makes a length about 1; its exponent stays within +-100, so that nothing else leaves f32 by it.
float unit_of(float size)
{
    uint exponent = clamp(floatBitsToUint(size) >> 23 & 255, 27, 227);
    return uintBitsToFloat((254 - exponent) << 23);
}

float largest(vec3 v)
{
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// A vector from the eye, in the axes of local space: rounded, and what that left.
struct FromEye {
    vec3 high;
    vec3 low;
};

// A point of the splat is p + u s + v t with u^2 + v^2 <= 1. Lengths are in a unit of the splat's own, a power of two times the view
// unit, in which the largest of |p| and the radius is about 1: squares and products of three lengths neither over- nor underflow,
// whatever else is in the chunk. Images, and near over depth, don't depend on it.
struct Splat {
    vec3 p;
    vec3 s;
    vec3 t;
    vec3 normal;   // unit, to the side from which the surface is seen
    float radius;  // the larger one
    float unit;    // what lengths in the view unit were multiplied by
    FromEye from_eye; // the center again, view units
    vec3 n;        // the normal in the axes of local space, about 1 long
    float area;    // s x t over n, rotated
    float epsilon_share; // OWN_EPSILON: of epsilon, what the neighborhood has room for; above 0, at most 1
    bool at_border;      // REACHES: of its surface
};

// Knuth's two-sum of what is moved and the origin: exact but for the sum of what both left.
FromEye from_eye(vec3 position, vec3 position_low)
{
    vec3 origin = vec3(frame.origin_from_eye[0], frame.origin_from_eye[1], frame.origin_from_eye[2]);
    vec3 origin_low = vec3(frame.origin_from_eye[3], frame.origin_from_eye[4], frame.origin_from_eye[5]);
    vec3 moved = frame.view_from_local_scale * position; // exact, a power of two
    vec3 p = moved + origin;
    vec3 part = p - moved;
    vec3 lost = (moved - (p - part)) + (origin - part);
    if (!FINE) {
        return FromEye(p, lost + origin_low);
    }
    // Next to the eye, what is left may be as large as the rest.
    vec3 rest = lost + (origin_low + frame.view_from_local_scale * position_low);
    vec3 high = p + rest;
    vec3 of_rest = high - p;
    vec3 low = (p - (high - of_rest)) + (rest - of_rest);
    return FromEye(high, low);
}

// A fine splat's center in view space. x and y cancel where it is far from the eye beside its distance from the axis, so that they are
// dot products in two parts. What f32 leaves of the rows' own numbers matters along the axis only, where the center may be far.
vec3 fine_center(FromEye d)
{
    float z = precise_dot(frame.view_from_local_z.xyz, d.high);
    float x = exact_dot(frame.view_from_local_x.xyz, d.high, d.low) + frame.view_from_local_x.w * z;
    float y = exact_dot(frame.view_from_local_y.xyz, d.high, d.low) + frame.view_from_local_y.w * z;
    return FORMULA(FORMULA_VIEW_TRANSFORM, vec3(x, y, z));
}

const uint SHAPE_VECTORS = (ELLIPSES ? 3 : 2) + (FINE ? 1 : 0);

// The center in view space. Without the lower parts of positions one rotation and one sum: as exact as those positions.
vec3 center_of(vec3 position, FromEye d)
{
    if (FINE) {
        return fine_center(d);
    }
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    vec3 p = frame.view_from_local_scale * FORMULA(FORMULA_VIEW_TRANSFORM, rotated(position)) + translation;
    return p;
}

// n . p, rounded about once, also where the splat is seen edge-on; positive where it faces away. Not in view space: there the
// rotation's rounding, 1e-7, is 1e-3 of the cosine of 89.99 degrees. (s x t) . p is that times the area. Of parallel rays, their
// direction stands for p.
float normal_dot_ray(Splat splat)
{
    if (ORTHOGRAPHIC) {
        return exact_dot(splat.n, frame.view_from_local_z.xyz, vec3(0.0));
    }
    return exact_dot(splat.n, splat.unit * splat.from_eye.high, splat.unit * splat.from_eye.low);
}

// A splat as it lies in memory.
struct Stored {
    vec4 position_radius;
    vec3 position_low;
    vec3 s; // of a disk its normal
    vec3 t;
    uint two; // the last bit: at a border; of the lower half the others: 1 less the share of epsilon, 0 where nobody looked; upper half: one over the overlap
};

Stored load_stored(uint index)
{
    if (PACKED) {
        uvec4 words = packed_shapes[index];
        vec3 position = vec3(unpacked_coordinate(words.x), unpacked_coordinate(words.y), unpacked_coordinate(words.z));
        return Stored(vec4(position, unpacked_radius(words.xyz)), vec3(0.0), unpacked_normal(words.w), vec3(0.0), 0u);
    }
    uint first = SHAPE_VECTORS * index;
    vec3 low = FINE ? shapes[first + SHAPE_VECTORS - 1].xyz : vec3(0.0);
    vec4 second = shapes[first + 1];
    return Stored(shapes[first], low, second.xyz, ELLIPSES ? shapes[first + 2].xyz : vec3(0.0), floatBitsToUint(second.w));
}

// What a splat weighs beside its filter: of a node as much more than the splats that it stands for as these have more area in all than it, so that it
// leaves on the surface what they would. Where edges are covered in part, over the overlap of the surface around it.
float own_weight(uint index)
{
    float weight = LEVELS == LEVELS_NODES ? shapes[SHAPE_VECTORS * index + 2].w : 1.0;
    if (COVERAGE_EDGES) {
        weight *= inverse_overlap(frame.blocks_overlap);
        if (!PACKED) {
            weight *= inverse_overlap(floatBitsToUint(shapes[SHAPE_VECTORS * index + 1].w));
        }
    }
    return weight;
}

// Of an ellipse's tangent vectors, that make them about 1 long, so that their product has a direction whatever their lengths.
vec2 units_of_tangents(Stored stored)
{
    return vec2(unit_of(largest(stored.s)), unit_of(largest(stored.t)));
}

// About 1 long.
vec3 normal_of(Stored stored)
{
    vec2 units = units_of_tangents(stored);
    return ELLIPSES ? exact_cross(units.x * stored.s, units.y * stored.t) : stored.s;
}

void set_ellipse(inout Splat splat, Stored stored)
{
    float scale = splat.unit * frame.view_from_local_scale;
    vec2 units = units_of_tangents(stored);
    splat.area = (scale / units.x) * (scale / units.y);
    splat.normal = rotated(safe_normalize(splat.n));
    splat.s = scale * FORMULA(FORMULA_TANGENT_FRAME, rotated(stored.s));
    splat.t = scale * rotated(stored.t);
}

void set_disk(inout Splat splat)
{
    vec3 n = rotated(splat.n);
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    splat.s = splat.radius * FORMULA(FORMULA_TANGENT_FRAME, vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x));
    splat.t = splat.radius * vec3(b, side + n.y * n.y * a, -n.y);
    splat.normal = n;
    splat.area = splat.radius * splat.radius;
}

Splat load_splat(uint index)
{
    Stored stored = load_stored(index);
    Splat splat;
    splat.from_eye = from_eye(stored.position_radius.xyz, stored.position_low);
    splat.p = center_of(stored.position_radius.xyz, splat.from_eye);
    splat.radius = frame.view_from_local_scale * stored.position_radius.w;
    // Parallel rays have the view's unit alone.
    splat.unit = ORTHOGRAPHIC ? 1.0 : unit_of(max(largest(splat.p), splat.radius));
    splat.p *= splat.unit;
    splat.radius *= splat.unit;
    splat.n = normal_of(stored);
    splat.epsilon_share = OWN_EPSILON ? 1.0 - unpackUnorm2x16(stored.two & ~1u).x : 1.0;
    splat.at_border = REACHES && (stored.two & 1u) != 0;
    if (ELLIPSES) {
        set_ellipse(splat, stored);
    } else {
        set_disk(splat);
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
