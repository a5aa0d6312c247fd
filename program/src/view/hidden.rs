//! Pictures that nobody sees, drawn while the window rests, so that what a hand comes to next finds pipelines that have run.

use std::time::{Duration, Instant};

use surfel::scene::{Camera, Lod, Settings};

use super::{refine::LEVELED_PX, viewer::Viewer};

/// What a picture is that nobody sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// All of the picture once more, for what it costs.
    Whole,
    /// One that moves, of a step of the pace.
    Moving(usize),
    /// [`super::refine::Refinement::Leveled`].
    Leveled,
    /// One from another distance, of [`DISTANCES`]; as it moves, or with all splats.
    From(usize, bool),
}

/// A picture that nobody sees.
pub struct HiddenPicture {
    pub what: Hidden,
    pub camera: Camera,
    pub settings: Settings,
}

/// What a picture is that nobody sees, in a word: [`Hidden::Whole`], [`Hidden::From`], any other, and a step of one.
pub const AGAIN: &str = "again";
pub const ELSEWHERE: &str = "ahead, from elsewhere";
pub const AHEAD: &str = "ahead";
pub const STEP: &str = "ahead, a step";

/// Whether that is it.
pub fn is_of_hidden(what: &str) -> bool {
    [AGAIN, ELSEWHERE, AHEAD, STEP].contains(&what)
}

/// After a hand nothing is drawn that nobody sees before the window has rested for so long: a hand that only pauses would wait for it, and where pipelines run for the first time that is most of
/// a second.
pub const PAUSE: Duration = Duration::from_millis(400);

/// Distances over that of now from which other pipelines draw the scene: of splats of other sizes in pixels tiles are of other heights, large ones are drawn apart, and some are beside the picture or near the eye.
const DISTANCES: [f64; 3] = [1.0 / 4.0, 1.0 / 16.0, 4.0];

impl Hidden {
    /// What it is, in a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Whole => AGAIN,
            Self::From(..) => ELSEWHERE,
            Self::Moving(_) | Self::Leveled => AHEAD,
        }
    }

    /// Whether another device draws both before the window draws one of them. Those that a hand comes to at once are before the others.
    pub fn comes_with(self, other: Self) -> bool {
        matches!(self, Self::From(..)) == matches!(other, Self::From(..))
    }
}

impl Viewer {
    /// The first of [`Self::hidden_pictures`].
    pub fn next_hidden(&self, whole: &Settings) -> Option<HiddenPicture> {
        self.hidden_pictures(whole).into_iter().next()
    }

    /// When the first of them may be drawn, of a picture at rest that is drawn now.
    pub fn hidden_from(&self, now: Instant) -> Instant {
        if self.pace.has_moved() { now + PAUSE } else { now }
    }

    /// Pictures that are to be drawn once and that nobody sees, so that the first ones of a hand, and the first when it rests, find pipelines that have run.
    pub fn hidden_pictures(&self, whole: &Settings) -> Vec<HiddenPicture> {
        let is_whole = self.prepared.as_ref().is_some_and(|prepared| prepared.pages().is_none());
        let Some(navigation) = self.navigation.as_ref().filter(|_| is_whole && self.comparing.is_none())
        else {
            return Vec::new();
        };
        if self.pace.asks_for_whole() && !self.hidden.contains(&Hidden::Whole) {
            let camera = navigation.camera;
            return vec![HiddenPicture { what: Hidden::Whole, camera, settings: whole.clone() }];
        }
        let mut all = Vec::new();
        if !self.pace.is_finest() {
            // All steps where another device compiles for each of them, else those that may come next.
            let most = if self.ahead.is_some() { usize::MAX } else { 3 };
            let paces = self.pace.and_others().take(most).filter(|pace| !pace.is_finest());
            all.extend(
                paces.map(|pace| {
                    (Hidden::Moving(pace.step()), navigation.camera, self.coarse_by(&pace, whole))
                }),
            );
            if self.has_leveled(whole) && self.pace.is_slow() {
                let leveled = Settings { lod: Lod::Px(LEVELED_PX), ..whole.clone() };
                all.push((Hidden::Leveled, navigation.camera, leveled));
            }
        }
        // Where a driver compiles what runs first. Another scene on its way to the device has other pipelines.
        if self.ahead.is_some() && !self.prepares {
            let moving = self.coarse(whole);
            let settings = [(true, moving.clone()), (false, Settings { lod: whole.lod, ..moving })];
            let from = |(number, factor): (usize, &f64)| {
                let camera = navigation.at_distance(*factor, whole.size_px);
                settings.clone().map(|(moves, settings)| (Hidden::From(number, moves), camera, settings))
            };
            all.extend(DISTANCES.iter().enumerate().flat_map(from));
        }
        all.retain(|(what, camera, settings)| {
            !self.hidden.contains(what) && self.gpu.headless.renderer.check(camera, settings).is_ok()
        });
        all.into_iter().map(|(what, camera, settings)| HiddenPicture { what, camera, settings }).collect()
    }
}
