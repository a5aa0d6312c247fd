// A pixel's ray and the splat's plane meet; r^2 = u^2 + v^2 there, and the depth. See inc/botsch.glsl.

#define VARYING in
#include "inc/botsch_varyings.glsl"

layout(set = 2, binding = 0, std140) uniform Rays {
    vec2 inverse_focal;
    vec2 corner;         // of the image, image plane
    vec2 inverse_filter; // per pixel, in radii of the low-pass filter
    float near;
} rays;

float r2_and_depth(out float depth)
{
    vec3 ray = vec3(gl_FragCoord.xy * rays.inverse_focal + rays.corner, 1.0);
    float inverse_z = dot(plane, ray);
    vec3 q = ray * (1.0 / inverse_z) - center;
    vec2 uv = vec2(dot(u_axis, q), dot(v_axis, q));
    depth = rays.near * inverse_z;
    return dot(uv, uv);
}
