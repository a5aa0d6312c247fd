// From sums to what a surface shows at a pixel: SPLATS, POLYGONS, or both of one surface, which then blend by the sum of the splats'
// weights, clamped to 1, where a polygon covers the pixel (Guennebaud et al. 2006, section 5.1): the sum falls from above 1 to 0
// at the border of the splats.
//
// LAYER: the surface is transparent; its alpha is the weighted mean, too. Normals of closed things were summed as they are,
// outward, and are turned to the eye here: at a silhouette, front and back are one surface within epsilon, and turned before,
// what is left of their sum would face the eye and shine.

#include "inc/sums.glsl"
layout(set = 0, binding = BIND_SUMS_POLYGON_COLORS) uniform texture2D polygon_colors;   // sum of linear albedo, polygons in the sum
layout(set = 0, binding = BIND_SUMS_POLYGON_NORMALS) uniform texture2D polygon_normals; // sum of normals, sum of alpha

layout(constant_id = SPEC_SPLATS) const bool SPLATS = false;
layout(constant_id = SPEC_POLYGONS) const bool POLYGONS = false;

// `v`: the direction to the eye.
vec3 turned(vec3 normal, vec3 v)
{
#if defined(LAYER)
    return dot(normal, v) < 0.0 ? -normal : normal;
#else
    return normal;
#endif
}

struct Resolved {
    vec3 color;   // linear, shaded
    float alpha;  // 1 unless transparent
    bool covered; // else the others mean nothing
};

// A surface at a pixel, not shaded yet.
struct Unshaded {
    vec3 albedo;   // linear
    vec3 normal;   // unit, view space, to the eye where it is transparent
    float alpha;   // 1 unless transparent
    float weight;  // sum of weights of splats; of polygons, how many
};

Unshaded load_splats(ivec2 pixel, vec3 v)
{
    Surface surface = load_surface(pixel);
    Unshaded splats = Unshaded(surface.albedo, turned(surface.normal, v), 1.0, surface.weight);
#if defined(LAYER)
    splats.alpha = surface.weight > 0.0 ? texelFetch(normal_sums, pixel, 0).w / surface.weight : 0.0;
#endif
    return splats;
}

Unshaded load_polygons(ivec2 pixel, vec3 v)
{
    vec4 color_sum = texelFetch(polygon_colors, pixel, 0);
    vec4 normal_sum = texelFetch(polygon_normals, pixel, 0);
    float share = color_sum.a > 0.0 ? 1.0 / color_sum.a : 0.0;
    vec3 normal = normal_of_sum(normal_sum.xyz);
    Unshaded polygons = Unshaded(color_sum.rgb * share, turned(normal, v), 1.0, color_sum.a);
#if defined(LAYER)
    polygons.alpha = normal_sum.w * share;
#endif
    return polygons;
}

Resolved resolve_alone(Unshaded surface, vec3 v)
{
    return Resolved(shaded(surface.albedo, surface.normal, v), surface.alpha, surface.weight > 0.0);
}

// `v`: the unit direction to the eye, view space.
Resolved resolve(ivec2 pixel, vec3 v)
{
    if (!POLYGONS) {
        return resolve_alone(load_splats(pixel, v), v);
    }
    if (!SPLATS) {
        return resolve_alone(load_polygons(pixel, v), v);
    }
    Unshaded splats = load_splats(pixel, v);
    Unshaded polygons = load_polygons(pixel, v);
    float share = polygons.weight > 0.0 ? min(FORMULA(FORMULA_TRANSITION, splats.weight), 1.0) : 1.0;
    if (TRANSITION == TRANSITION_NONE && polygons.weight > 0.0) {
        share = 0.0;
    }
    if (TRANSITION == TRANSITION_ATTRIBUTES) {
        Unshaded both;
        both.albedo = mix(polygons.albedo, splats.albedo, share);
        both.normal = normal_of_sum(mix(polygons.normal, splats.normal, share));
        both.alpha = mix(polygons.alpha, splats.alpha, share);
        both.weight = max(polygons.weight, splats.weight);
        return resolve_alone(both, v);
    }
    // Few pixels show both. A loop that ends early, for CPU drivers run either side of a branch, whoever takes it; with its
    // condition at the end, for they run a body once more than the condition before it says. What a pixel has when it leaves
    // is, in some (llvmpipe of Mesa 22.3), what the last one to leave makes of it: so nothing of a pixel that shows one
    // depends on `i`.
    bool both = share > 0.0 && share < 1.0;
    float of_splats = share * splats.alpha;
    float of_polygons = (1.0 - share) * polygons.alpha;
    float alpha = of_splats + of_polygons;
    vec3 sum = vec3(0.0); // with alpha multiplied in: what is not there has no color
    vec3 color;
    int i = 0;
    do {
        bool is_splats = both ? i == 0 : share > 0.0;
        vec3 albedo = is_splats ? splats.albedo : polygons.albedo;
        color = shaded(albedo, is_splats ? splats.normal : polygons.normal, v);
        sum += (is_splats ? of_splats : of_polygons) * color;
        i++;
    } while (i < (both ? 2 : 1));
    if (both) {
        color = alpha > 0.0 ? sum / alpha : vec3(0.0);
    }
    return Resolved(color, alpha, max(splats.weight, polygons.weight) > 0.0);
}
