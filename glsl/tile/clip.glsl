// What clip curves leave of a splat in the pixels of an invocation (inc/clip.glsl).

// The part of a pixel that a curve leaves, from 0 to 1; COVERAGE_EDGES: plus twice the number of the direction in which it keeps, and f goes
// from half a ramp behind the pixel to half a ramp before it.
float kept_by(Curve curve, vec2 px)
{
    if (!COVERAGE_EDGES) {
        return keeps(curve, px) ? 1.0 : 0.0;
    }
    float steepness2 = dot(curve.c.xy, curve.c.xy);
    vec2 half_ramp = steepness2 > 0.0 ? curve.c.xy / steepness2 : vec2(0.0);
    float behind = kept_side(curve, px - half_ramp);
    float before = kept_side(curve, px + half_ramp);
    float above = max(behind, 0.0) + max(before, 0.0);
    float all = abs(behind) + abs(before);
    return (all > 0.0 ? above / all : 1.0) + 2.0 * float(uint(curve.c.w) / CURVE_TOWARD);
}

// What the curve leaves, where it is less than what is left, or of a second one, which both have to remove, more.
void cut_by(Curve curve, inout float kept[ROWS])
{
    bool is = is_told(curve.c, CURVE_IS);
    bool both = is_told(curve.c, CURVE_BOTH);
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        float part = kept_by(curve, top_px + vec2(0.0, float(first_row + row)));
        bool decides = is && (both ? part_of(part) > part_of(kept[row]) : part_of(part) < part_of(kept[row]));
        kept[row] = decides ? part : kept[row];
    }
}

void keep_all(out float kept[AT_ONCE][ROWS])
{
    [[unroll]] for (uint k = 0; k < AT_ONCE; k++) {
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            kept[k][row] = 1.0;
        }
    }
}

// What curves leave of splats, which `own` of invocations from `place` on have loaded; 1 where nothing is cut off.
void find_kept(Splat own, Splat splats[AT_ONCE], uint place, out float kept[AT_ONCE][ROWS])
{
    keep_all(kept);
    uint most = most_curves(own, splats);
    if (most == 0) {
        return; // where invocations can
    }
    uint number = 0;
    do { // a CPU driver runs a body once more than a condition before it says
        Curve own_curve = load_curve(own, splats, number);
        [[unroll]] for (uint k = 0; k < AT_ONCE; k++) {
            cut_by(broadcast(own_curve, place + k), kept[k]);
        }
        number++;
    } while (number < most);
}
