// What a surface shows at a pixel: splats (SPLATS), polygons (POLYGONS), or both of one surface (HYBRID), which then blend
// by the sum of the splats' weights, clamped to 1, where a polygon covers the pixel (Guennebaud et al. 2006, section 5.1):
// the sum falls from above 1 to 0 at the border of the splats.
//
// LAYER: the surface is transparent; its alpha is the weighted mean, too. Normals of closed things were summed as they are,
// outward, and are turned to the eye here: at a silhouette, front and back are one surface within epsilon, and turned before,
// what is left of their sum would face the eye and shine.

#if defined(SPLATS) || defined(HYBRID)
#include "inc/surface.glsl"
#endif
#if defined(POLYGONS) || defined(HYBRID)
layout(set = 0, binding = 2) uniform texture2D polygon_colors;  // sum of linear albedo, polygons in the sum
layout(set = 0, binding = 3) uniform texture2D polygon_normals; // sum of normals, sum of alpha
#endif

// `v`: the direction to the eye.
vec3 turned(vec3 normal, vec3 v)
{
#if defined(LAYER)
    return dot(normal, v) < 0.0 ? -normal : normal;
#else
    return normal;
#endif
}

struct Shown {
    vec3 color;   // linear, shaded
    float alpha;  // 1 unless transparent
    bool covered; // else the others mean nothing
};

#if defined(SPLATS) || defined(HYBRID)
Shown load_splats(ivec2 pixel, vec3 v, out Surface surface)
{
    surface = load_surface(pixel);
    surface.normal = turned(surface.normal, v);
    Shown shown;
    shown.covered = surface.weight > 0.0;
    shown.color = shaded(surface.albedo, surface.normal, v);
#if defined(LAYER)
    shown.alpha = shown.covered ? texelFetch(normal_sums, pixel, 0).w / surface.weight : 0.0;
#else
    shown.alpha = 1.0;
#endif
    return shown;
}
#endif

#if defined(POLYGONS) || defined(HYBRID)
Shown load_polygons(ivec2 pixel, vec3 v, out vec3 albedo, out vec3 normal)
{
    vec4 color_sum = texelFetch(polygon_colors, pixel, 0);
    vec4 normal_sum = texelFetch(polygon_normals, pixel, 0);
    Shown shown;
    shown.covered = color_sum.a > 0.0;
    float share = shown.covered ? 1.0 / color_sum.a : 0.0;
    albedo = color_sum.rgb * share;
    float length2 = dot(normal_sum.xyz, normal_sum.xyz);
    normal = turned(length2 > 0.0 ? normal_sum.xyz * inversesqrt(length2) : vec3(0.0, 0.0, -1.0), v);
    shown.color = shaded(albedo, normal, v);
#if defined(LAYER)
    shown.alpha = normal_sum.w * share;
#else
    shown.alpha = 1.0;
#endif
    return shown;
}
#endif

// `v`: the unit direction to the eye, view space.
Shown load_shown(ivec2 pixel, vec3 v)
{
#if defined(SPLATS)
    Surface surface;
    return load_splats(pixel, v, surface);
#elif defined(POLYGONS)
    vec3 albedo;
    vec3 normal;
    return load_polygons(pixel, v, albedo, normal);
#else
    Surface surface;
    Shown splats = load_splats(pixel, v, surface);
    vec3 albedo;
    vec3 normal;
    Shown polygons = load_polygons(pixel, v, albedo, normal);
    if (!polygons.covered) {
        return splats;
    }
    if (!splats.covered || TRANSITION == TRANSITION_NONE) {
        return polygons;
    }
    float share = min(FORMULA(FORMULA_TRANSITION, surface.weight), 1.0);
    Shown both;
    both.covered = true;
    both.alpha = mix(polygons.alpha, splats.alpha, share);
    if (TRANSITION == TRANSITION_ATTRIBUTES) {
        vec3 blended = mix(normal, surface.normal, share);
        float length2 = dot(blended, blended);
        both.color = shaded(mix(albedo, surface.albedo, share),
            length2 > 0.0 ? blended * inversesqrt(length2) : vec3(0.0, 0.0, -1.0), v);
    } else {
        // With alpha multiplied in: what is not there has no color.
        vec3 color = mix(polygons.alpha * polygons.color, splats.alpha * splats.color, share);
        both.color = both.alpha > 0.0 ? color / both.alpha : vec3(0.0);
    }
    return both;
#endif
}
