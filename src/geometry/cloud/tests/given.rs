//! Radii and sizes that a file gives.

use super::*;

#[test]
fn radii_of_the_file_stay() {
    let mut given = points((0..100).map(|i| DVec3::new(f64::from(i % 10), f64::from(i / 10), 0.0)));
    given.radii = Some((0..100).map(|i| if i == 3 { f32::NAN } else { 0.1 + 0.01 * i as f32 }).collect());
    let (splats, report) = splats_from_points(given, &());
    assert_eq!((report.radii_from_file, disks(&splats).1[40]), (99, 0.1 + 0.01 * 40.0));
    assert!(disks(&splats).1[3] > 1.0 && disks(&splats).1[3] < 1.6);
}

#[test]
fn sizes_of_an_unknown_unit_are_radii_where_they_close_the_surface() {
    // The last is there twice.
    let at = |i: i32| DVec3::new(f64::from(i % 10), f64::from(i / 10), 0.0);
    let grid = || points((0..100).chain([99]).map(at));
    // Those found are 1.06.
    for (size, is_radius) in [(0.8, true), (3.0, true), (0.5, false), (5.0, false), (f32::NAN, false)] {
        let given = Points { radii: Some(vec![size; 101]), radii_in_doubt: true, ..grid() };
        let (splats, report) = splats_from_points(given, &());
        assert_eq!(disks(&splats).1[44] == size, is_radius, "{size}");
        let ignored = if is_radius || size.is_nan() { 0 } else { 100 };
        assert_eq!(
            (report.sizes_ignored, report.radii_from_file),
            (ignored, if is_radius { 100 } else { 0 })
        );
    }
}
