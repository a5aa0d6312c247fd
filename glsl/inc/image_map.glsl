// From pixels to a splat's plane: (uw, vw, w) as linear functions of the pixel, expanded about some point x0 of the image.
// Where the map is affine, (u, v) themselves are linear, and w, the depth, is a third linear function.
//
// perspective        N = near / det adj(M), about the projected center, where it is (0, 0, near / p_z) exactly: half the
//                    error of the paper's form in f32, at every size.
// perspective-paper  the same, about the middle of the image: N (x, y, 1), Guennebaud et al. 2006, equation 4.
// affine-center      (u, v) = [J s, J t]^-1 (x - c), J the Jacobian of the projection at the center (Guennebaud, Paulin:
//                    "Efficient screen space approach for hardware accelerated surfel rendering", VMV 2003).
// affine-contour     the ellipse that is the disk's image, affinely: its rim is exact, its inside is not (Zwicker et al.:
//                    "Perspective accurate splatting", GI 2004). With Q = ss' + tt' - pp' the ellipse has its middle at
//                    e_i = Q_iz / Q_zz and the matrix E_ij = e_i e_j - Q_ij / Q_zz. Written with the adjugate's rows and
//                    d = Q_zz nothing cancels: E_xx = (n0y^2 + n1y^2 - n2y^2) / d^2 and so on, det E = det^2 / |d|^3.
// ewa                the low-pass filter's covariance added to that of the affine image (Zwicker, Pfister, van Baar, Gross:
//                    "Surface splatting", SIGGRAPH 2001): every half axis l becomes sqrt(l^2 + h^2), the weight falls by
//                    the ratio of the areas. Depth is stretched with the disk: w at the unstretched point, so that it
//                    never leaves the disk's own range.
//
// An orthographic camera's map is affine, for every splat; of it there is one.
//
// Limits: the affine ones are for regular splats; others are mapped projectively.

struct ImageMap {
    vec2 x0_px;   // from the middle of the image
    vec3 at_x0;   // (uw, vw, w), or (u, v, w) where the map is affine
    vec3 along_x; // their change per pixel
    vec3 along_y;
    bool affine;
};

ImageMap projective_map(Mapping m, vec2 x0_px, vec3 at_x0)
{
    float per_px = m.scale / frame.focal_px;
    vec3 rows = vec3(
        FORMULA(FORMULA_INVERSE_MAPPING_U, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_V, 1.0),
        FORMULA(FORMULA_INVERSE_MAPPING_W, 1.0));
    vec3 x = per_px * vec3(m.n0.x, m.n1.x, m.n2.x) * rows;
    vec3 y = per_px * vec3(m.n0.y, m.n1.y, m.n2.y) * rows;
    return ImageMap(x0_px, at_x0, x, y, false);
}

// Expanded about a point that is not the center. `near_center`: what is seen of the splat is near its center; w comes from n2 there, too,
// and must be wrong by the same factor as its own scale, which then cancels. Else the scale itself is better.
ImageMap projective_map_about(Mapping m, vec2 x0_px, bool near_center)
{
    vec3 x0 = vec3(x0_px / frame.focal_px, 1.0);
    if (near_center) {
        m.scale = m.near / precise_dot(m.n2, m.p);
    }
    vec3 at_x0 = m.scale * vec3(precise_dot(m.n0, x0), precise_dot(m.n1, x0), precise_dot(m.n2, x0));
    return projective_map(m, x0_px, FORMULA(FORMULA_ELSEWHERE_CONSTANTS, at_x0));
}

// A map under which no pixel lies in the disk: that of a disk seen edge-on, whose filter alone is drawn.
const float NEVER_INSIDE = 1e6;

ImageMap projective_map_about_center(Mapping m)
{
    vec2 x0_px = FORMULA(FORMULA_EXPANSION_POINT, projected_center_px(m));
    float w0 = FORMULA(FORMULA_CENTER_CONSTANTS, center_depth(m));
    if (FILTER == FILTER_MAX && m.edge_on) {
        return ImageMap(x0_px, vec3(0.0, 0.0, w0), vec3(NEVER_INSIDE, 0.0, 0.0), vec3(0.0, NEVER_INSIDE, 0.0), true);
    }
    return projective_map(m, x0_px, vec3(0.0, 0.0, w0));
}

