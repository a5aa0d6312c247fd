//! The tangent plane at a point from its neighbors.
//!
//! **The rule.** The plane is that of least squares through the point and its nearest [`NEIGHBORS`], by their covariance about
//! their mean. Where they are not flat the neighborhood grows to [`MOST_NEIGHBORS`], if it becomes flatter by that: noise has
//! a thickness of its own, which matters less the wider the neighborhood, while an edge looks the same at any width, and what turns fast is
//! thicker, so that it keeps its few neighbors. Where it
//! does neither, at edges and between the two sides of a thin plate, the [`sheets`] are looked for among them.
//!
//! Neighbors all on a line, as on scan lines that lie far apart, grow, too; where that is not enough, `lines` looks for those beside it.

use glam::DVec3;

use super::{
    fit::{FLAT, LINE, Plane},
    sheets,
};

/// How many neighbors make a plane.
pub(super) const NEIGHBORS: usize = 12;

/// How many make one where those are not flat.
pub(super) const MOST_NEIGHBORS: usize = 48;

/// How much thicker a wider neighborhood is of a surface that turns fast: the side of a tube, or a ball of few points.
const THICKER: f64 = 1.7;

/// Thickness over width up to which this may be so; edges are thicker.
const NEARLY_FLAT: f64 = 0.25;

/// How much flatter a wider neighborhood must be. Four times the points of a noisy plane are twice as wide and as thick.
const FLATTER: f64 = 0.7;

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
    if first.thickness <= NEARLY_FLAT && grown.thickness > THICKER * first.thickness {
        return first;
    }
    let thinner = if grown.thickness < first.thickness { grown } else { first };
    sheets::wide(wider).or_else(|| sheets::near(offsets)).unwrap_or(thinner)
}
