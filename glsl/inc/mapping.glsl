// From a splat to the projective map between its plane and the image.
//
// Guennebaud, Barthe, Paulin: "Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based
// Rendering", PBG 2006, section 3.1. M = [s t p] maps (u, v, 1) to the image plane; any multiple of its inverse maps
// back (equations 3-5). With N = near / det * adj(M) the third coordinate is w = near / z: the reversed, infinite
// depth itself (equation 6 with a = 0, b = near), linear on the screen.
//
// Visibility shifts the splat along its projectors by f = 1 + epsilon / max(p_z, epsilon): the image is the same,
// the depth w / f stays linear.
//
// Everything that depth depends on is `precise`: the passes must find bit-equal depths, or the nearest surface would
// hide itself.

struct Mapping {
    vec3 p;              // center and tangent vectors after the filter, view space
    vec3 s;
    vec3 t;
    vec3 n0;             // t x p, p x s, s x t: the rows of adj(M)
    vec3 n1;
    vec3 n2;
    float scale;         // near / det
    float inverse_shift; // 1 / f
    vec3 normal;         // unit, view space, turned to the eye
};

// |det| / (|s x t| |p|) below which the sign of det is rounding noise: the splat is seen edge-on and has no area.
const float EDGE_ON = 2.4e-7; // 4 * 2^-24

// A shift of less than a few steps of f32 would do nothing: seen from very far, a surface would hide itself in part.
const float LEAST_SHIFT = 1e-6;

// False where nothing of the splat can be seen.
bool map_splat(uint index, out Mapping m)
{
    Splat splat = load_splat(index);
    precise vec3 p = splat.p;
    precise vec3 s = splat.s;
    precise vec3 t = splat.t;
    bool faces_away = dot(splat.normal, p) > 0.0;
    if (CULL_BACKFACES && faces_away) {
        return false;
    }
    vec3 normal = vec3(FORMULA(FORMULA_NORMAL, splat.normal.xy), splat.normal.z);
    m.normal = faces_away ? -normal : normal;

    if (FILTER_ADJUST && p.z > frame.near) {
        adjust_tangents(p, s, t);
    }
    if (p.z + sqrt(s.z * s.z + t.z * t.z) < frame.near) {
        return false; // wholly behind the near plane
    }

    precise vec3 n0 = precise_cross(t, p);
    precise vec3 n1 = precise_cross(p, s);
    precise vec3 n2 = precise_cross(s, t);
    precise float det = precise_dot(n2, p);
    if (!(abs(det) > EDGE_ON * sqrt(dot(n2, n2)) * sqrt(dot(p, p)))) {
        return false;
    }
    precise float scale = frame.near / det;
    m.p = p;
    m.s = s;
    m.t = t;
    m.n0 = n0;
    m.n1 = n1;
    m.n2 = n2;
    m.scale = scale;

    float epsilon = frame.epsilon_radii * splat.radius + frame.epsilon_length;
    float relative = epsilon > 0.0 ? max(FORMULA(FORMULA_EPSILON_SHIFT, epsilon / max(p.z, epsilon)), LEAST_SHIFT) : 0.0;
    // Exactly 1 without epsilon: a division need not be.
    m.inverse_shift = relative > 0.0 ? 1.0 / (1.0 + relative) : 1.0;
    return true;
}

// The change of (uw, vw, w) per pixel along x and y.
void per_pixel(Mapping m, out vec3 along_x, out vec3 along_y)
{
    precise float per_px = m.scale / frame.focal_px;
    vec3 rows = vec3(
        FORMULA(FORMULA_INVERSE_MAPPING_U, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_V, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_W, 1.0));
    precise vec3 x = per_px * vec3(m.n0.x, m.n1.x, m.n2.x) * rows;
    precise vec3 y = per_px * vec3(m.n0.y, m.n1.y, m.n2.y) * rows;
    along_x = x;
    along_y = y;
}

// The projected center in pixels; only for centers in front of the eye.
vec2 projected_center_px(Mapping m)
{
    precise vec2 center = m.p.xy / m.p.z * frame.focal_px + 0.5 * frame.size_px;
    return center;
}
