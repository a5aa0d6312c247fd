// A splat as one triangle in its plane with the kernel upon it (Pajarola, Sainz, Guidotti 2003, section 5.2): the generic
// triangle around the unit disk, scaled along s and t. Projection, (u, v) and depth are the fixed-function rasterizer's.
//
// Rasterizers snap vertices to a grid, 1/256 pixel mostly. Where the disk touches a side, that would take a part of the rim:
// the triangle is larger by four such steps. Splats whose triangle would come near the eye plane are drawn as quads; so are
// those that are hardly thicker than that, as disks seen edge-on without a filter: corners and what is interpolated between them
// are rounded in pixels of the image, half a step of f32 at 64 pixels is 1e-3 of a half axis of 0.004.
//
// Limits: depth is interpolated between snapped vertices. Where it changes steeply across a pixel, as across large grazing
// disks in a telephoto view, the snapping shifts it: 2e-4 of it at a field of view of 0.5 degrees, 3e-2 at 0.1.

const float SNAP_PX = 1.0 / 64.0;
const float THINNEST_PX = 1.0 / 16.0; // the shorter half axis

// How much larger than the smallest.
float triangle_scale(Mapping m)
{
    Principal axes = principal_axes(ray_through(m.p), m.s, m.t);
    return 1.0 + SNAP_PX / (abs(axes.minor) * frame.focal_px);
}

const float LARGEST_TRIANGLE_SCALE = 1.0 + SNAP_PX / THINNEST_PX;

bool fits_triangle(Mapping m)
{
    float depth_radius = sqrt(m.s.z * m.s.z + m.t.z * m.t.z);
    float scale = triangle_scale(m);
    // Corners are 2 radii from the center. Written so that NaN and infinity don't fit.
    return m.regular && scale <= LARGEST_TRIANGLE_SCALE && (ORTHOGRAPHIC || 2.0 * scale * depth_radius <= REGULAR_DEPTH_RATIO * m.p.z);
}

vec2 triangle_corner(Mapping m, uint corner)
{
    const float root_3 = 1.7320508;
    vec2 unit = corner == 0 ? vec2(0.0, 2.0) : corner == 1 ? vec2(-root_3, -1.0) : vec2(root_3, -1.0);
    return FORMULA_LESS(FORMULA_TRIANGLE_CORNER, triangle_scale(m)) * unit;
}
