// Attribute accumulation as in accumulate.glsl, and the depth of the surface: the weighted mean of z, summed as
// z / z_visible, which is at most 1, so that 16 bits neither overflow nor lose it. z = near / w, so the ratio is
// w_visible / w, with w_visible the visibility pass's (shifted) depth.

layout(set = 2, binding = 0) uniform texture2D visible_depth;

layout(location = 0) out vec4 color_sum;  // weight * linear albedo, weight
layout(location = 1) out vec4 normal_sum; // weight * normal, weight * z / z_visible

void main()
{
    vec3 uvw = covered_uvw(frame.coverage_r2);
    gl_FragDepth = uvw.z;
    float weight = kernel_weight(dot(uvw.xy, uvw.xy));
    float w_visible = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).r;
    color_sum = weight * vec4(extra(), 1.0);
    normal_sum = weight * vec4(splat_normal, FORMULA(FORMULA_DEPTH_SUM, w_visible / uvw.z));
}
