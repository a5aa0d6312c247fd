// What lies over the picture of a window: a texel of the atlas in the color of the corner. Both are sRGB times alpha, as egui has them;
// the window's image is encoded on writing.
#version 460

layout(std430, set = 0, binding = 2) readonly buffer Atlas { uint texels[]; };

layout(push_constant) uniform Overlay
{
    vec2 window_points;
    ivec2 atlas_px;
};

layout(location = 0) in vec2 atlas_uv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 color;

vec4 texel(ivec2 at)
{
    at = clamp(at, ivec2(0), atlas_px - 1);
    return unpackUnorm4x8(texels[at.y * atlas_px.x + at.x]);
}

vec3 linear_of(vec3 srgb)
{
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

void main()
{
    vec2 at = atlas_uv * vec2(atlas_px) - 0.5;
    ivec2 first = ivec2(floor(at));
    vec2 beside = at - vec2(first);
    vec4 above = mix(texel(first), texel(first + ivec2(1, 0)), beside.x);
    vec4 below = mix(texel(first + ivec2(0, 1)), texel(first + ivec2(1, 1)), beside.x);
    color = tint * mix(above, below, beside.y);
    color.rgb = linear_of(color.rgb);
}