// Of an orthographic camera, about a point: what is far from the center's image loses no digits in its own pixels.
ImageMap orthographic_map_about(Mapping m, vec2 x0_px)
{
    float w0 = FORMULA(FORMULA_CENTER_CONSTANTS, center_depth(m));
    if (m.edge_on) {
        // FILTER_MAX
        return ImageMap(projected_center_px(m), vec3(0.0, 0.0, w0), vec3(NEVER_INSIDE, 0.0, 0.0), vec3(0.0, NEVER_INSIDE, 0.0), true);
    }
    // The third row of the inverse is by how much less deep the plane gets.
    m.n2.xy /= m.near;
    ImageMap map = projective_map(m, x0_px, vec3(0.0, 0.0, w0));
    map.affine = true;
    vec2 d = x0_px - projected_center_px(m);
    vec3 at_x0 = map.at_x0 + (map.along_x * d.x + map.along_y * d.y);
    map.at_x0 = at_x0;
    return map;
}

ImageMap affine_center_map(Mapping m)
{
    // At the center (u, v) change as (uw, vw) / w does.
    ImageMap map = projective_map_about_center(m);
    float z_over_near = FORMULA(FORMULA_AFFINE_MAP, m.p.z / m.near);
    vec2 uv_x = map.along_x.xy * z_over_near;
    vec2 uv_y = map.along_y.xy * z_over_near;
    map.along_x.xy = uv_x;
    map.along_y.xy = uv_y;
    map.affine = true;
    return map;
}

// The ellipse that is the image of a regular disk: middle and matrix, image plane.
struct Contour {
    vec2 e;
    float xx;
    float xy;
    float yy;
    float root_det; // sqrt(det E)
};

Contour contour_of(Mapping m)
{
    float d = m.s.z * m.s.z + m.t.z * m.t.z - m.p.z * m.p.z;
    Contour contour;
    contour.e = FORMULA(FORMULA_BOX_CENTER, (m.s.xy * m.s.z + m.t.xy * m.t.z - m.p.xy * m.p.z) / d);
    vec2 squared = (m.n0.yx * m.n0.yx + m.n1.yx * m.n1.yx - m.n2.yx * m.n2.yx) / (d * d);
    contour.xx = squared.x;
    contour.yy = squared.y;
    contour.xy = FORMULA(FORMULA_CONTOUR, -(m.n0.x * m.n0.y + m.n1.x * m.n1.y - m.n2.x * m.n2.y) / (d * d));
    contour.root_det = abs(precise_dot(m.n2, m.p)) / (-d * sqrt(-d));
    return contour;
}

// The depth at the ellipse's middle: of the plane, from the center's.
float depth_at_middle(Mapping m, vec2 e, vec2 gradient)
{
    float w = FORMULA(FORMULA_CENTER_CONSTANTS, m.near / m.p.z) + dot(gradient, e - m.p.xy / m.p.z);
    return w;
}

ImageMap affine_contour_map(Mapping m)
{
    Contour contour = contour_of(m);
    // Cholesky: r^2 = dx^2 / E_xx + (dy - dx E_xy / E_xx)^2 E_xx / det E.
    float root_xx = sqrt(contour.xx);
    float v_y = FORMULA(FORMULA_AFFINE_MAP, root_xx / contour.root_det);
    float v_x = -v_y * contour.xy / contour.xx;
    vec2 gradient = m.scale * m.n2.xy;
    ImageMap map;
    map.x0_px = FORMULA(FORMULA_EXPANSION_POINT, contour.e * frame.focal_px);
    map.at_x0 = vec3(0.0, 0.0, depth_at_middle(m, contour.e, gradient));
    float per_px = 1.0 / frame.focal_px;
    vec3 x = per_px * vec3(FORMULA(FORMULA_AFFINE_MAP, 1.0 / root_xx), v_x, gradient.x);
    vec3 y = per_px * vec3(0.0, v_y, gradient.y);
    map.along_x = x;
    map.along_y = y;
    map.affine = true;
    return map;
}

// What the filter `ewa` makes of an ellipse.
struct Stretched {
    vec2 middle;       // image plane
    vec2 direction;    // unit, of the longer axis
    vec2 half_axes;    // image plane, stretched
    vec2 along_axes;   // change of w from the middle to the end of each axis
    float w;           // at the middle
    float share;       // of the weight
};

