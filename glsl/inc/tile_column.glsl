// A splat in the pixels of an invocation: what it covers, how deep, and what it weighs there.

// Along the column of pixels: over w0, (uw, vw, w) = at_center_row + along_y * dy.
struct Column {
    float w0;
    vec3 at_center_row;
    vec3 along_y;
    float dy; // of the row from which rows are counted, from the splat's center
};

Column column_of(Splat splat, vec2 at_px)
{
    float dx = at_px.x - splat.x0_px.x;
    Column column;
    column.w0 = splat.w0;
    column.at_center_row.x = splat.uv.x * dx;
    column.at_center_row.y = splat.uv.z * dx;
    column.at_center_row.z = 1.0 + splat.w.x * dx;
    column.along_y = vec3(splat.uv.yw, splat.w.y);
    column.dy = at_px.y - splat.x0_px.y;
    return column;
}

// From the row from which all others are counted, whichever is the invocation's own, so that pixels have the same bits in every way.
vec3 uvw_of(Column column, int row)
{
    return column.at_center_row + column.along_y * (column.dy + float(FIRST_ROW + row));
}

bool is_inside(vec3 uvw)
{
    float limit = FORMULA(FORMULA_COVERAGE, COVERAGE_R2);
    return dot(uvw.xy, uvw.xy) <= (AFFINE ? limit : limit * (uvw.z * uvw.z));
}

// A regular splat lies wholly beyond the near plane, but an affine map reaches further than the splat.
bool is_beyond_near(float depth)
{
    return !AFFINE || depth > 0.0 && depth <= FORMULA(FORMULA_NEAR_CUT, 1.0);
}

const float LEAST_WEIGHT = 5.9604645e-8; // 2^-24

// What it weighs there, and 0 outside.
float weight_of(vec3 uvw, float share, bool inside)
{
    float r2 = dot(uvw.xy, uvw.xy);
    r2 = AFFINE ? r2 : r2 / (uvw.z * uvw.z);
    float weight = kernel_weight(r2);
    weight = WEIGHTED ? max(weight * share, LEAST_WEIGHT) : weight;
    return inside ? weight : 0.0;
}
