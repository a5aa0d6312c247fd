// Which cells of a mesh are drawn as polygons: those whose splats would be larger on the screen than tau (inc/levels.glsl), and those that meet such a cell, whose splats sum to less toward
// it; but for those outside of the view. For each the arguments of its draw, of one instance or none.
//
// Outside: a ball in the mesh's local space holds the cell. Its image reaches R sqrt(1 + c^2) / (p_z - R) from the middle's c: 4/3 R (1 + |c|) / p_z at most
// where R <= p_z / 4, for which inc/outside.glsl takes `reach` as 2 R.
#version 460
#include "inc/perturb.glsl"
#include "inc/frame.glsl"
#include "inc/view.glsl"
#include "inc/variant.glsl"
#include "inc/list.glsl"
#define LEVELS_BINDING BIND_SPLATS_CELLS
#include "inc/levels.glsl"
#include "inc/outside.glsl"

layout(local_size_x = LIST_GROUP_SIZE) in;

layout(set = 1, binding = BIND_LIST_ARGUMENTS, std430) writeonly buffer Arguments { uint arguments[]; };

#define CELLS frame.splat_count
#define DRAW_WORDS 5

void main()
{
    uint cell = LIST_INVOCATION;
    if (cell >= CELLS) {
        return;
    }
    uint at = CELL_WORDS * cell;
    LevelView view = level_view();
    bool drawn = false;
    for (uint ball = floatBitsToUint(levels[at + 6]); ball < floatBitsToUint(levels[at + 7]); ball += BALL_FLOATS) {
        drawn = drawn || !is_small(view, view.share, ball);
    }
    vec3 translation = vec3(frame.view_from_local_x.w, frame.view_from_local_y.w, frame.view_from_local_z.w);
    vec3 center = frame.view_from_local_scale * rotated(vec3(levels[at + 2], levels[at + 3], levels[at + 4])) + translation;
    float reach = 2.0 * frame.view_from_local_scale * levels[at + 5];
    drawn = drawn && !is_outside(center, reach, uvec2(0, 0xffffu));
    uint draw = DRAW_WORDS * (frame.first_record + cell);
    arguments[draw] = floatBitsToUint(levels[at + 1]);
    arguments[draw + 1] = drawn ? 1 : 0;
    arguments[draw + 2] = floatBitsToUint(levels[at]);
    arguments[draw + 3] = 0;
    arguments[draw + 4] = 0;
}
