//! Points that belong to no surface, and disks too large for those around them.

use glam::DVec3;
use rayon::prelude::*;

use super::{
    fit::{FLAT, LINE, Plane},
    plane::NEIGHBORS,
    radii::Radius,
    strays,
};
use crate::geometry::neighbors::Tree;

/// A point is isolated whose neighbors are so many times as far away as its neighbors' neighbors are from them. Where the density
/// of a scan changes by 1:10 this is √10 at most.
pub(super) const ISOLATED: f64 = 8.0;

/// A point off the plane of its neighbors is so if they are so many times as far away.
const LONELY: f64 = 2.5;

/// The share of the distance from its nearest neighbor that it is off that plane.
const OFF: f64 = 0.5;

/// No disk is larger than so many times the median of its neighbors'; it then gets the median.
const LARGEST: f32 = 4.0;

/// At a rim, where what is far away may be outside of the surface.
const LARGEST_AT_RIM: f32 = 2.0;

/// Whether each point is isolated, or a stray; `spreads` are mean distances of neighbors.
pub(super) fn isolated(tree: &Tree, neighbors: &[[u32; NEIGHBORS]], spreads: &[f64]) -> Vec<bool> {
    let mut isolated = far_from_all(tree, neighbors, spreads);
    strays::mark(tree, neighbors, spreads, &mut isolated);
    isolated
}

fn far_from_all(tree: &Tree, neighbors: &[[u32; NEIGHBORS]], spreads: &[f64]) -> Vec<bool> {
    let is_isolated = |(place, (near, &spread)): (usize, (&[u32; NEIGHBORS], &f64))| {
        let Some(around) = median_below(spread / LONELY, near, |j| spreads[j]) else { return false };
        spread > ISOLATED * around || floats(tree, place, near, |j| spreads[j] < LONELY * around, around)
    };
    neighbors.par_iter().zip(spreads).enumerate().map(is_isolated).collect()
}

/// Whether the neighbors of a point, `around` apart, lie in a plane, and it off that: as what a scanner saw half of an edge and half of what is behind, or
/// of dust.
fn floats(
    tree: &Tree,
    place: usize,
    near: &[u32; NEIGHBORS],
    is_dense: impl Fn(usize) -> bool,
    around: f64,
) -> bool {
    let at = |place: usize| tree.points()[place].position;
    let dense = near.iter().filter(|j| **j != u32::MAX).map(|j| *j as usize).filter(|j| is_dense(*j));
    let mut others = dense.map(at);
    let Some(nearest) = others.next() else { return false };
    let offsets: Vec<DVec3> = others.map(|other| other - nearest).collect();
    let plane = Plane::fit(&offsets, |_| true);
    let off = plane.normal.dot(at(place) - nearest - plane.mean).abs();
    let is_flat = plane.thickness < FLAT && plane.width > LINE;
    is_flat && off > LONELY * around && off > OFF * at(place).distance(nearest)
}

/// Radii without those that are far too large.
pub(super) fn limit_radii(neighbors: &[[u32; NEIGHBORS]], radii: &[f32]) -> Vec<f32> {
    let limited = |(near, &radius): (&[u32; NEIGHBORS], &f32)| match median_below(
        f64::from(radius / LARGEST),
        near,
        |j| f64::from(radii[j]),
    ) {
        Some(median) if median > 0.0 => median as f32,
        _ => radius,
    };
    neighbors.par_iter().zip(radii).map(limited).collect()
}

/// Radii, at rims no larger than the median of those of neighbors that are at none, but for what closes the surface, up to
/// [`LARGEST_AT_RIM`] of it.
pub(super) fn limit_rims(neighbors: &[[u32; NEIGHBORS]], radii: &[Radius]) -> Vec<f32> {
    let limited = |(near, &Radius { whole, of_rim }): (&[u32; NEIGHBORS], &Radius)| {
        let Some(within) = of_rim else { return whole };
        let near = near.iter().filter(|j| **j != u32::MAX).map(|j| radii[*j as usize]);
        let mut inner = [f32::INFINITY; NEIGHBORS];
        let count = inner.iter_mut().zip(near.filter(|near| near.of_rim.is_none()));
        let count = count.map(|(to, near)| *to = near.whole).count();
        inner.sort_unstable_by(f32::total_cmp);
        match inner.get(count.saturating_sub(1) / 2) {
            Some(median) if count > 0 => whole.min(median.max(within.min(LARGEST_AT_RIM * median))),
            _ => whole,
        }
    };
    neighbors.par_iter().zip(radii).map(limited).collect()
}

/// The lower median of the neighbors' values where it is below `limit`: then it is that of those below.
fn median_below(limit: f64, near: &[u32; NEIGHBORS], value: impl Fn(usize) -> f64) -> Option<f64> {
    let near = near.iter().filter(|j| **j != u32::MAX).map(|j| value(*j as usize));
    let lower_middle = near.clone().count().checked_sub(1)? / 2;
    let mut values = [f64::INFINITY; NEIGHBORS];
    let below =
        values.iter_mut().zip(near.filter(|value| *value < limit)).map(|(to, value)| *to = value).count();
    (below > lower_middle).then(|| {
        values.sort_unstable_by(f64::total_cmp);
        values[lower_middle]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::neighbors::Point;

    #[test]
    fn a_point_far_from_all_is_isolated_and_its_disk_is_no_plate() {
        let mut near = [u32::MAX; NEIGHBORS];
        near[..3].copy_from_slice(&[0, 1, 2]);
        let all = [near; 4];
        let point = |number: u32| Point { position: DVec3::splat(f64::from(number)), number };
        let tree = Tree::new((0..4).map(point).collect());
        assert_eq!(far_from_all(&tree, &all, &[1.0, 1.0, 1.1, 9.0]), [false, false, false, true]);
        assert_eq!(limit_radii(&all, &[1.0, 1.0, 1.0, 4.5]), vec![1.0; 4]);
        assert_eq!(far_from_all(&tree, &[[u32::MAX; NEIGHBORS]], &[1.0]), [false]);
    }
}
