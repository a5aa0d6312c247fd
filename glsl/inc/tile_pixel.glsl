// What a splat does to a pixel of a tile: it is seen there, and then added to what is.

#if !defined(SUMMED)
// The nearest depth, shifted by epsilon.
void see(Splat splat, Column column, int row, inout float visible)
{
    vec3 uvw = uvw_of(column, row);
    bool inside = is_inside(uvw);
    float depth = column.w0 * uvw.z;
    float shifted = depth * splat.inverse_shift;
    inside = inside && is_beyond_near(depth);
    visible = inside ? max(visible, shifted) : visible;
}
#endif

#if !defined(VISIBLE)
// Adds what a splat is at a pixel.
void add(Splat splat, Look look, Column column, int row, float visible, float polygon, inout vec4 colors, inout vec4 normals)
{
    vec3 uvw = uvw_of(column, row);
    float depth = column.w0 * uvw.z;
    bool inside = is_inside(uvw) && is_beyond_near(depth);
#if defined(BESIDE)
    inside = inside && (SHIFTED_FOR_ALL || depth >= visible)
        && depth >= FORMULA(FORMULA_TOWARD_VIEWER, polygon * splat.inverse_shift);
#else
    inside = inside && depth >= visible;
#endif
    float weight = weight_of(uvw, look.share, inside);
    colors += weight * vec4(look.color, 1.0);
    normals.xyz += weight * look.normal;
#if defined(WITH_DEPTH)
    // Where the splat is not inside, depth may be 0.
    normals.w += inside ? weight * FORMULA(FORMULA_DEPTH_SUM, visible / depth) : 0.0;
#endif
}
#endif
