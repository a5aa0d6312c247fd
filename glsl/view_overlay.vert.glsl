// What lies over the picture of a window: triangles of egui, whose vertices are fetched by their indices.
#version 460

struct OverlayVertex
{
    // In points from the top left corner; in the atlas, from 0 to 1; red, green, blue, alpha of 8 bits, sRGB times alpha.
    float x, y, u, v;
    uint color;
};

layout(std430, set = 0, binding = 0) readonly buffer Vertices { OverlayVertex vertices[]; };
layout(std430, set = 0, binding = 1) readonly buffer Indices { uint indices[]; };

layout(push_constant) uniform Overlay
{
    vec2 window_points;
    ivec2 atlas_px;
};

layout(location = 0) out vec2 atlas_uv;
layout(location = 1) out vec4 tint;

void main()
{
    OverlayVertex corner = vertices[indices[gl_VertexIndex]];
    atlas_uv = vec2(corner.u, corner.v);
    tint = unpackUnorm4x8(corner.color);
    gl_Position = vec4(2.0 * vec2(corner.x, corner.y) / window_points - 1.0, 0.0, 1.0);
}
