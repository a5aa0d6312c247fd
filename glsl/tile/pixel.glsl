// What a splat does to a pixel of a tile: it is seen there, and then added to what is. Of opaque splats the nearest surface is seen;
// PEELS: of transparent ones the nearest that is behind the layer before (inc/peel.glsl proves that none is lost or taken twice).
//
// TWO_SIDED: where edges are covered in part, epsilon is many radii of a slanted splat (inc/mapping.glsl), and would take both sides of a
// plate, a leaf or a wall for one surface. So a surface is of one side: of splats that face the eye or of those that face away, as the one
// whose shifted depth is nearest. What faces the other way is left for the next surface. So are layers: at the rim of something closed both sides are within
// an epsilon, and have colors of their own.
//
// A splat's own depth is the same expression in both, which nothing may contract (src/shaders/build/exact.rs).

layout(constant_id = SPEC_WITH_DEPTH) const bool WITH_DEPTH = false;
layout(constant_id = SPEC_WITH_POLYGONS) const bool WITH_POLYGONS = false;
// The paper's transition shifts for all fragments, not only where there are polygons: the polygons' test is the only one.
layout(constant_id = SPEC_SHIFTED_FOR_ALL) const bool SHIFTED_FOR_ALL = false;

// Surfaces are of one side; what leaves sums to others takes all, and so does the last layer.
const bool BY_SIDES = PEELS && TWO_SIDED;
bool takes_both_sides = false;

const float INFINITELY_NEAR = 2.0; // nearer than any depth, which is 1 at most
const float NOTHING_LEFT = 0.0;    // no depth is below

// The invocation's pixels, in registers.
float visible[ROWS]; // depth of the surface, shifted by epsilon
float goes_on_from[ROWS]; // OF_LAYERS, COVERAGE_EDGES, CURVED: up to this depth a layer may end with which it goes on (tile/stack.glsl)
float before[ROWS];  // PEELS: depth of the layer before
bool visible_away[ROWS];  // BY_SIDES: the surface faces away; `before` is of those that do not,
float before_away[ROWS]; // and this is of those that do
#if defined(POLYGONS)
float behind_polygon[ROWS]; // depth of polygons that are there already, which cover the pixel in part: what is of their surface, or nearer, is, too
#endif
float opaque[ROWS];  // OF_LAYERS: depth of opaque things
float polygon[ROWS]; // WITH_POLYGONS: depth of polygons, or of splats, where those are nearer
vec4 colors[ROWS];   // weighted color, weight
vec4 normals[ROWS];  // weighted normal; OF_LAYERS: weighted alpha; WITH_DEPTH: weighted depth

// As a part of a layer's own epsilon, how far behind another one it may begin that it goes on with.
const float SEAM = 0.2;

#if !defined(POLYGON_REACH)
#define POLYGON_REACH 0.0
#endif

#include "tile/covering.glsl"
#include "tile/creases.glsl"
#include "inc/outline.glsl"

// A splat along the column of pixels: over w0, (uw, vw, w) = at_center_row + along_y * dy. Rows are computed from the splat's center,
// not stepped from the row above: three multiplications more, and no error adds up.
struct Column {
    float w0;
    vec3 at_center_row;
    vec3 along_y;
    float dy; // of the row from which rows are counted, from the splat's center
    float toward; // WITH_POLYGONS: its shift toward a polygon
};

// BY_SIDES: whether a splat faces away, which the sign of its shift tells.
bool is_away(Splat splat)
{
    return BY_SIDES && floatBitsToInt(splat.shift) < 0;
}

float shift_of(Splat splat)
{
    return BY_SIDES ? abs(splat.shift) : splat.shift;
}

