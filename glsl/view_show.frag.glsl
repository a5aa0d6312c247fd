// Brings a drawn picture to a window: as it is where their sizes are equal, else scaled; through exposure and a curve where light was
// drawn; beside another picture, or as how far they differ.
#version 460

#include "inc/tonemap.glsl"

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(set = 0, binding = 1) uniform sampler2D other;

layout(push_constant) uniform Show
{
    // What is empty in a picture of light, linear.
    vec4 background;
    ivec2 window_px;
    // The column at which the other picture begins.
    float split_px;
    // 2 to the power of the stops, of pictures of light.
    float exposure;
};

// Pipelines of their own, for devices that are CPUs run all branches: how the two are shown, see below; whether the pictures have the
// window's size; whether they are light that is to be exposed, not what is to be shown; and by which curve, see `inc/tonemap.glsl`.
layout(constant_id = 0) const uint MODE = 0;
layout(constant_id = 1) const bool FITS = true;
layout(constant_id = 2) const bool IS_LIGHT = false;
layout(constant_id = 3) const uint CURVE = CURVE_NONE;

const uint SHOWS_PICTURE = 0;
const uint SHOWS_BOTH = 1;
const uint SHOWS_DIFFERENCE = 2;

layout(location = 0) out vec4 color;

vec3 shown_of(sampler2D image)
{
    vec4 drawn = FITS ? texelFetch(image, ivec2(gl_FragCoord.xy), 0)
                      : textureLod(image, gl_FragCoord.xy / vec2(window_px), 0.0);
    return IS_LIGHT ? mix(background.rgb, tonemapped(drawn.rgb * exposure, CURVE), drawn.a) : drawn.rgb;
}

vec3 srgb_of(vec3 linear)
{
    return mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

// Black, blue, cyan, yellow, red, white: from no step of 8 bits to 32 or more.
vec3 color_of_steps(float steps)
{
    const vec3 RAMP[6] = vec3[](vec3(0), vec3(0, 0, 1), vec3(0, 1, 1), vec3(1, 1, 0), vec3(1, 0, 0), vec3(1));
    float at = 5.0 * clamp(log2(1.0 + steps) / log2(33.0), 0.0, 1.0);
    int below = min(int(at), 4);
    return mix(RAMP[below], RAMP[below + 1], at - float(below));
}

void main()
{
    color = vec4(0, 0, 0, 1);
    if (MODE == SHOWS_DIFFERENCE)
    {
        vec3 steps = 255.0 * abs(srgb_of(shown_of(picture)) - srgb_of(shown_of(other)));
        color.rgb = color_of_steps(max(steps.x, max(steps.y, steps.z)));
    }
    else if (MODE == SHOWS_BOTH && gl_FragCoord.x >= split_px - 1.0)
    {
        // A white line between black ones is seen over any color.
        float column = floor(gl_FragCoord.x - split_px);
        color.rgb = column > 1.0 ? shown_of(other) : vec3(column == 0.0 ? 1.0 : 0.0);
    }
    else
        color.rgb = shown_of(picture);
}
