//! How far disks stick out of the surface that they are of.

use glam::DVec2;

use super::*;

/// How far disks stick out beyond a square or cube from −1 to 1, in mean distances of the points, sorted.
fn beyond(samples: &[Sample], spacing: f64) -> Vec<f64> {
    let (splats, _) = of(samples);
    let (normals, radii) = disks(&splats);
    let one = |i: usize| {
        let (place, normal) = (splats.positions[i], normals[i].as_dvec3());
        let reach = |axis: DVec3| {
            place.dot(axis).abs() + f64::from(radii[i]) * (1.0 - normal.dot(axis).powi(2)).sqrt()
        };
        (DVec3::AXES.map(reach).into_iter().fold(0.0, f64::max) - 1.0) / spacing
    };
    let mut beyond: Vec<f64> = (0..splats.len()).map(one).collect();
    beyond.sort_by(f64::total_cmp);
    beyond
}

#[test]
fn at_rims_disks_stick_out_no_farther_than_inside() {
    let mut s = Surfaces(SplitMix(3));
    let square = s.many(2500, |s| s.plate(0.0));
    let grid = |i: usize| DVec2::new((i % 50) as f64, (i / 50) as f64) / 24.5 - 1.0;
    let grid: Vec<Sample> = (0..2500).map(|i| (grid(i).extend(0.0), DVec3::Z)).collect();
    let cube = s.many(10_000, Surfaces::cube);
    for (name, samples, area, most) in [
        ("grid", grid, 4.0, [1.1; 3]),
        ("square", square, 4.0, [1.4, 2.1, 3.6]),
        ("cube", cube, 24.0, [1.5, 2.2, 4.5]),
    ] {
        let spacing = (area / samples.len() as f64).sqrt();
        let beyond = beyond(&samples, spacing);
        let at = |share: f64| beyond[((beyond.len() - 1) as f64 * share) as usize];
        let told = format!("{name}: {:.3} {:.3} {:.3}", at(0.97), at(0.99), at(1.0));
        println!("{told}");
        assert!(at(0.97) < most[0] && at(0.99) < most[1] && at(1.0) < most[2], "{told}");
    }
}