// Toward a polygon, where epsilon of a slanted splat is many radii (inc/mapping.glsl), no more than the splat's image is large: the root of the sum of its axes' squares. A splat
// behind a polygon would be seen through it, for nothing else is there that tells how deep the surface is.
float shift_toward_polygon(Splat splat)
{
    if (!WITH_POLYGONS || !COVERAGE_EDGES) {
        return shift_of(splat);
    }
    float det = splat.uv.x * splat.uv.w - splat.uv.y * splat.uv.z;
    float most = POLYGON_REACH * (sqrt(dot(splat.uv, splat.uv)) / abs(det));
    return ORTHOGRAPHIC ? min(shift_of(splat), most) : max(shift_of(splat), 1.0 / (1.0 + most));
}

Column column_of(Splat splat)
{
    float dx = top_px.x - splat.x0_px.x;
    Column column;
    column.w0 = depth_of(splat);
    column.at_center_row.x = splat.uv.x * dx;
    column.at_center_row.y = splat.uv.z * dx;
    column.at_center_row.z = 1.0 + splat.w.x * dx;
    column.along_y = vec3(splat.uv.yw, splat.w.y);
    column.dy = top_px.y - splat.x0_px.y;
    column.toward = shift_toward_polygon(splat);
    return column;
}

vec3 uvw_of(Column column, int row)
{
    return column.at_center_row + column.along_y * (column.dy + float(first_row + row));
}

// Whether the splat covers the pixel, behind the layer before. A regular splat lies wholly beyond the near plane, but an affine map
// reaches further than the splat. `kept`: what clip curves and planes leave of it.
bool covers(vec3 uvw, float depth, bool away, Kept kept, int row)
{
    float limit = FORMULA(FORMULA_COVERAGE, COVERAGE_R2);
    bool inside = dot(uvw.xy, uvw.xy) <= (AFFINE ? limit : limit * (uvw.z * uvw.z));
    bool beyond_near = !AFFINE || depth > 0.0 && depth <= FORMULA(FORMULA_NEAR_CUT, 1.0);
    return inside && beyond_near && (!CUTS || kept.part > 0.0) && (!PEELS || depth < FORMULA_LESS(FORMULA_PEELED, away ? before_away[row] : before[row]));
}

// No polygon is there.
void begin_behind_polygons(int row)
{
#if defined(POLYGONS)
    behind_polygon[row] = 1e30;
#endif
}

// Those of depth `polygon` are, if `beside`.
void go_behind_polygons(bool beside, int row)
{
#if defined(POLYGONS)
    behind_polygon[row] = beside ? polygon[row] : behind_polygon[row];
#endif
}

bool is_behind_polygons(float depth, float toward, int row)
{
#if defined(POLYGONS)
    return depth < shifted(behind_polygon[row], toward);
#else
    return true;
#endif
}

float r2_of(vec3 uvw)
{
    float r2 = dot(uvw.xy, uvw.xy);
    return AFFINE ? r2 : r2 / (uvw.z * uvw.z);
}

// The nearest depth, shifted by epsilon.
void see(Splat splat, Column column, Kept kept, int row)
{
    vec3 uvw = uvw_of(column, row);
    float depth = column.w0 * uvw.z;
    bool away = is_away(splat);
    bool inside = covers(uvw, depth, away, kept, row) && is_behind_polygons(depth, column.toward, row) && (!OF_LAYERS || depth >= opaque[row]);
    float behind = shifted(depth, shift_of(splat));
    if (BY_SIDES) {
        visible_away[row] = inside && behind > visible[row] ? away : visible_away[row];
    }
    if (OF_LAYERS && COVERAGE_EDGES && CURVED) {
        goes_on_from[row] = inside && behind > visible[row] ? depth + SEAM * (depth - behind) : goes_on_from[row];
    }
    visible[row] = inside ? max(visible[row], behind) : visible[row];
}

const float LEAST_PRIORITY = 1e-18; // what covers has a weight

// Where curves of a ridge meet, each of its sides is shaded as it is: the mean of their normals would be that of neither, and shine. So the side
// that has more of the pixel has next to all of its color, unless both are summed apart (tile/creases.glsl).
float priority(Kept kept)
{
    float part = kept.part;
    part *= part;
    part *= part;
    part *= part;
    return max(part * part, LEAST_PRIORITY);
}

