// Attribute accumulation: weighted color and normal of every splat that is not behind the visible surface by more than
// its epsilon. The depth test compares the splat's own, unshifted depth; blending adds. extra() is the color.

layout(location = 0) out vec4 color_sum;  // weight * linear albedo, weight
layout(location = 1) out vec4 normal_sum; // weight * normal, 0

void main()
{
    vec3 uvw = covered_uvw(frame.coverage_r2);
    gl_FragDepth = uvw.z;
    float weight = kernel_weight(dot(uvw.xy, uvw.xy));
    color_sum = weight * vec4(extra(), 1.0);
    normal_sum = weight * vec4(splat_normal, 0.0);
}
