// Attribute accumulation by ray casting as Botsch et al. 2005 have it: the larger one of kernel and low-pass filter, whose
// arguments' smaller one decides; the weight is a fetch.
#version 460
#include "inc/botsch_ray.glsl"

layout(set = 2, binding = 1) uniform sampler2D kernel; // over r^2

layout(location = 4) flat in vec2 center_px; // in radii of the low-pass filter
layout(location = 5) flat in vec3 normal;
layout(location = 6) flat in vec3 color;

layout(location = 0) out vec4 color_weight;
layout(location = 1) out vec4 normal_weight;

void main()
{
    float r2 = r2_and_depth(gl_FragDepth);
    vec2 d = gl_FragCoord.xy * rays.inverse_filter - center_px;
    float weight = texture(kernel, vec2(min(r2, dot(d, d)), 0.5)).r;
    if (weight <= 0.0) {
        discard;
    }
    color_weight = vec4(color, weight);
    normal_weight = vec4(normal, weight);
}
