//! A node's ellipse (Pajarola et al. 2003, section 3.4): in the plane through the centroid across the mean normal, with axes along those of
//! the surface's covariance in that plane and as long as their square roots (the paper's text has the eigenvalues themselves, which are
//! squared lengths), scaled by the least f for which all disks below are inside, if they are projected into the plane.
//!
//! f is found over all disks below each node, O(n) a level (`farthest`), where the paper bounds a disk by a box.
//!
//! **Seen from where?** The paper projects at right angles. Seen from elsewhere, a disk at height h above the plane then is beside the ellipse's
//! rim by up to `h tan θ`, and where no neighbor happens to be, there is a hole: on bends and edges. So each disk is moved in every
//! direction by its height, too: *every line of sight that meets a disk below, at up to 45° from the ellipse's normal, meets the ellipse.* On smooth
//! surfaces heights are of second order, and so is what this adds. Farther from the normal lies the silhouette, where a flat
//! ellipse can't stand for what bends, and loses up to the height of the disks, which is pixels only for τ of many pixels.
//!
//! **Where normals cancel** (their mean is shorter than ½, that of a hemisphere) the surface turns back on itself below the node, and the mean
//! normal is that of what is left over: of a plate, its rim. The plane is then the one to which the surface is nearest, whose
//! normal is the covariance's smallest eigenvector.
//!
//! **What is drawn of it.** An ellipse that holds all disks has a kernel much wider than what those sum to, and its picture is blurred. So it is drawn
//! as long along each axis as has its kernel spread as the kernels below do together, by their second moments, times [`DRAWN`], and no longer than what holds
//! all. With moments alone sums of weights would vary: blocks of a plane, each replaced by a kernel as wide, sum to 0.6 to 1.4 (a Gaussian of the
//! variance of a block). So they do where a node has many splats, of whose own width little is left in the sum: its ellipse is drawn as a whole, or lines of sight would pass between
//! such nodes where a surface bends. Balls, cones and what is proved of nodes are those of the ellipse that holds all.

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::{LEAF_SPLATS, disks::Disk, farthest::farthest_square, moments::KERNEL_SQUARE};
use crate::geometry::eigen::eigen;

/// The mean of unit normals below which they are taken to cancel: that of a hemisphere.
const LEAST_MEAN_NORMAL: f64 = 0.5;

/// The least ratio of an ellipse's axes: what rounding leaves of the shorter one is no less than that.
const LEAST_AXIS_RATIO: f64 = 1.0 / 1024.0;

/// More than f32 loses of an ellipse's axes and a disk's, in parts of f where the axes are equally long. The longer axis turns by as
/// much, which the ratio of both makes larger beside the shorter one.
const ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// How many times as long what is drawn is as by second moments alone.
pub(super) const DRAWN: f64 = 1.2;

/// Nodes of so many splats are drawn as long as that; from there on longer, up to the whole ellipse from [`WHOLE_SPLATS`] on.
const FEW_SPLATS: f64 = LEAF_SPLATS as f64;
const WHOLE_SPLATS: f64 = 64.0;

/// Below so many disks f is found by one thread.
const DISKS_AT_ONCE: usize = 1 << 14;

/// An ellipse in its place, to be scaled.
pub(super) struct Ellipse {
    pub center: DVec3,
    /// Unit.
    pub normal: DVec3,
    /// Unit, along the longer axis.
    major: DVec3,
    /// Unit, along the shorter one; `major × minor` is the normal.
    minor: DVec3,
    /// The lengths of both.
    lengths: [f64; 2],
    /// Half axes along both of one kernel that spreads as those of the disks below do together.
    kernel_lengths: [f64; 2],
}

