// What clip curves and planes leave of a splat in the pixels of an invocation (inc/clip.glsl, inc/planes.glsl).

// COVERAGE_EDGES: f goes from half a ramp behind the pixel to half a ramp before it.
vec2 half_ramp_of(Curve curve)
{
    float steepness2 = dot(curve.c.xy, curve.c.xy);
    return steepness2 > 0.0 ? curve.c.xy / steepness2 : vec2(0.0);
}

// The part of a pixel that a curve leaves.
float part_left(Curve curve, vec2 px)
{
    if (!COVERAGE_EDGES) {
        return keeps(curve, px) ? 1.0 : 0.0;
    }
    vec2 half_ramp = half_ramp_of(curve);
    float behind = kept_side(curve, px - half_ramp);
    float before = kept_side(curve, px + half_ramp);
    float above = max(behind, 0.0) + max(before, 0.0);
    float all = abs(behind) + abs(before);
    // What is left whole is so to the last bit, which a GPU's division does not promise: a number by itself may be less than 1.
    bool is_cut = all > 0.0 && (behind < 0.0 || before < 0.0);
    return is_cut ? above / all : 1.0;
}

// 1 where that is more than 0, else 0: by signs alone, without a root or a division.
float whether_left(Curve curve, vec2 px)
{
    if (!COVERAGE_EDGES) {
        return keeps(curve, px) ? 1.0 : 0.0;
    }
    vec2 half_ramp = half_ramp_of(curve);
    float behind = kept_sign(curve, px - half_ramp);
    float before = kept_sign(curve, px + half_ramp);
    return max(behind, before) > 0.0 || !(min(behind, before) < 0.0) ? 1.0 : 0.0;
}

// What the curve leaves, where it is less than what is left, or of a second one, which both have to remove, more. `seen`: only whether.
void cut_by(Curve curve, bool seen, inout Kept kept[ROWS])
{
    bool is = is_told(curve.c, CURVE_IS);
    bool both = is_told(curve.c, CURVE_BOTH);
    float toward = float(uint(curve.c.w) / CURVE_TOWARD);
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        vec2 px = top_px + vec2(0.0, float(first_row + row));
        float part = seen ? whether_left(curve, px) : part_left(curve, px);
        bool decides = is && (both ? part > kept[row].part : part < kept[row].part);
        kept[row].part = decides ? part : kept[row].part;
        kept[row].toward = decides ? toward : kept[row].toward;
    }
}

#define PLANE_RAMP_PX (1.2533141 * FILTER_PX) // sqrt(2 pi) sigma of the low-pass filter (inc/clip_image.glsl)

const float HARD = 1e30; // of a ramp where a plane does not cross the splat's, one over its width in pixels

// What planes leave, where it is less than what curves do. COVERAGE_EDGES: the surface goes on beyond the splat as the plane cuts it, and what is low-passed is
// its edge: a ramp across the cut, with the slope of the normal distribution, as that of a curve of a large splat.
void cut_by_planes(Splat splat, inout Kept kept[ROWS])
{
    vec2 d = top_px - splat.x0_px;
    vec2 w_per_px = depth_of(splat) * splat.w;
    float w = depth_of(splat) + (w_per_px.x * d.x + w_per_px.y * d.y);
    float least[ROWS]; // by how many ramps a pixel is inside
    float toward[ROWS];
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        least[row] = HARD;
        toward[row] = 0.0;
    }
    // One body for all planes, without a branch: a CPU driver's compiler takes as long as a shader is, and its lanes gain nothing by one.
    [[dont_unroll]] for (uint plane = 0; plane < PLANES; plane++) {
        vec2 per_px = planes[plane].xy + planes[plane].w * w_per_px;
        float steepness = length(per_px);
        float per_ramp = !COVERAGE_EDGES ? 1.0 : steepness > 0.0 ? 1.0 / (steepness * PLANE_RAMP_PX) : HARD;
        // In half a ramp behind the pixel nothing is left, in half a ramp before it all. Linear along the column.
        float at_top = per_ramp * inside_px(plane, top_px, w);
        float per_row = per_ramp * per_px.y;
        float toward_plane = float(quarter_of(per_px)) + BY_PLANE;
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            float inside = at_top + per_row * float(first_row + row);
            toward[row] = inside < least[row] ? toward_plane : toward[row];
            least[row] = min(inside, least[row]);
        }
    }
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        float part = COVERAGE_EDGES ? clamp(0.5 + least[row], 0.0, 1.0) : least[row] < 0.0 ? 0.0 : 1.0;
        bool decides = part < kept[row].part;
        kept[row].part = decides ? part : kept[row].part;
        kept[row].toward = decides ? toward[row] : kept[row].toward;
    }
}

// What curves cut off `at_once` splats, which `own` of invocations from `place` on have loaded.
void cut_by_curves(uint at_once, OwnCurves own, Splat splats[AT_ONCE], uint place, bool seen, inout Kept kept[AT_ONCE][ROWS])
{
    uint most = most_curves(own, splats, at_once, place);
    if (most == 0) {
        return; // where invocations can
    }
    uint number = 0;
    do { // a CPU driver runs a body once more than a condition before it says
        [[unroll]] for (uint k = 0; k < at_once; k++) {
            cut_by(curve_of(own, splats, number, place + k), seen, kept[k]);
        }
        number++;
    } while (number < most);
}

// What curves and planes leave of splats if they are `clipped`. `seen`: only whether, by curves.
void find_kept(bool clipped, uint at_once, OwnCurves own, Splat splats[AT_ONCE], uint place, bool seen, out Kept kept[AT_ONCE][ROWS])
{
    [[unroll]] for (uint k = 0; k < at_once; k++) {
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            kept[k][row] = WHOLE;
        }
    }
    if (CLIPS && clipped) {
        cut_by_curves(at_once, own, splats, place, seen, kept);
    }
    if (CUT_BY_PLANES && clipped) {
        [[unroll]] for (uint k = 0; k < at_once; k++) {
            cut_by_planes(splats[k], kept[k]);
        }
    }
}
