//! Times frames that do nothing but draw: no read-back, no surface as data.

use std::time::Instant;

use surfel::{
    Result,
    graph::execute::Profile,
    prepare::PreparedScene,
    renderer::{Headless, Wanted},
    report::FrameTimes,
    scene::{Camera, Settings},
};

use crate::{steps::Steps, turns};

/// Frames before those that are timed: the first makes pipelines and transients, the second finds them.
const WARM_UP_FRAMES: u32 = 2;

/// What is drawn, again and again.
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The scene.
    pub scene: &'a PreparedScene,
    /// From where.
    pub camera: &'a Camera,
    /// How.
    pub settings: &'a Settings,
}

/// Warms up, with the very first frame split into what host and device did, times `frames` frames, and counts vertices and fragments in one more, because counting may cost time.
///
/// # Errors
/// As [`Headless::render`].
pub fn frame_times(
    headless: &mut Headless,
    view: View<'_>,
    frames: u32,
    steps: &mut Steps,
) -> Result<(FrameTimes, u64)> {
    let timed = Wanted { profile: Some(Profile::Times), ..Wanted::default() };
    let counted = Wanted { profile: Some(Profile::Counts), ..Wanted::default() };
    let draw =
        |headless: &mut Headless, wanted| headless.render(view.scene, view.camera, view.settings, wanted);
    let start = Instant::now();
    let first = draw(headless, timed)?;
    let host_secs = start.elapsed().as_secs_f64() - first.wall_secs;
    steps.add("make pipelines, record the first frame", host_secs);
    steps.add("first frame, submission to end of wait", first.wall_secs);
    for _ in 1..WARM_UP_FRAMES {
        draw(headless, timed)?;
    }
    let mut samples = Vec::new();
    for _ in 0..frames {
        let frame = draw(headless, timed)?;
        let profile = frame.profile.unwrap_or_default();
        samples.push(turns::sample(&profile, frame.wall_secs, frame.record_secs));
    }
    let transient_bytes = headless.transient_bytes();
    let counts = turns::counts(&draw(headless, counted)?.profile.unwrap_or_default());
    let names: Vec<_> = first.plan.passes.iter().map(|pass| pass.name.clone()).collect();
    Ok((FrameTimes::of(&names, WARM_UP_FRAMES, &samples, &counts), transient_bytes))
}
