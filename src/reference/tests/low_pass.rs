//! The larger one of kernel and low-pass filter.

use glam::{DVec3, Vec3};

use super::*;

fn max(side_px: u32) -> Settings {
    Settings { filter: Filter::Max, ..settings(side_px) }
}

/// Tilted, 12 pixels long and less than one wide: some of it beyond the filter's disk, some of that beyond it.
fn needle() -> Ellipse {
    (DVec3::new(0.011, 0.007, 1.0), Vec3::new(0.3, 0.0, 0.2), Vec3::new(0.0, 0.02, 0.0), GRAY)
}

#[test]
fn the_weight_is_the_larger_one_and_the_depth_that_of_the_disk_where_it_is() {
    for rasterizer in [Rasterizer::Perspective, Rasterizer::AffineCenter, Rasterizer::AffineContour] {
        let settings = Settings { rasterizer, ..max(81) };
        let filtered = picture(&ellipses(&[needle()]), &settings);
        let plain = picture(&ellipses(&[needle()]), &Settings { filter: Filter::None, ..settings.clone() });
        let mut kinds = [0; 4];
        for (((x, y, a), b), i) in pixels_at(&filtered).zip(&plain.pixels).zip(0..) {
            // A pixel is 2/81 wide; 2 σ² = ½.
            let q = ((x - 0.011).powi(2) + (y - 0.007).powi(2)) / (2.0 * (2.0_f64 / 81.0).powi(2));
            let low_pass = if q <= 1.0 { (-2.0 * q).exp() } else { 0.0 };
            assert!((a.weight - b.weight.max(low_pass)).abs() < 1e-12, "pixel {i}");
            kinds[usize::from(b.is_covered()) + 2 * usize::from(low_pass > 0.0)] += 1;
            if a.is_covered() {
                let depth = if b.is_covered() { b.depth } else { 1.0 };
                assert!((a.depth - depth).abs() < 1e-12, "pixel {i}");
            }
        }
        assert!(kinds.iter().all(|n| *n > 0), "{rasterizer:?}: {kinds:?}");
    }
}

#[test]
fn a_speck_is_the_filters_disk_and_an_edge_too() {
    for ellipse in [facing_disk(DVec3::Z, 1e-6, GRAY), (DVec3::Z, Vec3::X * 0.5, Vec3::Z * 0.5, GRAY)] {
        // Around a pixel corner: 4 pixels with |δ|² = ½, h² = 2.
        let picture = picture(&ellipses(&[ellipse]), &max(32));
        assert_eq!(covered(&picture), 4);
        for pixel in picture.pixels.iter().filter(|pixel| pixel.is_covered()) {
            assert!((pixel.weight - (-0.5_f64).exp()).abs() < 1e-12 && pixel.depth == 1.0);
        }
    }
}

#[test]
fn it_acts_on_a_splat_that_reaches_the_near_plane_but_not_on_a_center_before_it() {
    // A disk through the eye's surroundings, seen from its edge.
    let along = |z: f64| (DVec3::Z * z, Vec3::X * 0.1, Vec3::Z * 5.0, GRAY);
    assert_eq!(covered(&picture(&ellipses(&[along(1.0)]), &max(32))), 4);
    assert_eq!(covered(&picture(&ellipses(&[along(5e-7)]), &max(32))), 0);
}

#[test]
fn the_rim_is_that_of_the_union_and_of_the_disk_within() {
    let (splat, view) = drawn(needle(), &max(81));
    let pixel = 2.0 / 81.0;
    let h = 2.0_f64.sqrt() * pixel;
    let center = splat.center.truncate();
    let rim = |x: f64, y: f64| {
        let at = center + glam::DVec2::new(x, y);
        splat.rim(at.extend(1.0), at.length() / pixel, 1.0, &view)
    };
    // The filter's own border, beside the needle: r² = 1 ± 1e-4, and ± 3e-3.
    assert_eq!(rim(0.0, h * (1.0 + 5e-5)).unwrap().z, 1.0);
    assert_eq!(rim(0.0, h * (1.0 - 5e-5)).unwrap().z, 1.0);
    assert_eq!((rim(0.0, h * 1.0015), rim(0.0, h * 0.9985)), (None, None));
    // On the needle it does not show: the needle weighs more there.
    assert_eq!(rim(h, 0.0), None);
    // The needle's border within the filter, where the depth changes.
    let border = |x: f64| (0..25_000).map(|i| f64::from(i) * 1e-6).find(|y| rim(x, *y).is_some()).unwrap();
    let [left, right] = [-0.01, 0.01].map(border);
    assert!(left > 0.01 && left < h && right > 0.01 && right < h, "{left} {right}");
    // The needle recedes to the right: there the filter's depth is the smaller one, to the left its own.
    assert_eq!(rim(0.01, right).unwrap().z, 1.0);
    let z = rim(-0.01, left).unwrap().z;
    assert!(z > 0.98 && z < 0.999, "{z}");
    // The needle's end, far outside the filter.
    let x = (0..4000).map(|i| f64::from(i) * 1e-4).find(|x| rim(*x, 0.0).is_some()).unwrap();
    assert!(x > 0.24 && rim(x, 0.0).unwrap().z > 1.1, "{x}");
}
