//! Times frames that do nothing but draw: no read-back, no surface as data.

use std::time::Instant;

use surfel::{
    Result,
    graph::execute::Profile,
    prepare::PreparedScene,
    renderer::{Frame, Headless, Wanted},
    report::{FrameSample, FrameTimes},
    scene::{Camera, Settings},
};

use crate::steps::Steps;

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
        samples.push(sample(&draw(headless, timed)?));
    }
    let transient_bytes = headless.transient_bytes();
    let counts = draw(headless, counted)?.profile.unwrap_or_default().passes;
    let counts: Vec<_> =
        counts.iter().map(|pass| pass.counts.map(|counts| [counts.vertices, counts.fragments])).collect();
    let names: Vec<_> = first.plan.passes.iter().map(|pass| pass.name.clone()).collect();
    Ok((FrameTimes::of(&names, WARM_UP_FRAMES, &samples, &counts), transient_bytes))
}

/// The times of one frame.
pub fn sample(frame: &Frame) -> FrameSample {
    let ms = |secs: f64| 1e3 * secs;
    let (passes, span_secs) = match &frame.profile {
        Some(profile) => (profile.passes.as_slice(), profile.span_secs),
        None => (&[][..], None),
    };
    FrameSample {
        passes_ms: passes.iter().map(|pass| pass.secs.map(ms)).collect(),
        span_ms: span_secs.map(ms),
        wall_ms: ms(frame.wall_secs),
    }
}
