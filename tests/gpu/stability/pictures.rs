//! The renderer's own pictures of the sweep: which fragments are missing, which are too many.

use glam::DVec2;
use surfel::{
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
};

use super::{
    sweep::Case,
    truth::{Coverage, Truth},
};
use crate::common::with_points_up_to;

/// Pixels whose coverage is decided: what the oracle has, and where the device differs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fragments {
    pub inside: usize,
    pub missed: usize,
    pub surplus: usize,
}

/// Draws a splat as the device would have it (a point, where it is regular) and as a quad.
pub fn count(headless: &mut Headless, scene: &PreparedScene, case: &Case, truth: &Truth) -> Fragments {
    let [width, height] = case.hard.settings.size_px;
    let middle = 0.5 * truth.size_px;
    let expected: Vec<Coverage> = (0..height)
        .flat_map(|row| (0..width).map(move |column| DVec2::new(f64::from(column), f64::from(row)) + 0.5))
        .map(|at_px| truth.coverage(at_px - middle))
        .collect();
    let mut fragments = Fragments::default();
    for cap_px in [f32::INFINITY, 0.0] {
        let wanted = Wanted { surface: true, ..Wanted::default() };
        let frame = with_points_up_to(headless, cap_px, |headless| {
            headless.render(scene, &case.hard.camera, &case.hard.settings, wanted).unwrap()
        });
        for (expected, weight) in expected.iter().zip(&frame.weight) {
            let covered = *weight > 0.0;
            fragments.inside += usize::from(*expected == Coverage::Inside);
            fragments.missed += usize::from(*expected == Coverage::Inside && !covered);
            fragments.surplus += usize::from(*expected == Coverage::Outside && covered);
        }
    }
    fragments
}
