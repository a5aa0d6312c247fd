// What a chunk's linear colors and alphas are multiplied by in a frame; TINTED: those of some chunk are. TINTS_SET, TINTS_BINDING: where that is found.

layout(constant_id = SPEC_TINTED) const bool TINTED = false;
layout(set = TINTS_SET, binding = TINTS_BINDING, std430) readonly buffer Tints { vec4 tints[]; };

vec4 tinted(vec4 color)
{
    return TINTED ? color * tints[CHUNK] : color;
}
