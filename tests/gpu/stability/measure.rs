//! The errors of one splat of the sweep, of the renderer's formulas and of the naive ones.

use glam::DVec2;
use surfel::{prepare::PreparedScene, renderer::Headless};

use super::{
    pictures::{self, Fragments},
    probe::{self, Answer, Asked, PLACES},
    sweep::Case,
    truth::Truth,
};
use crate::common::builder::Random;

/// The errors of one way to compute.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// How far a side of the box lies inside of the true one, both cut by the image, in pixels.
    pub small_px: f64,
    /// How far one lies outside.
    pub large_px: f64,
    /// The largest distance of (u, v) from the true one; for disks, whose tangent frame is free, of r.
    pub uv: f64,
    /// The same as a part of what is allowed, [`Truth::r_margin`].
    pub uv_share: f64,
}

/// What was found of one case.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measured {
    pub regular: bool,
    pub ours: Errors,
    pub naive: Errors,
    /// The naive formulas on world coordinates in f32.
    pub world: Errors,
    pub places: usize,
    pub fragments: Fragments,
}

/// A box or a (u, v) that is no number is infinitely wrong.
const NOTHING: Errors =
    Errors { small_px: f64::INFINITY, large_px: f64::INFINITY, uv: f64::INFINITY, uv_share: f64::INFINITY };

impl Errors {
    pub fn max(self, other: Self) -> Self {
        Self {
            small_px: self.small_px.max(other.small_px),
            large_px: self.large_px.max(other.large_px),
            uv: self.uv.max(other.uv),
            uv_share: self.uv_share.max(other.uv_share),
        }
    }
}

/// The cases with their truth, on the device.
pub struct Prepared {
    truths: Vec<Truth>,
    scenes: Vec<PreparedScene>,
    places_px: Vec<Vec<DVec2>>,
}

impl Prepared {
    pub fn new(headless: &Headless, cases: &[Case]) -> Self {
        let mut random = Random(31);
        let truths: Vec<Truth> = cases
            .iter()
            .map(|case| Truth::of(&case.hard.scene, &case.hard.camera, &case.hard.settings))
            .collect();
        let places_px = truths.iter().map(|truth| truth.places_px(PLACES, &mut random)).collect();
        let scenes =
            cases.iter().map(|case| headless.prepare(&case.hard.scene, &|_, _| {}).unwrap()).collect();
        Self { truths, scenes, places_px }
    }

    /// Box and (u, v) of every case. `wrong`: a formula that is made wrong by 1%.
    pub fn measure(&self, headless: &Headless, cases: &[Case], wrong: Option<&str>) -> Vec<Measured> {
        let asked: Vec<Asked<'_>> = (0..cases.len())
            .map(|i| Asked {
                scene: &self.scenes[i],
                position: cases[i].hard.scene.objects[0].splats.positions[0],
                camera: &cases[i].hard.camera,
                settings: &cases[i].hard.settings,
                places_px: self.places_px[i].clone(),
            })
            .collect();
        let answers = probe::ask(headless, &asked, wrong);
        (0..cases.len()).map(|i| measure_one(&self.truths[i], &asked[i], &answers[i])).collect()
    }

    /// The pictures of every case.
    pub fn count_fragments(&self, headless: &mut Headless, cases: &[Case], measured: &mut [Measured]) {
        for (i, measured) in measured.iter_mut().enumerate() {
            measured.fragments = pictures::count(headless, &self.scenes[i], &cases[i], &self.truths[i]);
        }
    }
}

fn measure_one(truth: &Truth, asked: &Asked<'_>, answer: &Answer) -> Measured {
    let mut measured = Measured { places: asked.places_px.len(), ..Measured::default() };
    // What f32 must see, if anything.
    if truth.least_and_largest_box_px()[0].is_none() {
        return measured;
    }
    if !answer.is_seen() {
        return Measured { ours: NOTHING, ..measured };
    }
    let disk = !asked.scene.chunks()[0].ellipses;
    let errors = |box_px, uv| box_errors(truth, box_px).max(uv_errors(truth, asked, disk, uv));
    measured.regular = answer.is_regular();
    measured.ours = errors(answer.box_px, &answer.quad);
    if measured.regular {
        measured.ours = measured.ours.max(uv_errors(truth, asked, disk, &answer.point));
    }
    measured.naive = errors(answer.naive_box_px, &answer.naive);
    measured.world = errors(answer.world_box_px, &answer.world);
    measured
}

fn uv_errors(truth: &Truth, asked: &Asked<'_>, disk: bool, found: &[[f32; 4]; PLACES]) -> Errors {
    let errors = asked.places_px.iter().zip(found).map(|(at_px, found)| {
        let at_px = *at_px - 0.5 * truth.size_px;
        let hit = truth.hit(at_px).expect("places are on the splat");
        let expected = DVec2::new(hit.u, hit.v);
        let found = DVec2::new(found[0].into(), found[1].into());
        let error = if disk { (found.length() - expected.length()).abs() } else { found.distance(expected) };
        let error = if error.is_nan() { f64::INFINITY } else { error };
        // Where even r² = 0 is within the margin, (u, v) means nothing.
        let has_meaning = truth.r2_margin(at_px, &hit) < 1.0;
        Errors {
            uv: if has_meaning { error } else { 0.0 },
            uv_share: error / truth.r_margin(at_px, &hit),
            ..Errors::default()
        }
    });
    errors.fold(Errors::default(), Errors::max)
}

fn box_errors(truth: &Truth, found: [f32; 4]) -> Errors {
    let found = found.map(f64::from);
    if found.iter().any(|side| side.is_nan()) {
        return Errors { uv: 0.0, uv_share: 0.0, ..NOTHING };
    }
    // Each side by itself, so that a box that misses the image is measured too.
    let half = 0.5 * truth.size_px;
    let found =
        [DVec2::new(found[0], found[1]), DVec2::new(found[2], found[3])].map(|x| x.clamp(-half, half));
    let outside =
        |of: Option<[DVec2; 2]>| of.map(|[lo, hi]| (lo - found[0], found[1] - hi)).unwrap_or_default();
    let [least, largest] = truth.least_and_largest_box_px().map(outside);
    Errors {
        small_px: -least.0.min(least.1).min_element().min(0.0),
        large_px: largest.0.max(largest.1).max_element().max(0.0),
        ..Errors::default()
    }
}
