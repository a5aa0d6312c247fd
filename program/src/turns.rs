//! Times several things in turn (A B A B), so that a change of the machine's speed meets all of them alike and ratios
//! within a round hold.

use surfel::{
    Progress as _, Result,
    graph::execute::{FrameProfile, Profile},
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    report::{FrameSample, TimedFrames, UNTIMED_A_TURN},
    scene::{Camera, Settings},
};

use crate::console::Bars;

/// Timed frames in a turn, and as many again for the times of their passes.
const FRAMES_A_TURN: u32 = 2;

/// One frame, measured.
pub struct MeasuredFrame {
    /// The measurement.
    pub profile: FrameProfile,
    /// Seconds from its submission to the end of the wait for it.
    pub wall_secs: f64,
    /// Seconds in which the host recorded it.
    pub record_secs: f64,
    /// Bytes of device memory that its own images and buffers share.
    pub transient_bytes: u64,
}

/// Draws a frame and measures it.
pub type Draw<'a> = Box<dyn FnMut(&mut Headless, Profile) -> Result<MeasuredFrame> + 'a>;

/// The frames of a scene.
pub fn frames<'a>(scene: &'a PreparedScene, camera: &'a Camera, settings: Settings) -> Draw<'a> {
    Box::new(move |headless, profile| {
        let wanted = Wanted { profile: Some(profile), ..Wanted::default() };
        let frame = headless.render(scene, camera, &settings, wanted)?;
        Ok(MeasuredFrame {
            profile: frame.profile.unwrap_or_default(),
            wall_secs: frame.wall_secs,
            record_secs: frame.record_secs,
            transient_bytes: headless.transient_bytes(),
        })
    })
}

/// Adds a round: `frames` frames whose passes are not timed, then as many of which they are.
pub fn add_round(
    headless: &mut Headless,
    draw: &mut Draw<'_>,
    frames: u32,
    timed: &mut TimedFrames,
) -> Result<()> {
    let ms = |secs: f64| 1e3 * secs;
    let mut round = Vec::new();
    for _ in 0..frames {
        let whole = draw(headless, Profile::Frame)?;
        round.push(FrameSample {
            passes_ms: Vec::new(),
            frame_ms: whole.profile.span_secs.map(ms),
            wall_ms: ms(whole.wall_secs),
            record_ms: ms(whole.record_secs),
        });
        timed.transient_bytes = whole.transient_bytes;
    }
    for sample in &mut round {
        let passes = draw(headless, Profile::Times)?.profile.passes;
        sample.passes_ms = passes.iter().map(|pass| pass.secs.map(ms)).collect();
        timed.passes = passes.into_iter().map(|pass| pass.name).collect();
    }
    timed.rounds.extend((!round.is_empty()).then_some(round));
    Ok(())
}

/// Counts vertices and fragments of each pass in a frame of their own, because counting costs time.
pub fn add_counts(headless: &mut Headless, draw: &mut Draw<'_>, timed: &mut TimedFrames) -> Result<()> {
    let passes = draw(headless, Profile::Counts)?.profile.passes.into_iter();
    timed.counts = passes.map(|pass| pass.counts.map(|counts| [counts.vertices, counts.fragments])).collect();
    Ok(())
}

/// Times `frames` frames of each contestant and counts vertices and fragments of one more. One that fails is left out of
/// the rounds that follow. A first round, in which pipelines are made, is not timed. `under_load` is called after it and after
/// the last, while the device is warm.
pub fn measure_interleaved(
    headless: &mut Headless,
    mut contestants: Vec<Draw<'_>>,
    frames: u32,
    what: &str,
    bars: &Bars,
    under_load: &mut dyn FnMut(),
) -> Vec<Result<TimedFrames>> {
    let mut all: Vec<Result<TimedFrames>> = contestants.iter().map(|_| Ok(TimedFrames::default())).collect();
    let rounds = frames.div_ceil(FRAMES_A_TURN);
    let total = u64::from(rounds + 1) * contestants.len() as u64;
    let mut done = 0;
    for round in 0..=rounds {
        let timed_frames = match round {
            0 => 0,
            round => FRAMES_A_TURN.min(frames - (round - 1) * FRAMES_A_TURN),
        };
        for (draw, result) in contestants.iter_mut().zip(&mut all) {
            unless_failed(result, |timed| {
                for _ in 0..UNTIMED_A_TURN {
                    draw(headless, Profile::Frame)?;
                }
                add_round(headless, draw, timed_frames, timed)
            });
            done += 1;
            bars.step(what, done, total);
        }
        if round == 0 || round == rounds {
            under_load();
        }
    }
    for (draw, result) in contestants.iter_mut().zip(&mut all) {
        unless_failed(result, |timed| add_counts(headless, draw, timed));
    }
    all
}

/// Goes on with a result, unless it is an error already.
fn unless_failed(result: &mut Result<TimedFrames>, work: impl FnOnce(&mut TimedFrames) -> Result<()>) {
    if let Ok(timed) = result
        && let Err(error) = work(timed)
    {
        *result = Err(error);
    }
}
