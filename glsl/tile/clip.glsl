// What clip curves leave of a splat in the pixels of an invocation (inc/clip.glsl).

// The part of a pixel that a curve leaves, from 0 to 1, negative where it cuts off what is on CURVE_SIDE. COVERAGE_EDGES: f goes from half
// a ramp behind the pixel to half a ramp before it.
float kept_by(Curve curve, vec2 px)
{
    if (!COVERAGE_EDGES) {
        return keeps(curve, px) ? 1.0 : 0.0;
    }
    float behind = kept_side(curve, px, -1.0);
    float before = kept_side(curve, px, 1.0);
    float above = max(behind, 0.0) + max(before, 0.0);
    float all = abs(behind) + abs(before);
    float part = all > 0.0 ? above / all : 1.0;
    return is_told(curve.c, CURVE_SIDE) ? -part : part;
}

// 1 where nothing is cut off.
void find_kept(Splat splat, out float kept[ROWS])
{
    [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
        kept[row] = 1.0;
    }
    if (!CLIPS) {
        return;
    }
    // A loop, because a CPU driver does not jump over what no invocation is to do, but ends loops.
    uint count = is_clipped(splat) ? 2 : 0;
    for (uint number = 0; number < count; number++) {
        uint first = CLIP_VECTORS * splat.record + 3 * number;
        Curve curve = Curve(clip_record(first), clip_record(first + 1), clip_record(first + 2));
        if (!is_told(curve.c, CURVE_IS)) {
            break;
        }
        bool both = number == 1 && is_told(curve.c, CURVE_BOTH);
        [[unroll]] for (int row = 0; row < OWN_ROWS; row++) {
            float part = kept_by(curve, top_px + vec2(0.0, float(first_row + row)));
            bool decides = number == 0 || (both ? abs(part) > abs(kept[row]) : abs(part) < abs(kept[row]));
            kept[row] = decides ? part : kept[row];
        }
    }
}
