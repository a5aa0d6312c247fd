// What part of a pixel the splats of a surface cover (inc/edges.glsl), while they are added; COVERAGE_EDGES.
//
// CUTS: a plane that cuts what is seen is as a curve of all splats. Up to a clip curve the surface goes on as it would without it, and of what it would cover the curve leaves a part. A ridge has a
// curve on both of its sides, which cut off opposite ones, and what they leave adds up. What no curve cuts there is left, too.

#include "inc/edges.glsl"

// In tiles with so many splats that nobody looks for further surfaces behind the first, all surfaces cover. One alone has too little there: what lies around a
// pixel's middle is many epsilons deep. Of what has two sides both count.
bool all_cover = false;

float summed[ROWS];       // the sum of weights over the overlap; where that of colors is the same (has_own_sum), nothing
vec2 fall[ROWS];          // by how much the sum falls a pixel along x and y (edge_opacity)
float gap[ROWS];          // what disks by themselves leave uncovered
vec2 uncut[ROWS];         // CUTS: the same sum and gap of splats that no curve cuts in the pixel
vec4 kept_toward[ROWS];   // CUTS: of others the largest part that curves leave, by the direction in which they keep

bool has_own_sum()
{
    return CUTS || !WEIGHTED || all_cover;
}

void begin_covering(int row)
{
    summed[row] = 0.0;
    fall[row] = vec2(0.0);
    gap[row] = 1.0;
    uncut[row] = vec2(0.0, 1.0);
    kept_toward[row] = vec4(0.0);
}

// `weight`: over the overlap, as if nothing were cut off. `falls`: by how much it falls a pixel. `part`: what the splat covers by itself. `kept`: what curves leave (tile/clip.glsl).
void cover(float weight, vec2 falls, float part, float kept, int row)
{
    float left = 1.0 - clamp(part, 0.0, 1.0);
    gap[row] *= left;
    fall[row] += falls;
    if (has_own_sum()) {
        summed[row] += weight;
    }
    if (CUTS) {
        float part_kept = part_of(kept);
        bool cut = part_kept < 1.0;
        uncut[row] = cut ? uncut[row] : vec2(uncut[row].x + weight, uncut[row].y * left);
        float most = cut ? part_kept : 0.0;
        kept_toward[row] = max(kept_toward[row], mix(vec4(0.0), vec4(most), equal(vec4(toward_of(kept)), vec4(0.0, 1.0, 2.0, 3.0))));
    }
}

// Of what the surface would cover, what curves leave. Opposite directions are both sides of a ridge, and neighbors may be one side whose curves
// differ a little: those of two of four that are not opposite count once, by whichever pairs leave less.
float kept_part(int row)
{
    vec4 toward = kept_toward[row];
    vec4 pairs = max(toward, toward.yzwx);
    float kept = min(pairs.x + pairs.z, pairs.y + pairs.w);
    return CUTS && kept > 0.0 ? min(max(kept, edge_opacity(uncut[row].x, 1.0 - uncut[row].y, NOT_FLAT)), 1.0) : 1.0;
}

// The sum of weights alone, for whoever finds the opacity from it.
float covering_sum(int row)
{
    return kept_part(row) * (has_own_sum() ? summed[row] : colors[row].w);
}

// The part of the pixel that the surface covers. What hardly falls in a layer may be what an epsilon has left of it: the rest is in the next one, which does not add up.
float opacity_of(int row)
{
    float sum = has_own_sum() ? summed[row] : colors[row].w;
    float steepness = steepness_of(sum, length(fall[row]));
    return kept_part(row) * edge_opacity(sum, 1.0 - gap[row], OF_LAYERS ? max(steepness, NOT_FLAT) : steepness);
}
