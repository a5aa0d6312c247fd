//! How coarse a cloud must be looked at so that its noise is small against what is looked at.
//!
//! Where the 12 nearest neighbors of most points are as thick as wide, planes through them mean nothing. Planes are then fitted
//! to the 48 nearest of all points, of every 4th, of every 16th and so on: the first of these in which most are flat enough, or on a
//! sheet that is, or else the flattest. That is as many points a plane at any coarseness. What is fitted are [`patches`], fewer than points,
//! which tell the normals of all, and are less far off than each plane: so these may have a thickness that one plane alone must not, and the face
//! of a statue keeps its features. A million points of a ball with 1% noise need every 16th.

use glam::DVec3;

use super::{
    fit::{FLAT, Plane},
    patches::{self, every, plane_or_sheet},
    plane::{MOST_NEIGHBORS, NEIGHBORS},
};
use crate::geometry::neighbors::{Many, Tree};

/// Every so manieth point is in a coarser tree, in the order of the finer one, in which neighbors lie near each other.
const STRIDES: [usize; 6] = [4, 16, 64, 256, 1024, 4096];

/// Thickness over width up to which planes of patches are flat enough, and up to which the flattest are a surface. Points in a volume have 0.7 to 0.9.
const FLAT_ENOUGH: f64 = 0.4;
const THICKEST: f64 = 0.6;

/// Thickness over width above which neighbors may be of two sheets; of patches, if it is also so many times that of most of them.
const MIXED: f64 = 0.25;
const THICKER: f64 = 1.2;

/// So many points tell of all.
const SAMPLES: usize = 200;

/// Whether neighbors are too few to tell noise from the turn of a surface.
fn is_small(tree: &Tree) -> bool {
    tree.points().len() <= 4 * MOST_NEIGHBORS
}

/// The normals at all points, on one side of each surface, if those of 12 neighbors are too noisy and coarser ones are not.
pub(super) fn normals(tree: &Tree) -> Option<Vec<DVec3>> {
    let fine = thickness(tree, tree, NEIGHBORS);
    if fine <= FLAT || is_small(tree) {
        return None;
    }
    let (mut least, mut flattest) = (thickness(tree, tree, MOST_NEIGHBORS), None);
    for stride in STRIDES {
        if least <= FLAT_ENOUGH || tree.points().len() / stride <= 4 * MOST_NEIGHBORS {
            break;
        }
        let coarse = every(tree, stride);
        let found = thickness(tree, &coarse, MOST_NEIGHBORS);
        if found < least {
            (least, flattest) = (found, Some(coarse));
        }
    }
    let coarse = flattest.as_ref().unwrap_or(tree);
    // Of more neighbors noise is thinner; what turns fast, or has few points, is thicker.
    (least <= THICKEST && least < fine).then(|| patches::normals(tree, coarse, MIXED.max(THICKER * least)))
}

/// The median thickness of planes through so many points of `among` that are nearest to a point; 0 of too few points to tell.
fn thickness(tree: &Tree, among: &Tree, neighbors: usize) -> f64 {
    let total = tree.points().len();
    if among.points().len() <= 4 * neighbors {
        return 0.0;
    }
    let mut near = Many::default();
    let of = |place: usize| {
        let place = tree.points()[place].position;
        let plane = match neighbors {
            NEIGHBORS => Plane::fit(near.nearest(among, place, NEIGHBORS), |_| true),
            _ => plane_or_sheet(among, place, MIXED, &mut near),
        };
        plane.thickness
    };
    let mut all: Vec<f64> = (0..total).step_by(total.div_ceil(SAMPLES)).map(of).collect();
    let middle = (all.len() - 1) / 2;
    *all.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{geometry::neighbors::Point, math::random::SplitMix};

    fn tree(count: u32, mut place: impl FnMut(DVec3) -> DVec3) -> Tree {
        let mut random = SplitMix(9);
        let mut in_ball = || loop {
            let p = DVec3::from_array([0; 3].map(|_| 2.0 * random.unit() - 1.0));
            if (0.01..1.0).contains(&p.length()) {
                return p;
            }
        };
        Tree::new((0..count).map(|number| Point { position: place(in_ball()), number }).collect())
    }

    /// A shell so thick that no coarseness makes it flat, unlike what has no surface at all.
    #[test]
    fn where_nothing_is_flat_the_flattest_is_taken_and_a_volume_has_no_normals() {
        let shell = tree(4000, |p| p.normalize() * (0.75 + 0.5 * p.length().powi(3)));
        let normals = normals(&shell).expect("a surface");
        let angles =
            shell.points().iter().zip(normals).map(|(point, normal)| {
                point.position.normalize().dot(normal).abs().min(1.0).acos().to_degrees()
            });
        let mean = angles.sum::<f64>() / 4000.0;
        assert!(mean < 8.0, "{mean}°");
        assert!(super::normals(&tree(4000, |p| p)).is_none());
        assert!(super::normals(&tree(4000, |p| p.normalize())).is_none(), "clean");
    }
}
