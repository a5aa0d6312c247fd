// The polygons of a tile's pixels, which were drawn and shaded as if there were no splats: at each pixel's center; or, POLYGONS, at four places about it
// (src/passes/polygons/sampled.rs), whose images lie one beside the other.

#if defined(POLYGONS)
#define POLYGON_SAMPLES MOST_POLYGON_SAMPLES
#else
#define POLYGON_SAMPLES 1
#endif

layout(set = 0, binding = BIND_COLORS_BEFORE) uniform texture2D shown_before;
layout(set = 0, binding = BIND_POLYGON_DEPTH) uniform texture2D polygon_depth;

// Those of a pixel that lie between two depths.
struct Polygons {
    vec3 light;     // of what they cover
    float share;    // how much of the pixel that is
    float depth;    // in the mean, which is that at the center where one plane covers all; 0 where there are none
};

Polygons polygons_between(float far, float near, int row)
{
    Polygons polygons = Polygons(vec3(0.0), 0.0, 0.0);
    if (!WITH_POLYGONS) {
        return polygons;
    }
    ivec2 pixel = pixel_within_image(row);
    ivec2 size_px = textureSize(polygon_depth, 0) / 2;
    float count = 0.0;
    [[unroll]] for (int i = 0; i < POLYGON_SAMPLES; i++) {
        ivec2 at = pixel + ivec2(i & 1, i >> 1) * size_px;
        float w = texelFetch(polygon_depth, at, 0).r;
        bool between = w > far && w <= near;
        count += between ? 1.0 : 0.0;
        polygons.light += between ? texelFetch(shown_before, at, 0).rgb : vec3(0.0);
        polygons.depth += between ? w : 0.0;
    }
    polygons.light /= max(count, 1.0);
    polygons.depth /= max(count, 1.0);
    polygons.share = count / float(POLYGON_SAMPLES);
    return polygons;
}
