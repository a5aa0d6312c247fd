//! Times several things in turn (A B A B), so that a change of the machine's speed meets all of them alike and ratios
//! within a round hold.

use surfel::{
    Error, Progress as _, Result,
    graph::execute::{FrameProfile, Profile},
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    report::FrameSample,
    scene::{Camera, Settings},
};

use crate::console::Bars;

/// Timed frames in a turn.
pub const FRAMES_A_TURN: u32 = 2;

/// Frames before them that are not timed: what drew before needed other images, whose memory is touched for the first
/// time after each change.
pub const UNTIMED_A_TURN: u32 = 1;

/// One frame, measured.
pub struct Drawn {
    /// What its passes cost.
    pub profile: FrameProfile,
    /// The times of it.
    pub sample: FrameSample,
}

/// Draws a frame and measures it.
pub type Draw<'a> = Box<dyn FnMut(&mut Headless, Profile) -> Result<Drawn> + 'a>;

/// What one contestant's frames took.
#[derive(Default)]
pub struct Timed {
    /// Its passes, in the frame's order.
    pub names: Vec<String>,
    /// Round by round.
    pub rounds: Vec<Vec<FrameSample>>,
    /// Vertices and fragments of each pass, where they were counted.
    pub counts: Vec<Option<[u64; 2]>>,
}

impl Timed {
    /// All frames.
    pub fn samples(&self) -> Vec<FrameSample> {
        self.rounds.concat()
    }
}

/// The frames of a scene.
pub fn frames<'a>(scene: &'a PreparedScene, camera: &'a Camera, settings: Settings) -> Draw<'a> {
    Box::new(move |headless, profile| {
        let wanted = Wanted { profile: Some(profile), ..Wanted::default() };
        let frame = headless.render(scene, camera, &settings, wanted)?;
        let profile = frame.profile.unwrap_or_default();
        Ok(Drawn { sample: sample(&profile, frame.wall_secs, frame.record_secs), profile })
    })
}

/// The times of one frame.
pub fn sample(profile: &FrameProfile, wall_secs: f64, record_secs: f64) -> FrameSample {
    let ms = |secs: f64| 1e3 * secs;
    FrameSample {
        passes_ms: profile.passes.iter().map(|pass| pass.secs.map(ms)).collect(),
        span_ms: profile.span_secs.map(ms),
        wall_ms: ms(wall_secs),
        record_ms: ms(record_secs),
    }
}

/// Times `frames` frames of each contestant and counts vertices and fragments of one more. One that fails is left out of
/// the rounds that follow. A first round, in which pipelines are made, is not timed. `under_load` is called after it and after
/// the last, while the device is warm.
pub fn take(
    headless: &mut Headless,
    mut contestants: Vec<Draw<'_>>,
    frames: u32,
    what: &str,
    bars: &Bars,
    under_load: &mut dyn FnMut(),
) -> Vec<Result<Timed>> {
    let mut all: Vec<Result<Timed>> = contestants.iter().map(|_| Ok(Timed::default())).collect();
    let rounds = frames.div_ceil(FRAMES_A_TURN);
    let total = u64::from(rounds + 1) * contestants.len() as u64;
    let mut done = 0;
    for round in 0..=rounds {
        let timed_frames = match round {
            0 => 0,
            round => FRAMES_A_TURN.min(frames - (round - 1) * FRAMES_A_TURN),
        };
        for (draw, result) in contestants.iter_mut().zip(&mut all) {
            if let Ok(timed) = result
                && let Err(error) = one_turn(headless, draw, timed, timed_frames)
            {
                *result = Err(error);
            }
            done += 1;
            bars.step(what, done, total);
        }
        if round == 0 || round == rounds {
            under_load();
        }
    }
    for (draw, result) in contestants.iter_mut().zip(&mut all) {
        if let Ok(timed) = result {
            match draw(headless, Profile::Counts) {
                Ok(drawn) => timed.counts = counts(&drawn.profile),
                Err(error) => *result = Err(error),
            }
        }
    }
    all
}

/// Vertices and fragments of each pass.
pub fn counts(profile: &FrameProfile) -> Vec<Option<[u64; 2]>> {
    profile.passes.iter().map(|pass| pass.counts.map(|counts| [counts.vertices, counts.fragments])).collect()
}

fn one_turn(
    headless: &mut Headless,
    draw: &mut Draw<'_>,
    timed: &mut Timed,
    timed_frames: u32,
) -> Result<(), Error> {
    let mut round = Vec::new();
    for frame in 0..UNTIMED_A_TURN + timed_frames {
        let drawn = draw(headless, Profile::Times)?;
        if frame >= UNTIMED_A_TURN {
            round.push(drawn.sample);
        }
        timed.names = drawn.profile.passes.into_iter().map(|pass| pass.name).collect();
    }
    if !round.is_empty() {
        timed.rounds.push(round);
    }
    Ok(())
}
