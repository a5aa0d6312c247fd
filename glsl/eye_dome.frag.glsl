// Eye-dome lighting (Boucheny 2009): a pixel is darker the more its neighbors are nearer to the eye. Of the albedo and the depth of
// opaque splats alone; no normal is in it.
//
// Of eight neighbors, all of them a knight's move away, those that are nearer count by ln(z / z of the neighbor), which is the same in any
// unit, over the angle between both pixels: by the slope to the neighbor, which does not depend on the picture's size either. An orthographic camera has the slope at once.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/perturb.glsl"
#include "inc/config.glsl"
#include "inc/finalize.glsl"
#include "inc/projection.glsl"
#include "inc/sums.glsl"

layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D visible_depth;

layout(location = 0) out vec4 color;

// View-space z of the surface over that of the near plane; of an orthographic camera w; 0 where there is none.
float depth(ivec2 pixel)
{
    float weight = texelFetch(color_sums, pixel, 0).a;
    float w_visible = texelFetch(visible_depth, pixel, 0).r;
    float depth_sum = texelFetch(normal_sums, pixel, 0).w; // of weight * z / z_visible
    float mean = depth_sum / weight;
    return weight > 0.0 && w_visible > 0.0 ? (ORTHOGRAPHIC ? mean + w_visible : mean / w_visible) : 0.0;
}

// ln(far / near), exact where both are nearly the same, and log2 is not: 2 artanh.
float log_ratio(float far, float near)
{
    float x = (far - near) / (far + near);
    float x2 = x * x;
    return x2 < 0.01 ? 2.0 * x * (1.0 + x2 * (1.0 / 3.0 + x2 * 0.2)) : log2(far / near) * 0.69314718;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = ivec2(2.0 * push.half_size_px);
    float here = depth(pixel);
    float slopes = 0.0;
    // Most of a picture may be empty.
    for (int i = 0; i < (here > 0.0 ? 8 : 0); i++) {
        ivec2 move = (i & 4) == 0 ? ivec2(1, 2) : ivec2(2, 1);
        ivec2 other = pixel + ivec2((i & 1) == 0 ? move.x : -move.x, (i & 2) == 0 ? move.y : -move.y);
        if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) {
            continue;
        }
        float there = depth(other);
        if (ORTHOGRAPHIC) {
            slopes += push.near * max(there - here, 0.0);
        } else if (there > 0.0 && there < here) {
            slopes += log_ratio(here, there);
        }
    }
    // sqrt(5) pixels are the length of a knight's move.
    float slope = FORMULA(FORMULA_EYE_DOME, slopes * push.focal_px * 0.055901699); // 1 / (8 sqrt(5))
    vec3 albedo = load_surface(pixel).albedo;
    color = here > 0.0 ? vec4(albedo * exp(-EYE_DOME_STRENGTH * slope), 1.0) : push.background;
}