impl Ellipse {
    /// `mean_normal` is that of unit normals; `covariance` about the center, and `of_kernels` that with the disks' weights.
    pub fn new(center: DVec3, mean_normal: DVec3, covariance: &DMat3, of_kernels: &DMat3) -> Self {
        let normal = plane_normal(mean_normal, covariance);
        let (x, y) = normal.any_orthonormal_pair();
        let (along_x, along_y) = (*covariance * x, *covariance * y);
        let (xx, xy, yy) = (x.dot(along_x), x.dot(along_y), y.dot(along_y));
        let (middle, half) = (0.5 * (xx + yy), 0.5 * (xx - yy).hypot(2.0 * xy));
        let (sin, cos) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
        let longer = (middle + half).sqrt();
        let shorter = (middle - half).max(0.0).sqrt().max(LEAST_AXIS_RATIO * longer);
        let (major, minor) = (cos * x + sin * y, cos * y - sin * x);
        let kernel = |axis: DVec3| (axis.dot(*of_kernels * axis).max(0.0) / KERNEL_SQUARE).sqrt();
        let kernel_lengths = [kernel(major), kernel(minor)];
        Self { center, normal, major, minor, lengths: [longer, shorter], kernel_lengths }
    }

    /// The ellipse's axes, scaled so that all these disks project into it, along lines up to 45° from the normal.
    pub fn axes_around(&self, disks: &[Disk]) -> (DVec3, DVec3) {
        self.axes_of(self.square_around(disks))
    }

    /// f² for these disks; 0 for none. That for all disks below is the largest of those for parts of them.
    pub fn square_around(&self, disks: &[Disk]) -> f64 {
        if disks.len() <= DISKS_AT_ONCE {
            return self.largest_square(disks);
        }
        disks.par_chunks(DISKS_AT_ONCE).map(|part| self.largest_square(part)).reduce(|| 0.0, f64::max)
    }

    /// The ellipse's axes for this f².
    pub fn axes_of(&self, square: f64) -> (DVec3, DVec3) {
        let [longer, shorter] = self.lengths;
        let f = square.sqrt() * (1.0 + ROUNDING * longer / shorter);
        (f * longer * self.major, f * shorter * self.minor)
    }

    /// What parts of these axes, which hold all disks below, are drawn where those are so many.
    pub fn drawn_parts(&self, (s, t): (DVec3, DVec3), disks: usize) -> [f32; 2] {
        let whole = wholeness(disks);
        let part = |length: f64, axis: DVec3| {
            let by_moments = (DRAWN * length / axis.length()).clamp(LEAST_AXIS_RATIO, 1.0);
            by_moments + whole * (1.0 - by_moments)
        };
        [part(self.kernel_lengths[0], s) as f32, part(self.kernel_lengths[1], t) as f32]
    }

    /// f² for some disks; 0 for none.
    fn largest_square(&self, disks: &[Disk]) -> f64 {
        let (x, y) = (self.major / self.lengths[0], self.minor / self.lengths[1]);
        let in_plane = |v: DVec3| DVec2::new(x.dot(v), y.dot(v));
        disks.iter().fold(0.0, |largest, disk| {
            let (center, s, t) = (disk.center - self.center, disk.s.as_dvec3(), disk.t.as_dvec3());
            let slant = DVec2::new(self.normal.dot(s), self.normal.dot(t)).length();
            let height = self.normal.dot(center).abs() + slant;
            let moved = height * DVec2::new(self.lengths[0].recip(), self.lengths[1].recip());
            farthest_square(largest, in_plane(center), in_plane(s), in_plane(t), moved)
        })
    }
}

/// From 0 of nodes of few splats to 1 of those that are drawn as whole ellipses.
pub(super) fn wholeness(disks: usize) -> f64 {
    ((disks as f64 / FEW_SPLATS).ln() / (WHOLE_SPLATS / FEW_SPLATS).ln()).clamp(0.0, 1.0)
}

fn plane_normal(mean_normal: DVec3, covariance: &DMat3) -> DVec3 {
    if mean_normal.length() >= LEAST_MEAN_NORMAL {
        return mean_normal.normalize();
    }
    let (_, [least, ..]) = eigen(covariance);
    if least.dot(mean_normal) < 0.0 { -least } else { least }
}
