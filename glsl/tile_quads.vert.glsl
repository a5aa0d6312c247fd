// A quad for each run of tiles that have splats, along a row.
#version 460
#include "inc/config.glsl"
#include "inc/finalize.glsl"

layout(set = 1, binding = BIND_RUNS, std430) readonly buffer TileRuns { uvec2 tile_runs[]; };

void main()
{
    uint tiles_x = (uint(2.0 * push.half_size_px.x) + TILE_WIDTH - 1) / TILE_WIDTH;
    uvec2 run = tile_runs[gl_InstanceIndex];
    uvec2 corner = uvec2(run.x % tiles_x, run.x / tiles_x) + uvec2((gl_VertexIndex & 1) * run.y, gl_VertexIndex >> 1);
    gl_Position = vec4(vec2(uvec2(TILE_WIDTH, push.tile_height) * corner) / push.half_size_px - 1.0, 0.5, 1.0);
}
