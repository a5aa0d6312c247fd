// A quad for each tile that has splats.
#version 460
#include "inc/finalize.glsl"
#include "inc/tiles.glsl"

layout(set = 1, binding = 8, std430) readonly buffer SeenTiles { uint seen_tiles[]; };

void main()
{
    uint tiles_x = (uint(2.0 * push.half_size_px.x) + TILE - 1) / TILE;
    uint tile = seen_tiles[gl_InstanceIndex];
    uvec2 corner = uvec2(tile % tiles_x, tile / tiles_x) + uvec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    gl_Position = vec4(vec2(TILE * corner) / push.half_size_px - 1.0, 0.5, 1.0);
}
