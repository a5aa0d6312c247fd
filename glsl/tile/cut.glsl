// Which tiles the curves of a clipped splat cut, found once, when it is projected: in a tile that they leave whole it is listed with splats that
// nothing cuts, in one of which they leave nothing, or where the splat itself has no pixel, not at all. By the cells of its rect.
//
// C, A and B of a curve (inc/clip.glsl) are linear in the pixel, so that their least and most in a cell are at its corners; those of f follow.
// COVERAGE_EDGES: pixels look from half a ramp behind them to half a ramp before (tile/clip.glsl). Pixels round by some 2^-23 of what the terms of a
// line are; what is told here has 8 times that to spare.

#include "tile/cells.glsl"

// The least and the most of a line.
vec2 extremes(vec4 line, Cell cell, vec2 half_ramp)
{
    float reach = dot(abs(line.xy), cell.reach_px) + abs(dot(line.xy, half_ramp));
    float terms = dot(abs(line.xy), abs(cell.middle_px) + abs(half_ramp)) + abs(line.z) + reach;
    float margin = reach + 9.5367432e-7 * terms;
    return at(line, cell.middle_px) + vec2(-margin, margin);
}

// The least and the most of f.
vec2 kept_extremes(Curve curve, Cell cell)
{
    float steepness2 = dot(curve.c.xy, curve.c.xy);
    vec2 half_ramp = COVERAGE_EDGES && steepness2 > 0.0 ? curve.c.xy / steepness2 : vec2(0.0);
    vec2 c = extremes(curve.c, cell, half_ramp);
    vec2 a = extremes(curve.a, cell, half_ramp);
    vec2 b = extremes(curve.b, cell, half_ramp);
    vec2 roots = vec2(0.9999, 1.0001) * vec2(root_of(curve, vec2(a.x, b.x)), root_of(curve, vec2(a.y, b.y)));
    return turn_of(curve) < 0.0 ? c - roots.yx : c + roots;
}

// Whether a splat's curves leave something in a cell, and whether they cut it there. What is no number is cut.
bvec2 kept_and_cut(Curve curves[2], Cell cell)
{
    vec2 first = kept_extremes(curves[0], cell);
    bvec2 is = bvec2(!(first.y < 0.0), !(first.x >= 0.0));
    if (is_told(curves[1].c, CURVE_IS)) {
        vec2 second = kept_extremes(curves[1], cell);
        bvec2 other = bvec2(!(second.y < 0.0), !(second.x >= 0.0));
        bool both = is_told(curves[1].c, CURVE_BOTH); // have to remove
        is = bvec2(both ? is.x || other.x : is.x && other.x, both ? is.y && other.y : is.y || other.y);
    }
    return is;
}

// Writes a word for each row of cells: bits of those where something of the splat is left, then of those that curves cut; or all, `cut_by_planes`.
void write_cells(uint first_word, Curve curves[2], ImageMap map, uint rect, vec2 tile_px, vec4 box_px, bool cut_by_planes)
{
    Ellipse ellipse = ellipse_of(map);
    uvec2 first = first_of(rect);
    uint shift = cell_shift(more_of(rect));
    uvec2 last = more_of(rect) >> shift;
    vec2 size_px = float(1u << shift) * tile_px;
    uvec2 at = uvec2(0);
    uint bits = 0;
    do {
        vec2 top_px = vec2(first + (at << shift)) * tile_px - frame.middle_px;
        vec2 first_px = max(top_px + 0.5, box_px.xy);
        vec2 last_px = min(top_px + size_px - 0.5, box_px.zw);
        Cell cell = Cell(0.5 * (first_px + last_px), max(0.5 * (last_px - first_px), 0.0));
        bvec2 is = kept_and_cut(curves, cell);
        bits |= is.x && !is_outside(ellipse, cell) ? 1u << at.x : 0u;
        bits |= is.y || cut_by_planes ? 1u << CELLS_ALONG + at.x : 0u;
        clip_words[first_word + at.y] = bits;
        bool ends = at.x == last.x;
        at = ends ? uvec2(0, at.y + 1) : uvec2(at.x + 1, at.y);
        bits = ends ? 0 : bits;
    } while (at.y <= last.y);
}
