// Reconstruction kernels from a texture over (u, v), as Guennebaud et al. 2006, section 3.2, have them; written by
// kernel_texture.frag.glsl. The division of their projective fetch is done by then: coverage needed it. u = -1 and 1 are
// the first and the last texel's centers, so that no fetch meets the border.

layout(set = 2, binding = BIND_READ_KERNEL) uniform sampler2D kernel_texture;

float kernel_from_texture(vec2 uv)
{
    const float scale = 0.5 * float(KERNEL_TEXTURE_SIDE - 1) / float(KERNEL_TEXTURE_SIDE);
    float weight = textureLod(kernel_texture, 0.5 + scale * uv, 0.0).r;
    return FORMULA(FORMULA_KERNEL_TEXTURE, max(weight, LEAST_HALF_FLOAT));
}
