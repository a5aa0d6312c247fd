//! What is to be seen of a scene, and which of its pixels nobody can decide.

use surfel::{
    reference::Picture,
    scene::{Accumulate, Cull, Rasterizer, Settings},
};

use super::{posed::is_cut_by_near, rows::Case};
use crate::common::{oracle_of, scenes::Hard, with};

/// The oracle's picture.
pub struct Truth {
    pub picture: Picture,
    /// Rounding may turn what is seen there.
    pub undecided: Vec<bool>,
}

/// How far the near plane may be off, relative: as far as a depth.
const NEAR: f64 = 1e-4;

impl Truth {
    fn of(case: &Case, settings: Settings) -> Self {
        let hard = Hard { settings, ..case.hard.clone() };
        let picture = oracle_of(&hard);
        let mut undecided: Vec<bool> =
            picture.pixels.iter().map(|pixel| pixel.rim || pixel.epsilon_margin < case.depth_steps).collect();
        if is_cut_by_near(&hard.scene.objects[0], &hard.camera) {
            for factor in [1.0 - NEAR, 1.0 + NEAR] {
                let mut other = hard.clone();
                other.camera.near = Some(hard.camera.near() * factor);
                mark_different(&picture, &oracle_of(&other), &mut undecided);
            }
        }
        Self { picture, undecided }
    }

    /// Nor can anybody decide what is seen in one of two pictures alone.
    pub fn mark_different(&mut self, other: &Picture) {
        mark_different(&self.picture, other, &mut self.undecided);
    }
}

fn mark_different(a: &Picture, b: &Picture, undecided: &mut [bool]) {
    for ((a, b), undecided) in a.pixels.iter().zip(&b.pixels).zip(undecided) {
        *undecided |= a.is_covered() != b.is_covered() || a.fragments != b.fragments;
    }
}

/// The truths of a scene: methods that draw one picture share it.
pub struct Truths<'a> {
    case: &'a Case,
    found: Vec<(Rasterizer, Truth)>,
}

impl<'a> Truths<'a> {
    pub fn of(case: &'a Case) -> Self {
        Self { case, found: Vec::new() }
    }

    /// That of a rasterizer.
    pub fn get(&mut self, rasterizer: Rasterizer) -> &mut Truth {
        let family = rasterizer.family();
        let index = self.found.iter().position(|(of, _)| *of == family).unwrap_or_else(|| {
            let settings = with(&self.case.hard, |settings| {
                settings.rasterizer = family;
                settings.accumulate = Accumulate::F32;
                settings.cull = Cull::Auto;
            });
            self.found.push((family, Truth::of(self.case, settings.settings)));
            self.found.len() - 1
        });
        &mut self.found[index].1
    }
}