Stretched stretched(Mapping m)
{
    Stretched ewa;
    vec2 half_axes;
    if (RASTERIZER == RASTERIZER_AFFINE_CONTOUR && !m.edge_on) {
        Contour contour = contour_of(m);
        // In units of the larger, so that no fourth power of a length underflows.
        float unit = max(max(contour.xx, contour.yy), TINY);
        float difference = (contour.xx - contour.yy) / unit;
        float xy = contour.xy / unit;
        float spread = sqrt(difference * difference + 4.0 * xy * xy);
        half_axes.x = sqrt(0.5 * (contour.xx + contour.yy + spread * unit));
        half_axes.y = contour.root_det / half_axes.x;
        float cosine = 1.0;
        float sine = 0.0;
        if (spread > 0.0) {
            float larger = sqrt(0.5 + 0.5 * abs(difference) / spread);
            float smaller = FORMULA(FORMULA_FILTER_ROTATION, abs(xy) / (spread * larger));
            cosine = difference >= 0.0 ? larger : smaller;
            sine = difference >= 0.0 ? smaller : larger;
            sine = contour.xy < 0.0 ? -sine : sine;
        }
        ewa.middle = contour.e;
        ewa.direction = vec2(cosine, sine);
        vec2 gradient = m.scale * m.n2.xy;
        ewa.w = depth_at_middle(m, contour.e, gradient);
        ewa.along_axes = half_axes * vec2(dot(gradient, ewa.direction), dot(gradient, vec2(-sine, cosine)));
    } else {
        Principal axes = principal_axes(ray_through(m.p), m.s, m.t);
        half_axes = vec2(axes.major, abs(axes.minor));
        ewa.middle = projected_center(m);
        ewa.direction = axes.direction;
        ewa.w = FORMULA(FORMULA_CENTER_CONSTANTS, center_depth(m));
        float s_z = m.s.z * axes.cosine + m.t.z * axes.sine;
        float t_z = m.t.z * axes.cosine - m.s.z * axes.sine;
        ewa.along_axes = FORMULA(FORMULA_INVERSE_MAPPING_W, ORTHOGRAPHIC ? -1.0 / m.near : -ewa.w / m.p.z) * vec2(s_z, axes.minor < 0.0 ? -t_z : t_z);
    }
    float h = FORMULA(FORMULA_FILTER_RADIUS, frame.filter_radius);
    ewa.half_axes = sqrt(half_axes * half_axes + h * h);
    vec2 shares = half_axes / ewa.half_axes;
    ewa.share = FORMULA(FORMULA_SHARE, max(shares.x * shares.y, LEAST_SHARE));
    return ewa;
}

ImageMap ewa_map(Stretched ewa)
{
    ImageMap map;
    map.x0_px = FORMULA(FORMULA_EXPANSION_POINT, ewa.middle * frame.focal_px);
    map.at_x0 = vec3(0.0, 0.0, ewa.w);
    vec2 per_px = FORMULA(FORMULA_AFFINE_MAP, 1.0 / (ewa.half_axes * frame.focal_px));
    vec2 x = per_px * vec2(ewa.direction.x, -ewa.direction.y);
    vec2 y = per_px * vec2(ewa.direction.y, ewa.direction.x);
    float w_x = dot(ewa.along_axes, x);
    float w_y = dot(ewa.along_axes, y);
    map.along_x = vec3(x, w_x);
    map.along_y = vec3(y, w_y);
    map.affine = true;
    return map;
}

// Of a regular splat.
ImageMap regular_map(Mapping m)
{
    if (FILTER == FILTER_EWA) {
        return ewa_map(stretched(m));
    }
    if (ORTHOGRAPHIC) {
        return orthographic_map_about(m, FORMULA(FORMULA_EXPANSION_POINT, projected_center_px(m)));
    }
    if (m.edge_on) {
        return projective_map_about_center(m);
    }
    switch (RASTERIZER) {
    case RASTERIZER_PERSPECTIVE_PAPER: return projective_map_about(m, vec2(0.0), true);
    case RASTERIZER_AFFINE_CENTER: return affine_center_map(m);
    case RASTERIZER_AFFINE_CONTOUR: return affine_contour_map(m);
    default: return projective_map_about_center(m);
    }
}

// Of its weight, the part that the filter leaves to a splat.
float share_of(Mapping m)
{
    float share = 1.0;
    if (FILTER == FILTER_EWA && m.regular) {
        share = stretched(m).share;
    } else if (WEIGHT_BY_AREA || COVERAGE_EDGES) {
        share = m.share;
    }
    return share;
}
