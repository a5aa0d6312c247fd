//! Times the methods in turn, so that a change of the machine's speed meets all of them alike.

use surfel::{
    Progress as _, Result,
    graph::execute::Profile,
    renderer::{Frame, Headless, Wanted},
    report::{
        FrameSample, FrameTimes,
        compare::{ErrorFigures, Method},
    },
    scene::Settings,
};

use super::Stage;
use crate::measure;

/// Timed frames in a turn.
const FRAMES_A_TURN: u32 = 2;

/// Frames before them that are not timed: methods need different images, whose memory is touched for the first time
/// after each change.
const UNTIMED_A_TURN: u32 = 1;

/// One method's frames so far.
struct Timed {
    settings: Settings,
    names: Vec<String>,
    samples: Vec<FrameSample>,
    failed: Option<surfel::Error>,
}

/// Times `frames` frames of each method and counts the fragments of one more.
pub fn take(
    headless: &mut Headless,
    stage: &Stage<'_>,
    base: &Settings,
    methods: &[(Method, [ErrorFigures; 2])],
    frames: u32,
) -> Vec<Result<FrameTimes>> {
    let mut all: Vec<Timed> = methods
        .iter()
        .map(|(method, _)| Timed {
            settings: method.settings(base),
            names: Vec::new(),
            samples: Vec::new(),
            failed: None,
        })
        .collect();
    let turns = frames.div_ceil(FRAMES_A_TURN);
    let total = u64::from(turns + 1) * methods.len() as u64;
    let mut done = 0;
    // The first round makes pipelines.
    for turn in 0..=turns {
        let timed_frames = match turn {
            0 => 0,
            turn => FRAMES_A_TURN.min(frames - (turn - 1) * FRAMES_A_TURN),
        };
        for timed in &mut all {
            if timed.failed.is_none()
                && let Err(error) = one_turn(headless, stage, timed, timed_frames)
            {
                timed.failed = Some(error);
            }
            done += 1;
            stage.bars.step("frames of all methods", done, total);
        }
    }
    all.into_iter().map(|timed| finish(headless, stage, timed)).collect()
}

fn one_turn(headless: &mut Headless, stage: &Stage<'_>, timed: &mut Timed, timed_frames: u32) -> Result<()> {
    for frame in 0..UNTIMED_A_TURN + timed_frames {
        let drawn = draw(headless, stage, &timed.settings, Profile::Times)?;
        if frame >= UNTIMED_A_TURN {
            timed.samples.push(measure::sample(&drawn));
        }
        timed.names = drawn.plan.passes.iter().map(|pass| pass.name.clone()).collect();
    }
    Ok(())
}

fn finish(headless: &mut Headless, stage: &Stage<'_>, timed: Timed) -> Result<FrameTimes> {
    if let Some(error) = timed.failed {
        return Err(error);
    }
    let counted = draw(headless, stage, &timed.settings, Profile::Counts)?.profile.unwrap_or_default();
    let counts: Vec<_> = counted
        .passes
        .iter()
        .map(|pass| pass.counts.map(|counts| [counts.vertices, counts.fragments]))
        .collect();
    Ok(FrameTimes::of(&timed.names, UNTIMED_A_TURN, &timed.samples, &counts))
}

fn draw(headless: &mut Headless, stage: &Stage<'_>, settings: &Settings, profile: Profile) -> Result<Frame> {
    let wanted = Wanted { profile: Some(profile), ..Wanted::default() };
    headless.render(stage.prepared, stage.camera, settings, wanted)
}
