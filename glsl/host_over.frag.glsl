// A frame's surface over what a host has drawn, within the host's own rendering: its light, which the host's blending lays over what is
// there, and its depth as the host has it, which the host's depth test compares.
//
// DEPTH: of the opaque surface, with its depth. What covers half of a pixel or more is drawn by one pipeline, which writes depth; COVERS_LESS,
// what covers less, by another one, which does not: else what a host draws later would be cut off by what shows it.
// ENCODED: the host's image holds sRGB and does not say so by its format.
// IDS, MOTION, of what writes depth: also the host's number of the object that is seen, and how it has moved in the picture.
// Permutations: ids _ | motion _
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#include "inc/config.glsl"
#include "inc/host.glsl"

layout(constant_id = SPEC_WITH_DEPTH) const bool DEPTH = false;
layout(constant_id = SPEC_COVERS_LESS) const bool COVERS_LESS = false;
layout(constant_id = SPEC_ENCODED) const bool ENCODED = false;

layout(set = 0, binding = BIND_SUMS_COLORS) uniform texture2D surface; // linear light, straight alpha
layout(set = 0, binding = BIND_SUMS_DEPTH) uniform texture2D surface_depth; // w

layout(location = 0) out vec4 color; // alpha multiplied in

#if defined(IDS) || defined(MOTION)
#include "inc/host_objects.glsl"
#if defined(IDS)
layout(location = 1) out uint id;
#if defined(MOTION)
layout(location = 2) out vec2 motion; // pixels, x to the right and y down: where it is now less where it was
#endif
#else
layout(location = 1) out vec2 motion;
#endif
#endif

vec3 encoded(vec3 linear)
{
    vec3 curve = 1.055 * pow(max(linear, 0.0), vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main()
{
    ivec2 pixel = turned_over(ivec2(gl_FragCoord.xy) - push.corner_px);
    vec4 light = texelFetch(surface, pixel, 0);
    if (DEPTH) {
        float w = texelFetch(surface_depth, pixel, 0).r;
        float d = fma(w, push.scale, push.offset);
        // Beyond the host's far plane, or in front of its near plane.
        bool seen = w > 0.0 && d >= 0.0 && d <= 1.0 && light.a > 0.0;
        if (!seen || COVERS_LESS != (light.a < 0.5)) {
            discard;
        }
        gl_FragDepth = d;
#if defined(IDS) || defined(MOTION)
        uint number = texelFetch(object_numbers, pixel, 0).r;
        bool known = number > 0;
        HostObject object = objects[known ? number - 1 : 0];
#if defined(IDS)
        id = known ? object.id : NO_OBJECT;
#endif
#if defined(MOTION)
        motion = known ? motion_of(object, vec4(vec2(pixel) + 0.5, 1.0, w)) : vec2(0.0);
        motion.x = push.columns > 0 ? -motion.x : motion.x;
#endif
#endif
    } else if (light.a == 0.0) {
        discard;
    }
    vec3 shown = ENCODED ? encoded(light.rgb) : light.rgb;
    color = vec4(shown * light.a, light.a);
}
