// From sums to the surface seen at a pixel.

struct Surface {
    float weight; // sum of weights; 0: nothing here
    vec3 albedo;  // linear
    vec3 normal;  // unit, view space
};

// Normals that cancel give (0, 0, -1), the one toward the viewer. The smallest weight is 2^-60, and where something is cut off 1e-18 of that (tile/pixel.glsl):
// the square of the sum would be below the smallest f32, or one of those next to it, which GPUs take for 0. So small sums are made larger first, which
// rounds nothing.
vec3 normal_of_sum(vec3 sum)
{
    float largest = max(max(abs(sum.x), abs(sum.y)), abs(sum.z));
    sum *= largest < 9.094947e-13 ? 1.1529215e18 : 1.0; // 2^-40, 2^60
    float length2 = dot(sum, sum);
    return length2 > 0.0 ? sum * inversesqrt(length2) : vec3(0.0, 0.0, -1.0);
}

Surface normalized(vec4 color_sum, vec3 normal_sum)
{
    Surface surface;
    surface.weight = color_sum.a;
    surface.albedo = color_sum.a > 0.0 ? FORMULA(FORMULA_NORMALIZED_COLOR, color_sum.rgb * (1.0 / color_sum.a)) : vec3(0.0);
    surface.normal = normal_of_sum(normal_sum);
    return surface;
}
