// Disks in 16 bytes, and colors in 4: what src/prepare/packed.rs packs, where the layout, its bounds and sources are.

layout(set = 0, binding = BIND_SPLATS_SHAPES, std430) readonly buffer PackedShapes { uvec4 packed_shapes[]; };

// A coordinate in the lower 25 bits, in steps of 2^-24: exact.
float unpacked_coordinate(uint word)
{
    return float(int(word << 7)) * (1.0 / 2147483648.0);
}

// The upper 7 bits of each word: exponent and fraction of an f32, counted from 1.0 down.
float unpacked_radius(uvec3 words)
{
    uint code = words.x >> 25 | words.y >> 25 << 7 | words.z >> 25 << 14;
    return uintBitsToFloat((code + 0x5f0001u) << 7);
}

// Octahedral: the square's corners fold down.
vec3 unpacked_normal(uint word)
{
    vec2 square = unpackSnorm2x16(word);
    float z = 1.0 - abs(square.x) - abs(square.y);
    float down = max(-z, 0.0);
    vec3 n = vec3(square.x + (square.x >= 0.0 ? -down : down), square.y + (square.y >= 0.0 ? -down : down), z);
    vec3 unit = n / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return unit;
}

// The square roots of red, green, blue; and alpha.
vec4 unpacked_color(uint word)
{
    vec4 roots = unpackUnorm4x8(word);
    return vec4(roots.rgb * roots.rgb, roots.a);
}
