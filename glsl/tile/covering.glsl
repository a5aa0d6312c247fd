// What part of a pixel the splats of a surface cover (inc/edges.glsl), while they are added; COVERAGE_EDGES.
//
// CUTS: a plane that cuts what is seen is as a curve of all splats. Up to a clip curve the surface goes on as it would without it, and of what it would cover the curve leaves a part: the mean
// over the splats that are cut, by their weights, since a line that goes on beyond its splat leaves too much around a bend. A ridge has a
// curve on both of its sides, which cut off opposite ones, and what they leave adds up. What no curve cuts there is left, too.

#include "inc/edges.glsl"
#include "inc/outlined.glsl"

const bool OUTLINED = COVERAGE_EDGES && CURVED && !BLENDED && !OF_LAYERS; // their alphas tell how surely surfaces go on

// Behind the last surface that a tile looks for all that is left covers with it, of both sides: else the background would be seen through it. In tiles with so many splats that the first
// is the last one it would have too little alone: what lies around a pixel's middle is many epsilons deep.
bool all_cover = false;

float summed[ROWS];       // the sum of weights over the overlap; where that of colors is the same (has_own_sum), nothing
vec2 fall[ROWS];          // by how much the sum falls a pixel along x and y (edge_opacity)
float gap[ROWS];          // what disks by themselves leave uncovered
float outlined[ROWS];     // OUTLINED: what ellipses cover that no filter has widened
float border[ROWS];       // REACHES: of disks at a border, which don't count there, the largest argument of Phi
vec3 uncut[ROWS];         // CUTS: the same sum, gap and argument of splats that no curve cuts in the pixel
vec4 cut_toward[ROWS];    // CUTS: the sum of others, by the direction in which curves keep,
vec4 kept_toward[ROWS];   // and of what these leave of them

bool has_own_sum()
{
    return CUTS || !WEIGHTED || all_cover;
}

// What is cut off by less than one in so many counts as cut and as not cut in part, so that nothing changes by a step.
const float CUT_BELOW = 32.0;

void begin_covering(int row)
{
    summed[row] = 0.0;
    fall[row] = vec2(0.0);
    gap[row] = 1.0;
    outlined[row] = 0.0;
    border[row] = NO_BORDER;
    uncut[row] = vec3(0.0, 1.0, NO_BORDER);
    cut_toward[row] = vec4(0.0);
    kept_toward[row] = vec4(0.0);
}

// `weight`: over the overlap, as if nothing were cut off. `falls`: by how much it falls a pixel. `part`: what the splat covers by itself; of one `at_border`, the argument of Phi. `own_ellipse`: and as no filter has widened it. `kept`: what curves leave (tile/clip.glsl).
void cover(float weight, vec2 falls, float part, bool at_border, float own_ellipse, Kept kept, int row)
{
    float left = REACHES && at_border ? 1.0 : 1.0 - clamp(part, 0.0, 1.0);
    float of_border = REACHES && at_border ? part : NO_BORDER;
    if (OUTLINED) {
        outlined[row] += own_ellipse;
    }
    gap[row] *= left;
    if (REACHES) {
        border[row] = max(border[row], of_border);
    }
    fall[row] += falls;
    if (has_own_sum()) {
        summed[row] += weight;
    }
    if (CUTS) {
        float whole = clamp(CUT_BELOW * kept.part - (CUT_BELOW - 1.0), 0.0, 1.0);
        uncut[row] = vec3(uncut[row].x + whole * weight, uncut[row].y * mix(1.0, left, whole), whole > 0.0 ? max(uncut[row].z, of_border) : uncut[row].z);
        vec4 toward = mix(vec4(0.0), vec4(weight - whole * weight), equal(vec4(kept.toward < BY_PLANE ? kept.toward : kept.toward - BY_PLANE), vec4(0.0, 1.0, 2.0, 3.0)));
        cut_toward[row] += toward;
        kept_toward[row] += kept.part * toward;
    }
}

// What splats leave uncovered by themselves, and with the sum of what their own ellipses cover.
float gap_of(int row)
{
    return OUTLINED ? min(gap[row], max(1.0 - outlined[row], 0.0)) : gap[row];
}

// Of what the surface would cover, what curves leave. Opposite directions are both sides of a ridge, and neighbors may be one side whose curves
// differ a little: those of two of four that are not opposite count once, by whichever pairs leave less.
float kept_part(int row)
{
    vec4 pairs = (kept_toward[row] + kept_toward[row].yzwx) / max(cut_toward[row] + cut_toward[row].yzwx, 1e-20);
    float kept = min(pairs.x + pairs.z, pairs.y + pairs.w);
    return CUTS && kept > 0.0 ? min(max(kept, edge_opacity(uncut[row].x, own_of(uncut[row].y, uncut[row].z), NOT_FLAT)), 1.0) : 1.0;
}

// The sum of weights alone, for whoever finds the opacity from it.
float covering_sum(int row)
{
    return kept_part(row) * (has_own_sum() ? summed[row] : colors[row].w);
}

// The part of the pixel that the surface covers. What hardly falls in a layer may be what an epsilon has left of it: the rest is in the next one, which does not add up (unless it goes on: tile/stack.glsl).
float opacity_of(int row)
{
    float sum = has_own_sum() ? summed[row] : colors[row].w;
    float steepness = steepness_of(sum, length(fall[row]));
    return kept_part(row) * edge_opacity(sum, own_of(gap_of(row), border[row]), OF_LAYERS && !CURVED ? max(steepness, NOT_FLAT) : steepness);
}
