//! The approximate point size of ray casting: what it cuts off.

use glam::{DVec3, Vec3};

use super::*;

fn approximate(side_px: u32) -> Settings {
    Settings { rasterizer: Rasterizer::RaycastApproximate, ..settings(side_px) }
}

/// Off the axis and tilted toward the eye: its projection reaches farther than its radius at the center's depth.
fn tilted() -> Ellipse {
    (DVec3::new(0.6, 0.15, 2.0), Vec3::new(0.5, 0.0, -0.8), Vec3::new(0.0, 0.7, 0.0), GRAY)
}

#[test]
fn a_tilted_splat_off_the_axis_loses_what_is_beyond_the_square() {
    let whole = picture(&ellipses(&[tilted()]), &settings(201));
    let chopped = picture(&ellipses(&[tilted()]), &approximate(201));
    let (s, p) = (tilted().1.as_dvec3(), tilted().0);
    let half_side = s.length() / 2.0;
    let (mut lost, mut kept) = (0, 0);
    for ((x, y, a), b) in pixels_at(&chopped).zip(&whole.pixels) {
        let inside = (x - p.x / 2.0).abs().max((y - p.y / 2.0).abs()) <= half_side;
        assert_eq!(a.is_covered(), b.is_covered() && inside, "{x}, {y}");
        if a.is_covered() {
            assert_eq!((a.weight, a.depth), (b.weight, b.depth));
            kept += 1;
        }
        lost += usize::from(b.is_covered() && !inside);
    }
    assert!(lost > 20 && kept > 500, "{lost} of {kept}");
}

#[test]
fn the_square_is_that_of_what_is_drawn() {
    // A speck: the filters' √2 pixels, not its own radius.
    let speck = facing_disk(DVec3::new(0.003, 0.001, 1.0), 1e-6, GRAY);
    for filter in [Filter::Adjust, Filter::Max] {
        let with =
            |rasterizer| picture(&ellipses(&[speck]), &Settings { filter, rasterizer, ..settings(32) });
        let chopped = with(Rasterizer::RaycastApproximate);
        assert!(covered(&chopped) >= 4, "{filter:?}");
        assert_eq!(chopped.pixels, with(Rasterizer::Raycast).pixels, "{filter:?}");
    }
    // Neither is anything cut off a center that is not in front.
    let ground = (DVec3::new(0.0, 0.5, -0.1), Vec3::X * 2.0, Vec3::Z * 2.0, GRAY);
    let scene = ellipses(&[ground]);
    assert_eq!(picture(&scene, &approximate(64)).pixels, picture(&scene, &settings(64)).pixels);
}

#[test]
fn the_rim_follows_the_squares_border_where_the_splat_covers() {
    let (splat, view) = drawn(tilted(), &approximate(201));
    let half_side = tilted().1.as_dvec3().length() / 2.0;
    let pixel = 2.0 / 201.0;
    let rim = |x_px: f64, y: f64| {
        let ray = DVec3::new(0.3 + half_side + x_px * pixel, y, 1.0);
        splat.rim(ray, 20.0, 1.0, &view).is_some()
    };
    // The nearer side of the splat reaches over the right border.
    assert!(splat.hit(DVec3::new(0.3 + half_side, 0.1, 1.0), view.near).unwrap().r2() < 0.9);
    assert!(rim(0.9e-3, 0.1) && rim(-0.9e-3, 0.1));
    assert!(!rim(1.2e-3, 0.1) && !rim(-1.2e-3, 0.1));
    // Its own rim beyond the square is cut off with the rest.
    let end = tilted().0 + tilted().1.as_dvec3();
    let end = end / end.z;
    assert!((splat.hit(end, view.near).unwrap().r2() - 1.0).abs() < 1e-12);
    assert!(splat.rim(end, 20.0, 1.0, &view).is_none());
    // Above the splat there is nothing to cut off.
    assert!(!rim(0.0, 0.9));
}
