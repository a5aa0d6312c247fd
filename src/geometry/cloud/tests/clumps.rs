//! Clouds whose points come in clumps.

use super::*;

#[test]
fn points_that_were_seen_many_times_close_their_surface() {
    let mut s = Surfaces(SplitMix(3));
    let (once, places) = (s.many(5000, Surfaces::sphere), s.many(10_000, Surfaces::sphere));
    // Points are 0.05 apart.
    for (most, jitter) in [(4.0, 0.002), (12.0, 0.004), (40.0, 0.003)] {
        let mut positions = Vec::new();
        for (place, _) in &once {
            for _ in 0..1 + (most * s.0.unit()) as usize {
                positions.push(*place + jitter * DVec3::from_array([0; 3].map(|_| s.0.unit() - 0.5)));
            }
        }
        let (splats, report) = splats_from_points(points(positions), &());
        let holes = holes(&splats, &places, 1.0);
        assert!(holes == 0 && (4500..=5000).contains(&splats.len()), "{most}: {holes} holes, {report}");
        assert_eq!(splats.len() + report.duplicates, report.points, "{report}");
    }
}

#[test]
fn two_things_of_few_points_are_no_clumps() {
    let corner = |i: i32| DVec3::new((i & 1).into(), (i >> 1 & 1).into(), (i >> 2 & 1).into());
    let boxes = (0..16).map(|i| corner(i) + 100.0 * DVec3::X * f64::from(i >> 3));
    assert_eq!(splats_from_points(points(boxes), &()).0.len(), 16);
}
