//! Times frames that do nothing but draw: no read-back, no surface as data.

use std::time::Instant;

use surfel::{
    Result,
    graph::execute::Profile,
    prepare::PreparedScene,
    renderer::Headless,
    report::{FrameTimes, TimedFrames},
    scene::{Camera, Settings},
};

use crate::{steps::Steps, turns};

/// Frames before those that are timed: the first makes pipelines and transients, the second finds them.
const WARM_UP_FRAMES: u32 = 2;

/// A scene as it is drawn, again and again.
#[derive(Clone, Copy)]
pub struct View<'a> {
    pub scene: &'a PreparedScene,
    pub camera: &'a Camera,
    pub settings: &'a Settings,
}

/// Warms up, with the very first frame split into what host and device did, times `frames` frames and the passes of as many
/// more, and counts vertices and fragments in one more, because timing passes and counting cost time.
pub fn frame_times(
    headless: &mut Headless,
    view: View<'_>,
    frames: u32,
    steps: &mut Steps,
) -> Result<(FrameTimes, u64)> {
    let mut draw = turns::frames(view.scene, view.camera, view.settings.clone());
    let start = Instant::now();
    let first = draw(headless, Profile::Frame)?;
    let host_secs = start.elapsed().as_secs_f64() - first.wall_secs;
    steps.add("make pipelines, record the first frame", host_secs);
    steps.add("first frame, submission to end of wait", first.wall_secs);
    for _ in 1..WARM_UP_FRAMES {
        draw(headless, Profile::Frame)?;
    }
    let mut timed = TimedFrames::default();
    turns::add_round(headless, &mut draw, frames, &mut timed)?;
    turns::add_counts(headless, &mut draw, &mut timed)?;
    let times = FrameTimes::of(&timed.passes, WARM_UP_FRAMES, &timed.rounds.concat(), &timed.counts);
    Ok((times, timed.transient_bytes))
}
