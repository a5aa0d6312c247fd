//! How coarse the picture is while it moves: as fine as the device draws often enough; and how soon it rests.

use std::time::Duration;

use surfel::scene::Lod;

/// What a moving frame may cost.
const GOAL_SECS: f64 = 0.040;

/// A picture at rest that takes no longer comes at once: something coarser before it would only make it later. Up to 0.15 s it is seen within 0.2 s after the hand is off.
const WHOLE_SECS: f64 = 0.300;

/// The camera rests once it has not moved for so long.
const REST: Duration = Duration::from_millis(25);

/// Where all of the picture takes longer than this, the camera rests later: while it is drawn the window shows nothing else, and a hand that only pauses would wait for it.
const LONG_SECS: f64 = 1.0;
const REST_OF_LONG: Duration = Duration::from_millis(500);

/// What a step costs of the one before, about.
const STEP_COST: f64 = 2.0 / 3.0;

/// The picture's side over the window's, and the size up to which splats are drawn as one, in pixels of the picture. From fine to coarse.
const STEPS: &[(f64, f64)] = &[
    (1.0, 0.0),
    (1.0, 0.75),
    (1.0, 1.25),
    (0.8, 1.5),
    (0.65, 1.75),
    (0.55, 2.0),
    (0.45, 2.0),
    (0.35, 2.0),
    (0.25, 2.0),
    (0.25, 3.0),
];

/// The pace of a window.
#[derive(Clone, Debug, Default)]
pub struct Pace {
    step: usize,
    /// Frames in a row that would have been fast enough one step finer.
    fast: u32,
    /// What all of the picture has cost last.
    whole_secs: f64,
    /// That is of the scene that is shown.
    knows_whole: bool,
    /// What it would cost by the last frame that moved.
    expected_secs: f64,
    /// The last frame that moved since then, as if it were as large as all of the picture.
    moving_secs: Option<f64>,
    /// What all of the picture cost over that. Much of a frame does not shrink with it, and levels of detail take less.
    whole_over_moving: Option<f64>,
    /// There was one.
    has_moved: bool,
}

impl Pace {
    /// The size of a moving picture.
    pub fn size_px(&self, window_px: [u32; 2]) -> [u32; 2] {
        let (scale, _) = STEPS[self.step];
        window_px.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
    }

    /// Its level of detail, where the scene has levels; `own`: that of the picture at rest.
    pub fn lod(&self, own: Lod) -> Lod {
        let (_, lod_px) = STEPS[self.step];
        match own {
            Lod::Px(px) => Lod::Px(px.max(lod_px)),
            _ if lod_px > 0.0 => Lod::Px(lod_px),
            other => other,
        }
    }

