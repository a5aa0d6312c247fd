// What part of a pixel the splats of a surface cover (inc/edges.glsl), while they are added; COVERAGE_EDGES.
//
// CLIPS: along a clip curve the surface is whole up to it, and so are sums of weights and own parts as they would be without it; of that the
// curve leaves a part. A ridge has a curve on both of its sides, which cut off opposite ones, and their parts of a pixel add up. So all is
// found by the side that a curve cuts off; what no curve cuts belongs to both. Splats that are clipped were fitted to a surface, whose disks
// hardly overlap: what they cover by themselves is taken for independent.

#include "inc/edges.glsl"

float summed[ROWS];   // the sum of weights over the overlap; where splats are WEIGHTED, that of colors
float own_part[ROWS]; // the most that a splat covers by itself
// CLIPS, of splats that no curve cuts, and of those that are cut on one side or on the other:
vec3 sums[ROWS];      // in place of the sum
vec3 gaps[ROWS];      // what disks by themselves leave uncovered
vec2 kept_parts[ROWS]; // the most that a curve leaves

void begin_covering(int row)
{
    summed[row] = 0.0;
    own_part[row] = 0.0;
    sums[row] = vec3(0.0);
    gaps[row] = vec3(1.0);
    kept_parts[row] = vec2(0.0);
}

// `weight`: over the overlap, as if nothing were cut off. `part`: what the splat covers by itself.
void cover(float weight, float part, bool clipped, float kept, int row)
{
    if (!CLIPS) {
        if (!WEIGHTED) {
            summed[row] += weight;
        }
        own_part[row] = max(own_part[row], part);
        return;
    }
    vec3 which = clipped ? kept < 0.0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    sums[row] += weight * which;
    gaps[row] *= 1.0 - clamp(part, 0.0, 1.0) * which;
    kept_parts[row] = max(kept_parts[row], abs(kept) * which.yz);
}

// The sum of weights alone, of what is kept.
float covering_sum(int row)
{
    return CLIPS ? sums[row].x + dot(sums[row].yz, kept_parts[row]) : summed[row];
}

// The part of the pixel that the surface covers.
float opacity_of(int row)
{
    if (!CLIPS) {
        return edge_opacity(WEIGHTED ? colors[row].w : summed[row], own_part[row]);
    }
    float unclipped = edge_opacity(sums[row].x, 1.0 - gaps[row].x);
    vec2 sides = vec2(
        edge_opacity(sums[row].x + sums[row].y, 1.0 - gaps[row].x * gaps[row].y),
        edge_opacity(sums[row].x + sums[row].z, 1.0 - gaps[row].x * gaps[row].z));
    return min(max(unclipped, dot(sides, kept_parts[row])), 1.0);
}
