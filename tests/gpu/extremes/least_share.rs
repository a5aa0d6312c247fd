//! The share of its weight that a filter leaves to a splat smaller than a pixel is the share of its area, however small that is.

use glam::DVec3;
use surfel::{
    renderer::Frame,
    scene::{Filter, Rasterizer, Settings, Shading},
};

use crate::common::{
    ALL, PICTURE,
    builder::{Builder, camera, settings},
    render_as,
    scenes::Hard,
    shared,
};

const SIDE_PX: u32 = 15;
const MIDDLE: usize = (SIDE_PX * SIDE_PX / 2) as usize;

/// Disks that face the eye around the middle pixel's center, each of a radius in pixels.
fn disks(radii_px: &[(f64, [f32; 4])], rasterizer: Rasterizer, filter: Filter) -> Hard {
    let camera = camera([0.0, 0.0, 3.0], [0.0; 3]);
    let pixel = 3.0 / camera.focal_px(SIDE_PX);
    let mut builder = Builder::default();
    for (radius_px, color) in radii_px {
        builder.disk(DVec3::ZERO, DVec3::Z, radius_px * pixel, *color);
    }
    let shading = Shading::Albedo;
    let settings = Settings { size_px: [SIDE_PX; 2], rasterizer, filter, shading, ..settings() };
    Hard { name: "smaller than a pixel", scene: builder.scene(false), camera, settings }
}

/// The filter's radius is √2 pixels: l² of l² + 2.
fn share(radius_px: f64) -> f64 {
    radius_px * radius_px / (radius_px * radius_px + 2.0)
}

const METHODS: [(Rasterizer, Filter); 5] = [
    (Rasterizer::Perspective, Filter::Ewa),
    (Rasterizer::Perspective, Filter::Adjust),
    (Rasterizer::Quad, Filter::Adjust),
    (Rasterizer::Compute, Filter::Ewa),
    (Rasterizer::Compute, Filter::Adjust),
];

/// In sums of 32 bits, which hold any of them.
#[test]
fn the_weight_of_a_small_splat_is_its_share_of_the_filters_area() {
    let mut headless = shared();
    let mut wrong = Vec::new();
    for (rasterizer, filter) in METHODS {
        for radius_px in [1.0, 0.5, 0.3, 0.1, 0.03, 0.01] {
            let hard = disks(&[(radius_px, [0.5, 0.5, 0.5, 1.0])], rasterizer, filter);
            let frame: Frame = render_as(&mut headless, &hard, ALL);
            // Tangent adjustment is 0.2% from the sum of covariances, in both axes.
            let error = f64::from(frame.weight[MIDDLE]) / share(radius_px) - 1.0;
            if error.abs() > 5e-3 {
                wrong.push(format!("{rasterizer:?}, {filter:?}, {radius_px} px: {:+.1}%", 100.0 * error));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// So that of two splats at one place each has its share of the color, also where tiles are shaded at once.
#[test]
fn small_splats_beside_large_ones_have_their_share_of_the_color() {
    let mut headless = shared();
    let mut wrong = Vec::new();
    for (rasterizer, filter) in METHODS {
        let both = [(2.0, [1.0, 0.0, 0.0, 1.0]), (0.1, [0.0, 0.0, 1.0, 1.0])];
        let frame = render_as(&mut headless, &disks(&both, rasterizer, filter), PICTURE);
        let expected = share(0.1) / (share(0.1) + share(2.0));
        let blue = f64::from(frame.linear[MIDDLE][2]);
        if (blue - expected).abs() > 1.0 / 1024.0 {
            wrong.push(format!("{rasterizer:?}, {filter:?}: {blue:.4} blue, expected {expected:.4}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