    /// All steps, this one first, then those that it may come to next.
    pub fn and_others(&self) -> impl Iterator<Item = Self> + '_ {
        let mut steps: Vec<usize> = (0..STEPS.len()).collect();
        steps.sort_by_key(|step| (step.abs_diff(self.step), *step < self.step));
        steps.into_iter().map(|step| Self { step, ..self.clone() })
    }

    /// A picture has moved.
    pub fn has_moved(&self) -> bool {
        self.has_moved
    }

    /// The number of its step; of the finest, 0.
    pub fn step(&self) -> usize {
        self.step
    }

    /// Whether a moving picture is as fine as one at rest.
    pub fn is_finest(&self) -> bool {
        self.step == 0
    }

    /// Whether all of the picture takes so long that something coarser is to come before it, when it rests.
    pub fn is_slow(&self) -> bool {
        self.whole_secs > WHOLE_SECS
    }

    /// Whether the camera rests later, since all of the picture takes long.
    pub fn waits(&self) -> bool {
        self.expected_secs > LONG_SECS
    }

    /// The camera rests once it has not moved for so long.
    pub fn rest(&self) -> Duration {
        if self.waits() { REST_OF_LONG } else { REST }
    }

    /// Another scene is shown.
    pub fn forget_whole(&mut self) {
        self.knows_whole = false;
    }

    /// Whether all of the picture is to be drawn once more, for what it costs: it did so with pipelines that ran for the first time alone, and a hand that comes would begin too fine.
    pub fn asks_for_whole(&self) -> bool {
        !self.knows_whole && !self.has_moved
    }

    /// Learns what all of the picture has cost. Where none has moved yet, one that does begins as coarse as that lets expect: no frame of a hand is spent on finding out.
    pub fn learn_whole(&mut self, secs: f64) {
        (self.whole_secs, self.expected_secs, self.knows_whole) = (secs, secs, true);
        let ratio = self.moving_secs.take().map(|moving_secs| secs / moving_secs);
        self.whole_over_moving = ratio.or(self.whole_over_moving);
        if !self.has_moved {
            let steps = (secs / GOAL_SECS).max(1.0).ln() / STEP_COST.recip().ln();
            self.step = (steps.ceil() as usize).min(STEPS.len() - 1);
        }
    }

    /// Learns what a moving frame has cost. `is_special`: pipelines were made for it, or memory, so that the next one may cost far less.
    pub fn learn(&mut self, secs: f64, is_special: bool) {
        self.has_moved = true;
        let (scale, _) = STEPS[self.step];
        if !is_special {
            let as_large_secs = secs / (scale * scale);
            self.moving_secs = Some(as_large_secs);
            self.expected_secs = self.whole_over_moving.unwrap_or(1.0) * as_large_secs;
        }
        let is_far_too_slow = secs > 4.0 * GOAL_SECS;
        if secs > 1.15 * GOAL_SECS && self.step + 1 < STEPS.len() {
            // Several at once where it is far too slow.
            let by = match (is_special, is_far_too_slow) {
                (true, false) => 0,
                (true, true) | (false, false) => 1,
                (false, true) => 3,
            };
            (self.step, self.fast) = ((self.step + by).min(STEPS.len() - 1), 0);
        } else if secs < 0.5 * GOAL_SECS && self.step > 0 {
            self.fast += 1;
            if self.fast >= 8 {
                (self.step, self.fast) = (self.step - 1, 0);
            }
        } else {
            self.fast = 0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device that takes so long for a full picture.
    fn settled(full_secs: f64) -> Pace {
        let mut pace = Pace::default();
        for _ in 0..200 {
            let (scale, lod_px) = STEPS[pace.step];
            pace.learn(full_secs * scale * scale / (1.0 + lod_px * lod_px), false);
        }
        pace
    }

    #[test]
    fn fast_devices_draw_all_of_it_and_slow_ones_what_they_can_at_the_goal() {
        assert!(settled(0.01).is_finest());
        assert_eq!(settled(0.01).size_px([300, 200]), [300, 200]);
        for full_secs in [0.1, 0.3, 1.0] {
            let pace = settled(full_secs);
            let (scale, lod_px) = STEPS[pace.step];
            let secs = full_secs * scale * scale / (1.0 + lod_px * lod_px);
            assert!(!pace.is_finest() && secs < 1.15 * GOAL_SECS, "{full_secs}: {pace:?}");
        }
        assert_eq!(settled(1e9).size_px([300, 1]), [75, 1]);
    }

    #[test]
    fn the_first_frame_that_moves_is_as_coarse_as_the_picture_at_rest_lets_expect() {
        let first = |whole_secs| {
            let mut pace = Pace::default();
            pace.learn_whole(whole_secs);
            pace.step
        };
        assert_eq!([0.01, 0.039, 0.05, 0.27, 100.0].map(first), [0, 0, 1, 5, STEPS.len() - 1]);
        let mut pace = Pace::default();
        assert!(pace.asks_for_whole());
        pace.learn_whole(0.27);
        assert!(!pace.asks_for_whole());
        pace.forget_whole();
        assert!(pace.asks_for_whole() && !pace.is_finest());
        pace.learn(0.01, false);
        assert!(!pace.asks_for_whole(), "what moves tells by itself");
        // After that, frames that move tell.
        let mut pace = Pace::default();
        pace.learn(0.01, false);
        pace.learn_whole(0.27);
        assert!(pace.is_finest());
    }

    #[test]
    fn something_coarser_comes_before_a_picture_that_takes_long() {
        let mut pace = Pace::default();
        let slow = [0.1, 0.29, 0.31, 0.2].map(|secs| {
            pace.learn_whole(secs);
            pace.is_slow()
        });
        assert_eq!(slow, [false, false, true, false]);
    }

    #[test]
    fn the_camera_rests_later_before_a_picture_that_takes_very_long() {
        let mut pace = Pace::default();
        assert!(!pace.waits() && pace.rest() == REST);
        pace.learn_whole(6.0);
        assert!(pace.waits() && pace.rest() == REST_OF_LONG);
        // Outside of the model again, a small picture tells of the large one.
        pace.learn(0.5, false);
        pace.learn(0.01, false);
        assert!(!pace.waits());
        pace.learn(0.7, false);
        assert!(pace.waits());
    }

    /// Most of a picture of a 16th takes as long as of a whole one on a device that others use, too.
    #[test]
    fn what_all_of_the_picture_takes_is_expected_by_what_it_took_before() {
        let mut pace = Pace::default();
        pace.learn_whole(0.4);
        let begin = pace.step;
        while pace.step + 1 < STEPS.len() {
            pace.learn(0.07, false);
        }
        assert!(begin < pace.step && pace.waits(), "by the first one it takes as much as pixels");
        pace.learn_whole(0.4);
        pace.learn(0.07, false);
        assert!(!pace.waits() && pace.rest() == REST);
        // Into what takes longer, and a picture without one that moves before it.
        pace.learn(0.2, false);
        assert!(pace.waits());
        pace.learn_whole(1.2);
        pace.learn_whole(0.1);
        pace.learn(0.2, false);
        assert!(pace.waits());
    }

    #[test]
    fn a_frame_whose_pipelines_or_memory_were_made_tells_little_of_the_next() {
        let (mut sure, mut unsure) = (Pace::default(), Pace::default());
        sure.learn(0.1, false);
        unsure.learn(0.1, true);
        assert!((sure.step, unsure.step) == (1, 0));
        sure.learn(2.0, false);
        unsure.learn(2.0, true);
        assert!((sure.step, unsure.step) == (4, 1) && sure.waits() && !unsure.waits());
    }

    #[test]
    fn all_steps_are_at_hand_the_nearest_first_and_the_coarser_of_two() {
        let pace = Pace { step: 2, ..Pace::default() };
        let steps: Vec<usize> = pace.and_others().map(|pace| pace.step).collect();
        assert_eq!(steps, [2, 3, 1, 4, 0, 5, 6, 7, 8, 9]);
    }

    #[test]
    fn levels_are_never_finer_than_those_at_rest() {
        let pace = settled(1.0);
        assert_eq!(pace.lod(Lod::Px(100.0)), Lod::Px(100.0));
        assert_eq!(Pace::default().lod(Lod::Auto), Lod::Auto);
        assert!(matches!(pace.lod(Lod::Px(0.0)), Lod::Px(px) if px > 0.0));
    }
}
