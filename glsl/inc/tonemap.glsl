// Curves that bring linear light of any brightness to what a screen shows, linear light from 0 to 1: those of `src/math/tonemap.rs`.

const uint CURVE_NONE = 0;
const uint CURVE_ACES = 1;
const uint CURVE_AGX = 2;

// Stephen Hill's fit of ACES (BakingLab, 2016). The matrices are by columns.
vec3 aces(vec3 light)
{
    const mat3 INTO = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 OUT = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    // Where it is flat already, and its squares are floats.
    vec3 v = min(INTO * light, vec3(1e12));
    return OUT * ((v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.432951) + 0.238081));
}

// AgX (Troy Sobotka 2022) with Benjamin Wrensch's polynomial (2023).
vec3 agx(vec3 light)
{
    const mat3 INTO = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992, 0.878468636469772, 0.0784336,
        0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 OUT = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368, 1.15190312990417,
        -0.0980434501171241, -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    const float LEAST = -12.47393;
    const float MOST = 4.026069;
    vec3 x = (clamp(log2(max(INTO * light, vec3(1e-10))), LEAST, MOST) - LEAST) / (MOST - LEAST);
    vec3 shown = (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
    return pow(clamp(OUT * shown, 0.0, 1.0), vec3(2.2));
}

vec3 tonemapped(vec3 light, uint curve)
{
    light = min(max(light, vec3(0)), vec3(1e12));
    if (curve == CURVE_ACES)
        light = aces(light);
    else if (curve == CURVE_AGX)
        light = agx(light);
    return clamp(light, 0.0, 1.0);
}
