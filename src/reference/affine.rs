//! Affine maps from the image to the splat, in place of the projective one. Each makes the splat an ellipse in the
//! image whose `r²` is a quadratic form.

use glam::{DVec2, DVec3};

use super::filter::projected;

/// An ellipse in the image plane by its principal axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct ImageEllipse {
    pub center: DVec2,
    /// Unit directions, orthogonal; the long axis first.
    pub directions: [DVec2; 2],
    /// Semi-axes along them; 0 for a splat seen from its edge.
    pub lengths: [f64; 2],
}

impl ImageEllipse {
    /// Exact at the projected center (Guennebaud, Paulin 2003): `(u, v) = [a b]⁻¹ (x − c)` with `a`, `b` the
    /// tangent vectors under the Jacobian of the projection. The tangents are those of
    /// [`super::filter::orthogonalized`]: the axes then point along `s` and `t`.
    pub fn exact_at_center(center: DVec3, s: DVec3, t: DVec3) -> Self {
        let (a, b) = (projected(center, s), projected(center, t));
        let long = a.try_normalize().unwrap_or(DVec2::X);
        // The direction of b, but it exists where b vanishes too.
        let short = if long.perp_dot(b) < 0.0 { -long.perp() } else { long.perp() };
        Self {
            center: center.truncate() / center.z,
            directions: [long, short],
            lengths: [a.length(), short.dot(b)],
        }
    }

    /// The projection of the rim itself (Zwicker, Räsänen, Botsch, Dachsbacher, Pauly 2004): its dual conic is
    /// `Q = s sᵀ + t tᵀ − p pᵀ`, its center `e = Q_iz / Q_zz`, its matrix `E = e eᵀ − Q_ij / Q_zz`.
    ///
    /// That difference loses all digits for a small splat. By the theorem of Cauchy and Binet it is
    /// `(f fᵀ + g gᵀ − k kᵀ) / Q_zz²` with f, g, k the minors `s_i p_z − s_z p_i`, `t_i p_z − t_z p_i`,
    /// `s_i t_z − s_z t_i`; and `det E = det [s t p]² / |Q_zz|³`.
    pub fn exact_contour(center: DVec3, s: DVec3, t: DVec3) -> Self {
        let minor = |a: DVec3, b: DVec3| a.truncate() * b.z - b.truncate() * a.z;
        let (f, g, k) = (minor(s, center), minor(t, center), minor(s, t));
        let q_zz = s.z * s.z + t.z * t.z - center.z * center.z;
        let e = (s.truncate() * s.z + t.truncate() * t.z - center.truncate() * center.z) / q_zz;

        let entry = |i: usize, j: usize| (f[i] * f[j] + g[i] * g[j] - k[i] * k[j]) / (q_zz * q_zz);
        let (xx, xy, yy) = (entry(0, 0), entry(0, 1), entry(1, 1));
        let major = (0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)).sqrt();
        let area = s.cross(t).dot(center).abs() / q_zz.abs().powf(1.5);
        let angle_rad = 0.5 * (2.0 * xy).atan2(xx - yy);
        let long = DVec2::from_angle(angle_rad);
        Self { center: e, directions: [long, long.perp()], lengths: [major, area / major] }
    }

    /// The point in units of the semi-axes; not finite for an ellipse without width.
    pub fn uv(&self, x: DVec2) -> DVec2 {
        let delta = x - self.center;
        DVec2::new(
            self.directions[0].dot(delta) / self.lengths[0],
            self.directions[1].dot(delta) / self.lengths[1],
        )
    }
}
