// Splat setup: from a splat to the linear functions that its fragments evaluate, and the pixels that they may cover.
//
// Guennebaud, Barthe, Paulin: "Splat/Mesh Blending, Perspective Rasterization and Transparency for Point-Based
// Rendering", PBG 2006, section 3.1. M = [s t p] maps (u, v, 1) to the image plane; any multiple of its inverse maps
// back (equations 3-5). With N = near / det * adj(M) the third coordinate is w = near / z: the reversed, infinite
// depth itself (equation 6 with a = 0, b = near), linear on the screen.
//
// (uw, vw, w) is expanded about x0: constants + du * dx + dv * dy. Where x0 is the projected center the constants
// are (0, 0, near / p_z) exactly, which halves the error of the paper's N (x, y, 1) in f32. That is singular for a
// center near the eye plane, so it holds only if the projected center lies inside the box, clamped to the viewport;
// else x0 is the box's middle.
//
// Visibility shifts the splat along its projectors by f = 1 + epsilon / max(p_z, epsilon): the image is the same,
// the depth w / f stays linear.
//
// Everything that depth depends on is `precise`: the passes must find bit-equal depths, or the nearest surface would
// hide itself.

struct Setup {
    ivec2 lo_px;       // the pixels that the splat may cover, inclusive; within the viewport
    ivec2 hi_px;
    vec2 x0_px;        // the expansion point
    vec3 constants;    // (uw, vw, w) there
    vec3 per_px_x;     // its change along x, per pixel
    vec3 per_px_y;
    float inverse_shift; // 1 / f
    vec3 normal;       // unit, view space, turned to the eye
};

// |det| / (|s x t| |p|) below which the sign of det is rounding noise: the splat is seen edge-on and has no area.
const float EDGE_ON = 2.4e-7; // 4 * 2^-24
// The box is enlarged by this much, which exceeds its own rounding; pixels are counted by their centers, so points
// and quads end on pixel borders, half a pixel from the nearest center: no subpixel rounding can lose one.
const float BOX_MARGIN_PX = 1.0 / 256.0;

bool set_up(uint index, out Setup o)
{
    Splat splat = load_splat(index);
    precise vec3 p = splat.p;
    precise vec3 s = splat.s;
    precise vec3 t = splat.t;
    bool faces_away = dot(splat.normal, p) > 0.0;
    if (CULL_BACKFACES && faces_away) {
        return false;
    }
    o.normal = vec3(FORMULA(FORMULA_NORMAL, splat.normal.xy), splat.normal.z);
    o.normal = faces_away ? -o.normal : o.normal;

    if (FILTER_ADJUST && p.z > frame.near) {
        adjust_tangents(p, s, t);
    }
    if (p.z + sqrt(s.z * s.z + t.z * t.z) < frame.near) {
        return false; // wholly behind the near plane
    }

    precise vec3 n0 = cross(t, p);
    precise vec3 n1 = cross(p, s);
    precise vec3 n2 = cross(s, t);
    precise float det = dot(n2, p);
    if (!(abs(det) > EDGE_ON * sqrt(dot(n2, n2)) * sqrt(dot(p, p)))) {
        return false;
    }

    Box box = image_box(p, s, t, n0, n1, n2);
    vec2 half_px = 0.5 * frame.size_px;
    vec2 lo = clamp(box.lo * frame.focal_px + (half_px - BOX_MARGIN_PX), vec2(0.0), frame.size_px);
    vec2 hi = clamp(box.hi * frame.focal_px + (half_px + BOX_MARGIN_PX), vec2(0.0), frame.size_px);
    o.lo_px = ivec2(ceil(lo - 0.5));
    o.hi_px = ivec2(floor(hi - 0.5));
    if (any(greaterThan(o.lo_px, o.hi_px))) {
        return false; // no pixel center inside
    }

    precise float scale = frame.near / det;
    precise vec2 projected_px = p.xy / p.z * frame.focal_px + half_px;
    bool center_inside =
        p.z > frame.near && all(greaterThanEqual(projected_px, lo)) && all(lessThanEqual(projected_px, hi));
    precise vec2 x0_px = center_inside ? FORMULA(FORMULA_EXPANSION_POINT, projected_px) : 0.5 * (lo + hi);
    precise vec3 constants;
    if (center_inside) {
        constants = FORMULA(FORMULA_CENTER_CONSTANTS, vec3(0.0, 0.0, frame.near / p.z));
    } else {
        precise vec3 x0 = vec3((x0_px - half_px) / frame.focal_px, 1.0);
        constants = FORMULA(FORMULA_ELSEWHERE_CONSTANTS, scale * vec3(dot(n0, x0), dot(n1, x0), dot(n2, x0)));
    }
    precise float per_px = scale / frame.focal_px;
    vec3 rows = vec3(
        FORMULA(FORMULA_INVERSE_MAPPING_U, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_V, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_W, 1.0));
    precise vec3 per_px_x = per_px * vec3(n0.x, n1.x, n2.x) * rows;
    precise vec3 per_px_y = per_px * vec3(n0.y, n1.y, n2.y) * rows;
    o.x0_px = x0_px;
    o.constants = constants;
    o.per_px_x = per_px_x;
    o.per_px_y = per_px_y;

    float epsilon = frame.epsilon_radii * splat.radius + frame.epsilon_length;
    float shift = epsilon > 0.0 ? 1.0 + FORMULA(FORMULA_EPSILON_SHIFT, epsilon / max(p.z, epsilon)) : 1.0;
    o.inverse_shift = 1.0 / shift;
    return true;
}

// The side of the square of pixels around the box, in pixels.
float point_size_px(Setup o)
{
    ivec2 size = o.hi_px - o.lo_px + 1;
    return float(max(size.x, size.y));
}