// Adds what a splat is at a pixel.
void add(Splat splat, SplatAttributes attributes, Column column, Kept kept, int row)
{
    vec3 uvw = uvw_of(column, row);
    float depth = column.w0 * uvw.z;
    bool away = is_away(splat);
    bool covering = covers(uvw, depth, away, kept, row);
    bool inside = covering && (!BY_SIDES || takes_both_sides || away == visible_away[row]);
    if (WITH_POLYGONS) {
        inside = inside && is_behind_polygons(depth, column.toward, row);
        inside = inside && (SHIFTED_FOR_ALL || depth >= visible[row])
            && depth >= FORMULA(FORMULA_TOWARD_VIEWER, shifted(polygon[row], column.toward));
    } else {
        inside = inside && depth >= visible[row];
    }
    float inverse_w2 = COVERAGE_EDGES && !AFFINE ? 1.0 / (uvw.z * uvw.z) : 1.0;
    float r2 = COVERAGE_EDGES ? dot(uvw.xy, uvw.xy) * inverse_w2 : r2_of(uvw);
    // Of a splat that reaches further, r^2 is that of what the filter makes of it, where its weights end.
    vec2 squares = uvw.xy * uvw.xy * inverse_w2;
    r2 = REACHES ? dot(attributes.reach.xy, squares) : r2;
    bool at_border = REACHES && attributes.reach.x > 1.0;
    float kernel = at_border && r2 > COVERAGE_R2 ? 0.0 : kernel_weight(r2);
    float shared_weight = max(kernel * attributes.share, LEAST_WEIGHT);
    float weight = inside ? (WEIGHTED ? shared_weight : kernel) : 0.0;
    if (CUTS) {
        weight *= priority(kept);
    }
    if (COVERAGE_EDGES) {
        float part = attributes.own_part.x - (REACHES ? dot(attributes.reach.zw, squares) : attributes.own_part.y * r2);
        // Half of how r^2 changes a pixel, by the map as it is at the splat's center.
        vec2 along = REACHES ? attributes.reach.xy * uvw.xy : uvw.xy;
        vec2 change = splat.uv.xy * along.x + splat.uv.zw * along.y;
        covering = all_cover ? covering && is_behind_polygons(depth, column.toward, row) : inside;
        float covers = covering ? shared_weight : 0.0;
        float own_ellipse = OUTLINED ? part_of_outline(attributes.outline, splat.uv, AFFINE ? vec3(uvw.xy, 1.0) : uvw) : 0.0;
        cover(covers, covers * kernel_decline(r2) * inverse_w2 * change, covering ? part : 0.0, covering && at_border, covering ? own_ellipse : 0.0, Kept(covering ? kept.part : 1.0, kept.toward), row);
    }
    bool beyond = CREASES && is_beyond(kept);
    if (CREASES) {
        note_kept(beyond, inside ? kept.part : 0.0, row);
    }
    vec3 color = attributes.color;
    if (OUTLINES) {
        bool outline = is_outline(r2);
        weight *= outline ? OUTLINE_WEIGHT : 1.0;
        color = outline ? vec3(0.0) : color;
    }
    // Where the splat is not inside, depth may be 0.
    float summed_depth = WITH_DEPTH && inside ? FORMULA(FORMULA_DEPTH_SUM, depth_term(visible[row], depth)) : 0.0;
    if (CREASES) {
        float weight_beyond = beyond ? weight : 0.0;
        weight = beyond ? 0.0 : weight;
        colors_beyond[row] += weight_beyond * vec4(color, 1.0);
        normals_beyond[row].xyz += weight_beyond * attributes.normal;
        if (WITH_DEPTH) {
            normals_beyond[row].w += weight_beyond * summed_depth;
        }
    }
    colors[row] += weight * vec4(color, 1.0);
    normals[row].xyz += weight * attributes.normal;
    if (OF_LAYERS) {
        normals[row].w += weight * attributes.alpha;
    } else if (WITH_DEPTH) {
        normals[row].w += weight * summed_depth;
    }
}
