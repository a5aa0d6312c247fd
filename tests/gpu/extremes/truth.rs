//! What is to be seen of a scene, which of its pixels nobody can decide, and what a rounded place makes of the others.

use std::rc::Rc;

use glam::DVec3;
use surfel::{
    reference::{Picture, Pixel},
    scene::{Camera, Rasterizer, Settings},
};

use super::{looking::SIZE_PX, posed::is_cut_by_near, rows::Case};
use crate::common::{oracle_of, scenes::Hard, with};

/// The oracle's picture.
pub struct Truth {
    pub picture: Rc<Picture>,
    /// Rounding may turn what is seen there.
    pub undecided: Vec<bool>,
    /// How much each figure of a pixel changes with its place.
    pub changes: Vec<Change>,
}

/// What [`PLACE_PX`] along both axes makes of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Change {
    /// Absolute.
    pub weight: f64,
    pub albedo: f64,
    /// Of the vector.
    pub normal: f64,
    /// Absolute.
    pub depth: f64,
}

/// How far a place on the screen may be off in f32: 16 steps of its distance from the image's middle, which is 40 px at most. By the same
/// the oracle marks rims.
const PLACE_PX: f64 = 16.0 * 40.0 / 16_777_216.0;

/// How far the near plane may be off, relative: as far as a depth.
const NEAR: f64 = 1e-4;

impl Truth {
    fn of(case: &Case, settings: Settings) -> Self {
        let hard = Hard { settings, ..case.hard.clone() };
        let picture = oracle_of(&hard);
        let undecided =
            picture.pixels.iter().map(|pixel| pixel.rim || pixel.epsilon_margin < case.depth_steps).collect();
        let changes = vec![Change::default(); picture.pixels.len()];
        let mut truth = Self { picture, undecided, changes };
        let seen_by = |camera: Camera| oracle_of(&Hard { camera, ..hard.clone() });
        if is_cut_by_near(&hard.scene.objects[0], &hard.camera) {
            for factor in [1.0 - NEAR, 1.0 + NEAR] {
                let near = Some(hard.camera.near() * factor);
                truth.mark_different(&seen_by(Camera { near, ..hard.camera }));
            }
        }
        for axis in [DVec3::X, DVec3::Y] {
            let other = seen_by(turned(&hard.camera, axis));
            truth.mark_different(&other);
            for ((change, a), b) in truth.changes.iter_mut().zip(&truth.picture.pixels).zip(&other.pixels) {
                change.add(a, b);
            }
        }
        truth
    }

    /// Nor can anybody decide what is seen in one of two pictures alone.
    pub fn mark_different(&mut self, other: &Picture) {
        for ((a, b), undecided) in self.picture.pixels.iter().zip(&other.pixels).zip(&mut self.undecided) {
            *undecided |= a.is_covered() != b.is_covered() || a.fragments != b.fragments;
        }
    }
}

impl Change {
    fn add(&mut self, a: &Pixel, b: &Pixel) {
        if a.is_covered() && b.is_covered() {
            self.weight += (a.weight - b.weight).abs();
            self.albedo += (DVec3::from(a.albedo) - DVec3::from(b.albedo)).abs().max_element();
            self.normal += (DVec3::from(a.normal) - DVec3::from(b.normal)).length();
            self.depth += (a.depth - b.depth).abs();
        }
    }
}

/// The camera turned so that all is seen [`PLACE_PX`] aside, along an axis of the view.
fn turned(camera: &Camera, axis: DVec3) -> Camera {
    let view = camera.view_from_world();
    let toward = camera.target - camera.eye;
    let aside = view.rotation.transpose() * axis * (PLACE_PX / camera.focal_px(SIZE_PX[1]));
    Camera { target: camera.target + aside * toward.length(), near: Some(camera.near()), ..*camera }
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
            let hard = with(&self.case.hard, |settings| settings.rasterizer = family);
            self.found.push((family, Truth::of(self.case, hard.settings)));
            self.found.len() - 1
        });
        &mut self.found[index].1
    }
}
