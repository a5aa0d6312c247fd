// Workgroups are numbered along rows, for a device need not take more than 65535 in one dimension. Rows are as short as their
// number allows: on a CPU driver a workgroup behind the last one costs as much as any.
#include "inc/config.glsl"

#define GROUP_NUMBER (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)

// So many workgroups, in rows; none of none.
uvec2 rows_of_groups(uint groups)
{
    uint rows = (groups + MOST_GROUPS_IN_ROW - 1) / MOST_GROUPS_IN_ROW;
    return uvec2(rows > 0 ? (groups + rows - 1) / rows : 0, rows);
}
