//! Disks seen from their edge.

use glam::{DVec3, Vec3};

use super::*;
use crate::reference::splat::prepare;
use crate::reference::view::View;

/// A disk of radius ½ at depth 1, on the axis, turned about x by `angle_deg` from the screen.
fn turned(angle_deg: f64) -> Ellipse {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    (DVec3::Z, (DVec3::Y * cos + DVec3::Z * sin).as_vec3() * 0.5, Vec3::X * 0.5, GRAY)
}

#[test]
fn a_disk_whose_plane_holds_the_eye_covers_nothing() {
    for side_px in [64, 65] {
        let scene = ellipses(&[(DVec3::Z, Vec3::Z * 0.5, Vec3::X * 0.5, GRAY)]);
        assert_eq!(covered(&picture(&scene, &settings(side_px))), 0);
        // Off the axis as well: the plane through the eye and (0.3, 0.2, 1).
        let center = DVec3::new(0.25, 0.5, 1.0);
        let scene = ellipses(&[(center, center.as_vec3(), Vec3::X, GRAY)]);
        assert_eq!(covered(&picture(&scene, &settings(side_px))), 0);
    }
}

#[test]
fn near_the_edge_it_shrinks_to_a_line_and_never_grows() {
    let size = |angle_deg: f64, filter| {
        let settings = Settings { filter, ..settings(129) };
        let picture = picture(&ellipses(&[turned(angle_deg)]), &settings);
        let rows = picture.pixels.chunks(129).filter(|row| row.iter().any(Pixel::is_covered)).count();
        (covered(&picture), rows)
    };
    for sign in [-1.0, 1.0] {
        let mut last = usize::MAX;
        for k in 1..=8 {
            let angle_deg = 90.0 + sign * 10.0_f64.powi(-k);
            let (area, rows) = size(angle_deg, Filter::None);
            // The row of pixel centers at y = 0 lies in no more than the chord of the disk: half a unit at depth
            // 1 to each side, 64.5 pixels.
            assert!(area <= last && rows <= 1 && area <= 65, "{angle_deg}: {area}");
            last = area;
            // With the filter: half axes 32 and √2 pixels, a line of 64 with 2 to 3 rows; or 4, where the disk still has
            // depth and its near end is magnified.
            let (area, rows) = size(angle_deg, Filter::Adjust);
            assert!(
                (100..=190).contains(&area) && (3..=4).contains(&rows),
                "{angle_deg}: {area} in {rows} rows"
            );
        }
    }
}

#[test]
fn at_grazing_angles_the_area_is_that_of_the_projected_ellipse() {
    for angle_deg in [89.0, 89.5_f64] {
        let picture = picture(&ellipses(&[turned(angle_deg)]), &settings(2049));
        // Rows y and depth: exact silhouette by sampling the disk, here as the conic (z = 1 + y tan, |q| ≤ ½).
        let splat = turned(angle_deg);
        let slope = f64::from(splat.1.z) / f64::from(splat.1.y);
        let expected = pixels_at(&picture)
            .filter(|(x, y, _)| {
                let z = 1.0 / (1.0 - slope * y);
                z > 0.0 && (z * x).powi(2) + (z * y).powi(2) + (z - 1.0).powi(2) <= 0.25
            })
            .count();
        // The f32 tangents are not exactly ½ long.
        assert!(expected > 5000 && covered(&picture).abs_diff(expected) <= 4, "{angle_deg}: {expected}");
    }
}

#[test]
fn a_ray_in_the_plane_hits_nothing() {
    let view = View::pinhole(&camera(), [65, 65]);
    let (splats, _) = prepare(&ellipses(&[(DVec3::Z, Vec3::Z, Vec3::X, GRAY)]), &view, &settings(65));
    for x in [0.0, 0.3] {
        assert_eq!(splats[0].hit(DVec3::new(x, 0.0, 1.0), view.near), None);
    }
}

#[test]
fn the_rim_of_a_thin_splat_reaches_far_beyond_it() {
    // A millionth of a degree from the edge, radius 0.05: in the row y = 0 depth is 1 and r = x/0.05.
    let angle_rad = (90.0 - 1e-6_f64).to_radians();
    let s = (DVec3::Y * angle_rad.cos() + DVec3::Z * angle_rad.sin()).as_vec3() * 0.05;
    let picture = picture(&ellipses(&[(DVec3::Z, s, Vec3::X * 0.05, GRAY)]), &settings(129));
    let minor_px = 64.5 * f64::from(s.y);
    let mut beyond = 0;
    for (x, _, pixel) in pixels_at(&picture).filter(|(_, y, _)| *y == 0.0) {
        let r2 = (x / f64::from(0.05_f32)).powi(2);
        let margin = (16.0 * 64.5 * x.abs() / 16_777_216.0 / minor_px).max(1e-3);
        assert_eq!(pixel.rim, (r2 - 1.0).abs() <= margin, "{x}");
        beyond += usize::from(pixel.rim && r2 > 4.0);
    }
    assert!(beyond > 20, "{beyond}");
}
