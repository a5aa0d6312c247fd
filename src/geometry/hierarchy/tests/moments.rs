//! Covariance added up along the tree, far from the origin.

use glam::{DMat3, DVec3};

use super::models::random_ellipses;
use crate::geometry::hierarchy::{
    disks::{Disk, Disks},
    moments::Moments,
    split::split,
    sums::{self, Sums},
};

/// The largest relative error of a covariance.
const TOLERANCE: f64 = 1e-9;

/// The mean first, then the covariance about it. Differences from one of the disks are exact.
fn in_two_passes(disks: &[Disk]) -> (DVec3, DMat3) {
    let start = disks[0].center;
    let area = |disk: &Disk| disk.area_normal().length();
    let total: f64 = disks.iter().map(area).sum();
    let mean = disks.iter().map(|disk| area(disk) * (disk.center - start)).sum::<DVec3>() / total;
    let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
    let covariance = disks.iter().fold(DMat3::ZERO, |sum, disk| {
        let own = outer(disk.s.as_dvec3()) + outer(disk.t.as_dvec3());
        sum + area(disk) * (outer(disk.center - start - mean) + 0.25 * own)
    });
    (start + mean, covariance * total.recip())
}

fn relative_error(covariance: DMat3, truth: DMat3) -> f64 {
    let norm = |matrix: DMat3| matrix.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(covariance - truth) / norm(truth)
}

#[test]
fn covariance_keeps_its_digits_at_1e7_and_about_one_origin_loses_them() {
    let mut splats = random_ellipses(5000, 1.0, 3);
    splats.positions.iter_mut().for_each(|position| *position += DVec3::new(1e7, -1e7, 1e7));
    let (tree, _) = split(&splats, &());
    let disks = Disks::of(&splats, &tree.order);
    let (mut worst, mut least_about_origin) = (0.0_f64, f64::INFINITY);
    let mut below: Vec<Sums> = Vec::new();
    for level in tree.levels.iter().rev() {
        let sums = sums::of_level(&tree, level, &below, &disks, &splats.colors);
        for (node, sums) in tree.nodes[level.clone()].iter().zip(&sums) {
            let disks = disks.run(&node.splats);
            let (mean, truth) = in_two_passes(disks);
            assert!(sums.center.distance(mean) <= 4.0 * f64::EPSILON * mean.length());
            worst = worst.max(relative_error(sums.moments.covariance(), truth));

            let mut about_origin = Moments::NONE;
            disks.iter().for_each(|disk| about_origin += Moments::of(disk).moved(disk.center));
            let covariance = about_origin.moved(-mean).covariance();
            least_about_origin = least_about_origin.min(relative_error(covariance, truth));
        }
        below = sums;
    }
    println!("relative error {worst:.1e}; about one origin at least {least_about_origin:.1e}");
    assert!(worst <= TOLERANCE, "{worst}");
    assert!(least_about_origin > TOLERANCE, "{least_about_origin}");
}
