//! The plane through points by least squares.

use glam::{DMat3, DVec3};

use crate::geometry::eigen::{eigen, flat};

/// Thickness over width (standard deviations) up to which neighbors are flat. On a sphere the 12 are, if their reach is below
/// 4/5 of its radius.
pub(super) const FLAT: f64 = 0.2;

/// Width over length below which they are a line.
pub(super) const LINE: f64 = 0.1;

/// A plane through points, of which one is at 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The mean of the points.
    pub mean: DVec3,
    /// Unit; the side means nothing.
    pub normal: DVec3,
    /// Thickness over width, 0 to 1.
    pub thickness: f64,
    /// Width over length, 0 to 1.
    pub width: f64,
    /// The nearest neighbors lay on a line, so that farther ones were looked at.
    pub along_line: bool,
}

impl Plane {
    /// Those that were looked at farther away lie on the line, too.
    pub(super) fn is_line(&self) -> bool {
        self.along_line && self.width < LINE
    }

    /// Through 0 and the offsets that `part` takes.
    pub(super) fn fit(offsets: &[DVec3], part: impl Fn(DVec3) -> bool) -> Self {
        let (mut sum, mut count) = (DVec3::ZERO, 1.0);
        let [mut xx, mut xy, mut xz, mut yy, mut yz, mut zz] = [0.0; 6];
        for &o in offsets.iter().filter(|o| part(**o)) {
            sum += o;
            count += 1.0;
            xx += o.x * o.x;
            xy += o.x * o.y;
            xz += o.x * o.z;
            yy += o.y * o.y;
            yz += o.y * o.z;
            zz += o.z * o.z;
        }
        Self::of_sums(count, sum, [xx, xy, xz, yy, yz, zz])
    }

    /// Of so many points with these sums of coordinates and of their products xx, xy, xz, yy, yz and zz.
    pub(super) fn of_sums(count: f64, sum: DVec3, [xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Self {
        let m = sum / count;
        let [xx, xy, xz] = [xx - m.x * sum.x, xy - m.x * sum.y, xz - m.x * sum.z];
        let [yy, yz, zz] = [yy - m.y * sum.y, yz - m.y * sum.z, zz - m.z * sum.z];
        let covariance = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let covariance = DMat3::from_cols_array_2d(&covariance);
        let ratio = |a: f64, b: f64| (a.max(0.0) / b).sqrt();
        if let Some(([least, middle, most], normal)) = flat(&covariance) {
            let (thickness, width) = (ratio(least, middle), ratio(middle, most));
            return Self { mean: m, normal, thickness, width, along_line: false };
        }
        let ([least, middle, most], [normal, _, along]) = eigen(&covariance);
        // Rounding leaves that much of a line's width; NaN, where squares overflow, is none.
        let has_width = middle > 1e-14 * most;
        if !has_width {
            let normal = across(along, most > 0.0);
            return Self { mean: m, normal, thickness: 0.0, width: 0.0, along_line: false };
        }
        let (thickness, width) = (ratio(least, middle), ratio(middle, most));
        Self { mean: m, normal, thickness, width, along_line: false }
    }
}

/// Of the directions across a line that which points most to +z, where a camera looks from; +z where there is no line.
fn across(along: DVec3, is_line: bool) -> DVec3 {
    if !is_line {
        return DVec3::Z;
    }
    let toward = |axis: DVec3| (axis - along * along.dot(axis)).try_normalize();
    let near_z = along.z.abs() > 0.9;
    toward(if near_z { DVec3::X } else { DVec3::Z }).unwrap_or(DVec3::Z)
}
