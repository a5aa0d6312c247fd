// Both splat passes by ray casting as Botsch et al. 2005 have them: a pixel's ray and the splat's plane meet; r^2 = u^2 + v^2 there, and
// the depth. In the attribute pass (ACCUMULATE) the larger one of kernel and low-pass filter counts, whose arguments' smaller one
// decides; the weight is a fetch.
// Permutations: visibility accumulate
#version 460

layout(set = 2, binding = 0, std140) uniform Rays {
    vec2 inverse_focal;
    vec2 corner;         // of the image, image plane
    vec2 inverse_filter; // per pixel, in radii of the low-pass filter
    float near;
} rays;
layout(set = 2, binding = 1) uniform sampler2D kernel; // over r^2

layout(location = 0) flat in vec3 center; // see botsch.vert.glsl
layout(location = 1) flat in vec3 plane;
layout(location = 2) flat in vec3 u_axis;
layout(location = 3) flat in vec3 v_axis;
#if defined(ACCUMULATE)
layout(location = 4) flat in vec2 center_px;
layout(location = 5) flat in vec3 normal;
layout(location = 6) flat in vec3 color;

layout(location = 0) out vec4 color_weight;
layout(location = 1) out vec4 normal_weight;
#endif

void main()
{
    vec3 ray = vec3(gl_FragCoord.xy * rays.inverse_focal + rays.corner, 1.0);
    float inverse_z = dot(plane, ray);
    vec3 q = ray * (1.0 / inverse_z) - center;
    vec2 uv = vec2(dot(u_axis, q), dot(v_axis, q));
    gl_FragDepth = rays.near * inverse_z;
    float r2 = dot(uv, uv);
#if defined(ACCUMULATE)
    vec2 d = gl_FragCoord.xy * rays.inverse_filter - center_px;
    float weight = texture(kernel, vec2(min(r2, dot(d, d)), 0.5)).r;
    if (weight <= 0.0) {
        discard;
    }
    color_weight = vec4(color, weight);
    normal_weight = vec4(normal, weight);
#else
    if (r2 > 1.0) {
        discard;
    }
#endif
}
