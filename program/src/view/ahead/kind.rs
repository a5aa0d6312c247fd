//! Which pictures have the same pipelines, and of which those have run.

use std::sync::Arc;

use surfel::scene::{Camera, Lod, Scene, Settings};

use super::super::edits::Edits;

/// A picture, by all that decides about its pipelines.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    pub camera: Camera,
    pub settings: Settings,
    pub of: Of,
}

/// What pictures are of, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Of {
    edits: Edits,
    has_levels: bool,
    is_light: bool,
    is_parallel: bool,
    /// Which files they are of, by where their scene is in memory.
    files: usize,
}

impl Of {
    pub fn new(
        (scene, edits, has_levels): (&Arc<Scene>, &Edits, bool),
        camera: &Camera,
        is_light: bool,
    ) -> Self {
        let is_parallel = camera.orthographic_height.is_some();
        Self { edits: edits.clone(), has_levels, is_light, is_parallel, files: Arc::as_ptr(scene).addr() }
    }
}

impl Kind {
    /// Whether they differ in cameras and sizes at most, of pictures and of splats that are drawn as one.
    fn is_like(&self, other: &Self) -> bool {
        let of = |settings: &Settings| Settings { size_px: [0; 2], lod: Lod::Auto, ..settings.clone() };
        self.of == other.of && of(&self.settings) == of(&other.settings)
    }
}

/// So many jobs are drawn for pictures that go on changing before the window draws what there is.
const MOST_JOBS: usize = 4;

/// Which pictures the thread draws, and which it has drawn.
#[derive(Default)]
pub struct Known {
    /// Those to come, and whether nobody sees them in the window either.
    waiting: Vec<(Kind, bool)>,
    /// Those of the newest jobs that are drawn.
    drawn: Vec<Kind>,
    /// How many jobs are drawn since pictures were asked for that the window has not drawn since.
    jobs: usize,
}

impl Known {
    /// Other pictures are to be drawn, or the same ones of other sizes or from elsewhere, which may have other pipelines.
    pub fn begin(&mut self) {
        self.jobs = 0;
    }

    /// Whether one of these waits. Of pictures that are shown those of all sizes wait for each other: a hand moves meanwhile, and its pictures grow and shrink. For those that nobody sees no hand waits.
    pub fn wait(&self, pictures: &[Kind], are_hidden: bool) -> bool {
        let waits = |own: &Kind| {
            let is_it = |(kind, is_hidden): &(Kind, bool)| match is_hidden {
                true => are_hidden && kind == own,
                false => kind.is_like(own),
            };
            self.waiting.iter().any(is_it)
        };
        pictures.iter().any(waits)
    }

    /// Whether all of these are drawn, from there: where the window's pipelines are others still, the thread can do no more.
    pub fn are_drawn(&self, pictures: &[Kind]) -> bool {
        pictures.iter().all(|own| self.drawn.contains(own))
    }

    /// Whether a hand moves on faster than the thread draws.
    pub fn is_behind(&self) -> bool {
        self.jobs >= MOST_JOBS
    }

    /// These are to come.
    pub fn ask(&mut self, pictures: Vec<Kind>, is_hidden: bool) {
        self.drawn.clear();
        self.waiting.extend(pictures.into_iter().map(|kind| (kind, is_hidden)));
    }

    /// Of pictures that were asked for so many are drawn, and the others left.
    pub fn are_done(&mut self, mut pictures: Vec<Kind>, drawn: usize) {
        self.waiting.retain(|(waiting, _)| !pictures.contains(waiting));
        self.jobs += usize::from(drawn >= pictures.len());
        pictures.truncate(drawn);
        self.drawn.extend(pictures);
    }
}

#[cfg(test)]
mod tests {
    use std::slice::from_ref;

    use glam::DVec3;

    use super::*;

    fn kind(side_px: u32, is_light: bool) -> Kind {
        let settings = Settings { size_px: [side_px; 2], ..Settings::default() };
        let scene = (&Arc::new(Scene::default()), &Edits::none(&Scene::default(), &[]), false);
        let of = Of { files: 0, ..Of::new(scene, &Camera::default(), is_light) };
        Kind { camera: Camera::default(), settings, of }
    }

    #[test]
    fn a_hand_waits_for_pictures_of_any_size_but_not_for_those_that_nobody_sees() {
        let [whole, coarse, other] =
            [(100, false), (25, false), (100, true)].map(|(px, light)| kind(px, light));
        let mut known = Known::default();
        known.ask(vec![whole.clone()], false);
        assert!([&whole, &coarse].map(|kind| known.wait(from_ref(kind), false)) == [true; 2]);
        assert!(!known.wait(from_ref(&other), false) && !known.are_drawn(from_ref(&whole)));
        known.are_done(vec![whole.clone()], 1);
        assert!(!known.wait(from_ref(&coarse), false) && known.are_drawn(from_ref(&whole)));
        let near = Kind { camera: Camera { eye: DVec3::X, ..whole.camera }, ..whole.clone() };
        let near = Kind { settings: kind(60, false).settings, ..near };
        known.ask(vec![coarse.clone(), near.clone()], true);
        assert!([&coarse, &near].map(|kind| known.wait(from_ref(kind), true)) == [true; 2]);
        assert!(!known.wait(from_ref(&coarse), false) && !known.wait(from_ref(&whole), true));
        // Something else was asked for meanwhile.
        known.are_done(vec![coarse.clone(), near.clone()], 1);
        assert!(known.are_drawn(from_ref(&coarse)) && !known.are_drawn(from_ref(&near)));
        assert!(!known.wait(from_ref(&near), true));
    }

    #[test]
    fn a_hand_that_moves_on_is_followed_for_some_jobs() {
        let whole = kind(100, false);
        let mut known = Known::default();
        for _ in 0..MOST_JOBS {
            assert!(!known.is_behind());
            known.ask(vec![whole.clone()], false);
            // What was left for another job does not count.
            known.are_done(vec![whole.clone()], 0);
            assert!(!known.is_behind() && !known.are_drawn(from_ref(&whole)));
            known.ask(vec![whole.clone()], false);
            known.are_done(vec![whole.clone()], 1);
        }
        assert!(known.is_behind());
        known.begin();
        assert!(!known.is_behind() && known.are_drawn(from_ref(&whole)));
    }
}
