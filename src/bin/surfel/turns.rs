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

/// Timed frames in a turn, and as many again for the times of their passes.
pub const FRAMES_A_TURN: u32 = 2;

/// Frames before them that are not timed: what drew before needed other images, whose memory is touched for the first
/// time after each change.
pub const UNTIMED_A_TURN: u32 = 1;

/// One frame, measured.
pub struct Drawn {
    /// What was measured of it.
    pub profile: FrameProfile,
    /// Seconds from its submission to the end of the wait for it.
    pub wall_secs: f64,
    /// Seconds in which the host recorded it.
    pub record_secs: f64,
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
        let (profile, wall_secs, record_secs) =
            (frame.profile.unwrap_or_default(), frame.wall_secs, frame.record_secs);
        Ok(Drawn { profile, wall_secs, record_secs })
    })
}

/// Draws `frames` frames whose passes are not timed, then as many of which they are: the times of both, and the passes'
/// names.
///
/// # Errors
/// As `draw`.
pub fn samples(
    headless: &mut Headless,
    draw: &mut dyn FnMut(&mut Headless, Profile) -> Result<Drawn>,
    frames: u32,
) -> Result<(Vec<FrameSample>, Vec<String>)> {
    let ms = |secs: f64| 1e3 * secs;
    let mut samples = Vec::new();
    for _ in 0..frames {
        let whole = draw(headless, Profile::Frame)?;
        samples.push(FrameSample {
            passes_ms: Vec::new(),
            frame_ms: whole.profile.span_secs.map(ms),
            wall_ms: ms(whole.wall_secs),
            record_ms: ms(whole.record_secs),
        });
    }
    let mut names = Vec::new();
    for sample in &mut samples {
        let passes = draw(headless, Profile::Times)?.profile.passes;
        sample.passes_ms = passes.iter().map(|pass| pass.secs.map(ms)).collect();
        names = passes.into_iter().map(|pass| pass.name).collect();
    }
    Ok((samples, names))
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
    for _ in 0..UNTIMED_A_TURN {
        draw(headless, Profile::Frame)?;
    }
    let (round, names) = samples(headless, draw, timed_frames)?;
    if !round.is_empty() {
        timed.rounds.push(round);
        timed.names = names;
    }
    Ok(())
}
