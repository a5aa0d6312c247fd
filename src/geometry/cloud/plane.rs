//! The tangent plane at a point from its neighbors.
//!
//! **The rule.** The plane is that of least squares through the point and its nearest [`NEIGHBORS`], by their covariance about
//! their mean. Where they are not flat the neighborhood grows to [`MOST_NEIGHBORS`], if it becomes flatter by that: noise has
//! a thickness of its own, which matters less the wider the neighborhood, while an edge looks the same at any width. Where it
//! does not, at edges and between the two sides of a thin plate, the sheet is chosen that has most of the neighbors: of all
//! planes through the point and two of its 6 nearest, that with the least sum of squared distances, each cut off at
//! [`ON_SHEET`]; only those nearer than that are fitted.
//!
//! Neighbors all on a line, as on scan lines that lie far apart, grow, too.

use glam::{DMat3, DVec3};

use crate::geometry::eigen::eigen;

/// How many neighbors make a plane.
pub(super) const NEIGHBORS: usize = 12;

/// How many make one where those are not flat.
pub(super) const MOST_NEIGHBORS: usize = 48;

/// Thickness over width (standard deviations) up to which neighbors are flat. On a sphere the 12 are, if their reach is below
/// 4/5 of its radius.
pub(super) const FLAT: f64 = 0.2;

/// Width over length below which they are a line.
const LINE: f64 = 0.1;

/// How much flatter a wider neighborhood must be. Four times the points of a noisy plane are twice as wide and as thick.
const FLATTER: f64 = 0.7;

/// How far from a sheet's plane its points may be, in distances of the 6th neighbor.
const ON_SHEET: f64 = 0.15;

/// The fewest points of a sheet, the point itself among them.
const FEWEST_ON_SHEET: usize = 5;

/// A plane through points, of which one is at 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
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
        let m = sum / count;
        let [xx, xy, xz] = [xx - m.x * sum.x, xy - m.x * sum.y, xz - m.x * sum.z];
        let [yy, yz, zz] = [yy - m.y * sum.y, yz - m.y * sum.z, zz - m.z * sum.z];
        let covariance = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let ([least, middle, most], [normal, _, along]) = eigen(&DMat3::from_cols_array_2d(&covariance));
        // Rounding leaves that much of a line's width; NaN, where squares overflow, is none.
        let has_width = middle > 1e-14 * most;
        if !has_width {
            return Self { normal: across(along, most > 0.0), thickness: 0.0, width: 0.0, along_line: false };
        }
        let ratio = |a: f64, b: f64| (a.max(0.0) / b).sqrt();
        Self { normal, thickness: ratio(least, middle), width: ratio(middle, most), along_line: false }
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

/// The plane at a point whose neighbors lie at `offsets` from it, nearest first. `more` gives up to [`MOST_NEIGHBORS`] of them,
/// and is asked only where those are not flat.
pub(super) fn plane<'a>(offsets: &[DVec3], more: impl FnOnce() -> &'a [DVec3]) -> Plane {
    let first = Plane::fit(offsets, |_| true);
    if first.thickness <= FLAT && first.width >= LINE || offsets.len() < NEIGHBORS {
        return first;
    }
    let wider = more();
    let grown = Plane::fit(wider, |_| true);
    if first.width < LINE {
        let wider = if grown.width > first.width { grown } else { first };
        return Plane { along_line: true, ..wider };
    }
    if grown.thickness < FLATTER * first.thickness || grown.thickness <= FLAT {
        return grown;
    }
    sheet(offsets).unwrap_or(if grown.thickness < first.thickness { grown } else { first })
}

/// The flat sheet with most of the neighbors.
fn sheet(offsets: &[DVec3]) -> Option<Plane> {
    let near = &offsets[..offsets.len().min(6)];
    let limit = ON_SHEET * near.last()?.length();
    let mut best = (f64::INFINITY, DVec3::ZERO);
    for (i, a) in near.iter().enumerate() {
        for b in &near[..i] {
            let Some(normal) = a.cross(*b).try_normalize() else { continue };
            let cut = |o: &DVec3| normal.dot(*o).powi(2).min(limit * limit);
            let off: f64 = offsets.iter().map(cut).sum();
            if off < best.0 {
                best = (off, normal);
            }
        }
    }
    let on_sheet = |o: DVec3| best.1.dot(o).abs() <= limit;
    let enough = offsets.iter().filter(|o| on_sheet(**o)).count() + 1 >= FEWEST_ON_SHEET;
    let fitted = (best.0.is_finite() && enough).then(|| Plane::fit(offsets, on_sheet))?;
    (fitted.thickness <= FLAT).then_some(fitted)
}
